#include "service/run_views.h"

#include <cctype>
#include <utility>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/figure/vega_lite.h"
#include "service/draw_task.h"
#include "service/picture_data.h"
#include "service/run_results.h"

namespace gaitmill {

namespace {

using Files = std::map<std::string, std::string>;

// @throws Error of the painter
void paintInstants(const RunResults& results,
                   const PipelineResult& result,
                   const PipelineFunctions& functions,
                   const std::string& geometry,
                   ReportContent& content,
                   Files& files) {
  const auto model = result.files.find(kMotionModel);
  if (model == result.files.end() || !results.has("kinematics", ResultSource::Axis::kTime)) {
    return;
  }
  DrawData data;
  data.model_name = kMotionModel;
  data.picture = collectPictureData(results, MuscleColor::kActivation);
  data.picture.model_osim = model->second;
  const Drawing draw = functions.make_drawing(geometry);
  for (const ReportInstant& instant : functions.figures.find_instants(results)) {
    DrawTask task;
    task.start = instant.time;
    task.options.width = kReportPoseWidth;
    task.options.height = kReportPoseHeight;
    Picture picture = draw(task, data);
    files["images/" + makeImageName(instant.name)] = picture.bytes;
    content.images.push_back(
        {makeImageCaption(instant), picture.content_type, std::move(picture.bytes)});
  }
}

}  // namespace

std::map<std::string, std::string> makeRunViews(
    const PipelineResult& result,
    const ReportProvenance& provenance,
    const PipelineFunctions& functions,
    const std::string& geometry,
    const std::function<void(const std::string&)>& warn) {
  const RunResults results(result);
  Files files;
  ReportContent content;
  content.provenance = provenance;
  content.results = &results;
  for (const FigureInfo& info : functions.figures.list(results)) {
    content.figures.push_back(functions.figures.make(results, info.name));
    files["plots/" + info.name + ".vl.json"] = renderVegaLite(content.figures.back());
  }
  try {
    paintInstants(results, result, functions, geometry, content, files);
  } catch (const Error& error) {
    warn("the report has no images: " + error.message());
  }
  files["report.html"] = functions.figures.render_report(content);
  return files;
}

std::string makeImageName(const std::string& instant) {
  std::string name;
  for (const char letter : instant) {
    const auto code = static_cast<unsigned char>(letter);
    name += std::isalnum(code) != 0 ? static_cast<char>(std::tolower(code)) : '_';
  }
  return name + ".png";
}

std::string makeImageCaption(const ReportInstant& instant) {
  return instant.name + ", " + formatFixed(instant.time, 2) + " s";
}

}  // namespace gaitmill
