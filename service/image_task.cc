#include "service/image_task.h"

#include "core/base/error.h"
#include "core/render/picture_limits.h"

namespace gaitmill {

namespace {

PictureOptions makeOptions(const api::ImageRequest& request) {
  PictureOptions options;
  options.width = request.width;
  options.height = request.height;
  options.view = parseView(request.view);
  options.color = parseMuscleColor(request.color);
  options.bones = request.bones;
  options.muscles = request.muscles;
  options.markers = request.markers;
  options.forces = request.forces;
  options.ground = request.ground;
  options.legend = request.legend;
  return options;
}

DrawTask::Kind kindOf(api::ImageKind kind) {
  return kind == api::ImageKind::kPose    ? DrawTask::Kind::kPose
         : kind == api::ImageKind::kStrip ? DrawTask::Kind::kStrip
                                          : DrawTask::Kind::kAnimation;
}

double findPoseTime(const api::ImageRequest& request, const CycleSpan& cycle, double start) {
  if (!request.percent) {
    return request.time.value_or(start);
  }
  require(cycle.exists(),
          ErrorCode::kRequestField,
          "this job has no gait cycle that parameter 'percent' could refer to; use 'time'",
          {"", 0, 0, "percent"});
  return cycle.start + *request.percent / 100.0 * (cycle.end - cycle.start);
}

}  // namespace

std::int64_t countPixels(const DrawTask& task) {
  validateOptions(task.options);
  const std::int64_t one = std::int64_t{task.options.width} * task.options.height;
  if (task.kind == DrawTask::Kind::kStrip) {
    validateStrip(task.start, task.end, task.poses, task.options);
    return one * task.poses;
  }
  return task.kind == DrawTask::Kind::kAnimation
             ? one * countFrames(task.start, task.end, task.rate, task.slow_down, task.options)
             : one;
}

DrawTask makeDrawTask(const api::ImageRequest& request,
                      const TimeSeries& motion,
                      const CycleSpan& cycle) {
  require(motion.rowCount() > 0, ErrorCode::kResultNotFound, "there is no motion");
  const CycleSpan shown =
      cycle.exists() ? cycle : CycleSpan{motion.time.front(), motion.time.back()};
  DrawTask task;
  task.kind = kindOf(request.kind);
  task.options = makeOptions(request);
  task.start = request.kind == api::ImageKind::kPose ? findPoseTime(request, cycle, shown.start)
                                                     : request.start.value_or(shown.start);
  task.end = request.end.value_or(shown.end);
  task.poses = request.poses;
  task.rate = request.rate;
  task.slow_down = request.slow_down;
  return task;
}

}  // namespace gaitmill
