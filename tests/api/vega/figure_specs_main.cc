// Writes the specification, the bare data and our own picture of every figure of the sample job
// into a folder: NAME.vl.json, NAME.data.json, NAME.svg. usage: figure_specs FOLDER
#include <cstdio>
#include <exception>
#include <fstream>
#include <string>

#include "api/dto/vega_lite.h"
#include "core/figure/comparison.h"
#include "core/figure/job_figures.h"
#include "core/figure/svg.h"
#include "core/io/osim_reader.h"
#include "core/pipeline/pipeline.h"
#include "core/validation/validation.h"
#include "tests/support/memory_results.h"
#include "tests/support/sample_input.h"

namespace {

using gaitmill::Figure;

void writeText(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  gaitmill::require(file.good(), gaitmill::ErrorCode::kFileUnwritable, path);
}

void writeFigure(const std::string& folder, const Figure& figure) {
  const std::string stem = folder + "/" + figure.name;
  const std::string specification = gaitmill::api::renderVegaLite(figure);
  const std::string picture = gaitmill::renderSvg(figure, gaitmill::SvgOptions{960, true});
  writeText(stem + ".vl.json", specification);
  writeText(stem + ".data.json", gaitmill::api::renderFigureData(figure));
  writeText(stem + ".svg", picture);
  std::printf("%-34s %3zu panels  Vega-Lite %7zu bytes  SVG %7zu bytes\n",
              figure.name.c_str(),
              figure.panels.size(),
              specification.size(),
              picture.size());
}

void writeOverlays(const std::string& folder, const gaitmill::MemoryResults& source) {
  for (const char* name : {"moments", "muscle_work"}) {
    Figure overlay =
        gaitmill::overlayFigures({{"walk <1>", &source}, {"walk & again", &source}}, name);
    overlay.name = "overlay_" + overlay.name;
    writeFigure(folder, overlay);
  }
}

void writeSampleJob(const std::string& folder) {
  gaitmill::PipelineResult result =
      gaitmill::Pipeline().run(gaitmill::readSampleInput(),
                               gaitmill::readInput("models/settings/default.json"),
                               gaitmill::PipelineEvents{});
  const gaitmill::MemoryResults source(
      std::move(result.tables), std::move(result.cycle_tables), std::move(result.summary_json));
  for (const gaitmill::FigureInfo& info : gaitmill::listFigures(source)) {
    writeFigure(folder, gaitmill::makeFigure(source, info.name));
  }
  writeOverlays(folder, source);
}

// The curves of one muscle stand for those of all.
void writeValidation(const std::string& folder) {
  const gaitmill::InputFile document =
      gaitmill::readInput("models/rajagopal2016/rajagopal2016.osim");
  const gaitmill::ModelSpec model = gaitmill::readOsim(document.bytes, document.name);
  for (const gaitmill::FigureInfo& info : gaitmill::listValidationFigures(model)) {
    if (info.name.rfind("muscle_curves_", 0) != 0 || info.name == "muscle_curves_soleus_r") {
      Figure figure = gaitmill::makeValidationFigure(model, info.name, {1, 1000});
      figure.name = "validation_" + figure.name;
      writeFigure(folder, figure);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    gaitmill::require(argc == 2, gaitmill::ErrorCode::kUsage, "usage: figure_specs FOLDER");
    writeSampleJob(argv[1]);
    writeValidation(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "figure_specs: %s\n", error.what());
    return 1;
  }
}
