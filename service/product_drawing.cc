#include "service/product_drawing.h"

#include <memory>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/io/osim_reader.h"
#include "core/validation/validation.h"

namespace gaitmill {

namespace {

Picture listValidations(const ModelSpec& model) {
  std::vector<Figure> figures;
  for (FigureInfo& info : listValidationFigures(model)) {
    Figure figure;
    figure.name = std::move(info.name);
    figure.title = std::move(info.title);
    figure.caption = std::move(info.caption);
    figures.push_back(std::move(figure));
  }
  return {kFiguresType, encodeFigures(figures)};
}

Picture draw(Painter& painter, const DrawTask& task, const DrawData& data) {
  const auto read_model = [&data] {
    return readOsim(data.picture.model_osim, data.model_name);
  };
  switch (task.kind) {
    case DrawTask::Kind::kPose:
      return painter.paintPose(data.picture, task.start, task.options);
    case DrawTask::Kind::kStrip:
      return painter.paintStrip(data.picture, task.start, task.end, task.poses, task.options);
    case DrawTask::Kind::kAnimation:
      return painter.paintAnimation(
          data.picture, task.start, task.end, task.rate, task.slow_down, task.options);
    case DrawTask::Kind::kListValidations:
      return listValidations(read_model());
    case DrawTask::Kind::kValidation: {
      ValidationOptions options;
      options.seed = task.seed;
      return {kFiguresType,
              encodeFigures({makeValidationFigure(read_model(), task.figure, options)})};
    }
  }
  throw Error(ErrorCode::kInternal, "there is no such thing to draw");
}

}  // namespace

Drawing makeProductDrawing(const std::string& geometry) {
  const auto painter = std::make_shared<std::unique_ptr<Painter>>();
  return [painter, geometry](const DrawTask& task, const DrawData& data) {
    if (*painter == nullptr) {
      *painter = std::make_unique<Painter>(geometry);
    }
    return draw(**painter, task, data);
  };
}

}  // namespace gaitmill
