// The report of the embedded sample trial, as the product makes it: all stages, figures and
// pictures. For a browser to look at.
// usage: sample_report FILE.html
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <utility>

#include "core/base/text.h"
#include "core/figure/job_figures.h"
#include "core/io/files.h"
#include "core/pipeline/pipeline.h"
#include "core/render/picture.h"
#include "core/report/report.h"
#include "tests/core/report/memory_results.h"
#include "tests/support/sample_input.h"

namespace gaitmill {
namespace {

PictureData makePictureData(const PipelineResult& result) {
  PictureData data;
  data.model_osim = result.files.at("adjusted_model.osim");
  const std::pair<const char*, TimeSeries*> parts[] = {{"kinematics", &data.kinematics},
                                                       {"activations", &data.muscle_values},
                                                       {"ground_reactions", &data.ground_reactions},
                                                       {"measured_markers", &data.markers}};
  for (const auto& [name, table] : parts) {
    const auto found = result.tables.find(name);
    if (found != result.tables.end()) {
      *table = found->second;
    }
  }
  return data;
}

std::vector<ReportImage> paintInstants(const PictureData& data, const ResultSource& results) {
  PictureOptions options;
  options.width = 640;
  options.height = 720;
  Painter painter;
  std::vector<ReportImage> images;
  for (const ReportInstant& instant : findReportInstants(results)) {
    Picture picture = painter.paintPose(data, instant.time, options);
    images.push_back({instant.name + ", " + formatFixed(instant.time, 2) + " s",
                      std::move(picture.content_type),
                      std::move(picture.bytes)});
  }
  return images;
}

ReportProvenance makeProvenance() {
  ReportProvenance provenance;
  provenance.job_id = "0192f1d0-7c1a-7e77-b1ce-1f1f4f3c9d10";
  provenance.created_at = "2026-01-02T03:04:05Z";
  provenance.finished_at = "2026-01-02T03:04:11Z";
  // What a browser would run if it were not escaped.
  provenance.subject = "<script>document.title='run'</script><img src=x onerror=alert(1)>";
  provenance.label = "sample trial";
  provenance.model = "rajagopal2016";
  provenance.settings_name = "default";
  provenance.provenance = std::string(64, 'a');
  provenance.version = codeVersion();
  provenance.inputs = {{"markers", "markers.trc", 261234, std::string(64, 'b')},
                       {"ground_reaction", "grf.mot", 1234567, std::string(64, 'c')}};
  return provenance;
}

void writeSampleReport(const std::string& path) {
  PipelineResult result = Pipeline().run(
      readSampleInput(), readInput("models/settings/default.json"), PipelineEvents{});
  MemoryResults results(result.summary_json);
  const PictureData data = makePictureData(result);
  results.tables = std::move(result.tables);
  results.cycle_tables = std::move(result.cycle_tables);
  ReportContent content;
  content.provenance = makeProvenance();
  content.results = &results;
  for (const FigureInfo& info : listFigures(results)) {
    content.figures.push_back(makeFigure(results, info.name));
  }
  content.images = paintInstants(data, results);
  writeFile(path, renderReport(content));
}

}  // namespace
}  // namespace gaitmill

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: sample_report FILE.html\n";
    return EXIT_FAILURE;
  }
  try {
    gaitmill::writeSampleReport(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << "sample_report: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
