#include "service/product_pipeline.h"

#include "core/figure/comparison.h"
#include "core/figure/job_figures.h"
#include "core/io/table_writer.h"
#include "core/report/report.h"
#include "service/catalog_readers.h"
#include "service/inspection.h"
#include "service/product_drawing.h"

namespace gaitmill {

namespace {

std::string encodeSto(const TimeSeries& table, api::AngleUnit angles) {
  TableWriteOptions options;
  options.angles = angles == api::AngleUnit::kDegrees ? AngleUnit::kDegrees : AngleUnit::kRadians;
  return writeTable(table, options);
}

FigureFunctions makeFigures() {
  FigureFunctions figures;
  figures.list = listFigures;
  figures.make = makeFigure;
  figures.compare = compareResults;
  figures.list_overlays = listCommonFigures;
  figures.make_overlay = overlayFigures;
  figures.find_instants = findReportInstants;
  figures.render_report = renderReport;
  return figures;
}

}  // namespace

PipelineFunctions makeProductPipeline(const std::string& models_folder) {
  const Pipeline pipeline(models_folder);
  PipelineFunctions functions;
  functions.run = [pipeline](const TrialInput& input,
                             const InputFile& settings,
                             const PipelineEvents& events,
                             const std::vector<std::string>& checkpoints) {
    return pipeline.run(input, settings, events, checkpoints);
  };
  functions.check_input = [pipeline](const TrialInput& input, const InputFile& settings) {
    pipeline.checkInput(input, settings);
  };
  functions.inspect = inspectTrial;
  functions.read_model = summarizeModel;
  functions.read_marker_set = summarizeMarkerSet;
  functions.encode_sto = encodeSto;
  functions.figures = makeFigures();
  functions.make_drawing = makeProductDrawing;
  functions.default_settings = Pipeline::defaultSettings();
  return functions;
}

}  // namespace gaitmill
