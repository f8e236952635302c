// Writes the specification, the bare data and our own picture of figures into a folder: all of the
// sample job, overlays, one of several cycles, the validation of the model. NAME.vl.json,
// NAME.data.json, NAME.svg. usage: figure_specs FOLDER
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <string>

#include "core/figure/vega_lite.h"
#include "core/base/units.h"
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
  const std::string specification = gaitmill::renderVegaLite(figure);
  const std::string picture = gaitmill::renderSvg(figure, gaitmill::SvgOptions{960, true});
  writeText(stem + ".vl.json", specification);
  writeText(stem + ".data.json", gaitmill::renderFigureData(figure));
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

// Three cycles of both knees that differ by a tenth, a little of it not measured: bands and gaps.
void writeSeveralCycles(const std::string& folder) {
  gaitmill::TimeSeries table;
  table.labels = {"knee_angle_r", "knee_angle_l"};
  table.units = {"rad", "rad"};
  for (int i = 0; i <= 400; ++i) {
    table.time.push_back(0.01 * i);
  }
  table.values.resize(table.rowCount(), table.columnCount());
  for (int row = 0; row < table.rowCount(); ++row) {
    const double time = table.time[static_cast<std::size_t>(row)];
    const double size = 0.9 + 0.1 * std::floor(time);
    table.values(row, 0) = 0.5 * size * (1 - std::cos(2 * gaitmill::kPi * time));
    table.values(row, 1) = 0.5 * size * (1 + std::cos(2 * gaitmill::kPi * time));
  }
  table.values.block(20, 0, 5, 1).setConstant(std::nan(""));
  const gaitmill::MemoryResults source({{"kinematics", table}},
                                       {},
                                       R"({"gait_cycle_s": [0, 1],
      "cycles": {"right": [[0, 1], [1, 2], [2, 3]], "left": [[0.5, 1.5], [1.5, 2.5]]},
      "events": [{"kind": "toe_off", "foot": "right", "time_s": 0.6},
                 {"kind": "toe_off", "foot": "left", "time_s": 1.15}]})");
  Figure figure = gaitmill::makeFigure(source, "joint_angles");
  figure.name = "several_cycles";
  writeFigure(folder, figure);
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
    writeSeveralCycles(argv[1]);
    writeValidation(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "figure_specs: %s\n", error.what());
    return 1;
  }
}
