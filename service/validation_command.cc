#include "service/validation_command.h"

#include "core/figure/svg.h"
#include "core/figure/vega_lite.h"
#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "core/validation/validation.h"

namespace gaitmill {

namespace {

std::string render(const Figure& figure, ValidateModelOptions::Form form) {
  switch (form) {
    case ValidateModelOptions::Form::kVegaLite:
      return renderVegaLite(figure);
    case ValidateModelOptions::Form::kData:
      return renderFigureData(figure);
    case ValidateModelOptions::Form::kSvg: {
      SvgOptions options;
      options.heading = true;
      return renderSvg(figure, options);
    }
  }
  return "";
}

}  // namespace

std::string describeValidation(const ValidateModelOptions& options) {
  const ModelSpec model = readOsim(readFile(options.path), options.path);
  if (!options.figure.empty()) {
    ValidationOptions draws;
    draws.seed = options.seed;
    return render(makeValidationFigure(model, options.figure, draws), options.form) + "\n";
  }
  std::string list;
  for (const FigureInfo& info : listValidationFigures(model)) {
    list += info.name + "  " + info.title + "\n";
  }
  return list;
}

}  // namespace gaitmill
