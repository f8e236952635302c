#include "service/image_service.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/base/error.h"
#include "core/render/picture_limits.h"
#include "service/job_tag.h"

namespace gaitmill {

namespace {

constexpr ResultSource::Axis kTime = ResultSource::Axis::kTime;

// Bytes that the cache shares with the replies that carry them.
class SharedBytes : public api::ByteSource {
 public:
  explicit SharedBytes(ByteCache::Value value) : value_(std::move(value)) {}
  std::uint64_t size() const override { return value_->bytes.size(); }
  std::string read(std::uint64_t offset, std::size_t size) const override {
    return offset < value_->bytes.size() ? value_->bytes.substr(offset, size) : "";
  }

 private:
  ByteCache::Value value_;
};

api::ImageFile share(ByteCache::Value value) {
  return {value->content_type, std::make_shared<SharedBytes>(value)};
}

MuscleColor parseColor(const std::string& color) {
  return color == "activation"     ? MuscleColor::kActivation
         : color == "force"        ? MuscleColor::kForce
         : color == "fiber_length" ? MuscleColor::kFiberLength
                                   : MuscleColor::kNone;
}

// The result table with what muscles are coloured by.
const char* tableOf(MuscleColor color) {
  switch (color) {
    case MuscleColor::kActivation:
      return "activations";
    case MuscleColor::kForce:
      return "forces";
    case MuscleColor::kFiberLength:
      return "norm_fiber_lengths";
    case MuscleColor::kNone:
      break;
  }
  return "";
}

PictureOptions makeOptions(const api::ImageRequest& request) {
  PictureOptions options;
  options.width = request.width;
  options.height = request.height;
  options.view = parseView(request.view);
  options.color = parseColor(request.color);
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

// @throws Error kImageSize, kRequestField for what the painter does not take
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

TimeSeries readIfThere(const StoredResults& results, const std::string& table) {
  return !table.empty() && results.has(table, kTime) ? results.table(table, kTime) : TimeSeries{};
}

}  // namespace

ImageService::ImageService(Stores& stores,
                           DrawProcess& drawing,
                           ByteCache& cache,
                           ImageLimits limits)
    : stores_(stores), drawing_(drawing), cache_(cache), limits_(std::move(limits)) {}

std::string ImageService::findTag(const api::Identity& who,
                                  const std::string& job_id,
                                  const api::ImageRequest& request) {
  const std::string results = identifyResults(stores_.jobs.find(who.tenant, job_id));
  return makeTag({"image", results, limits_.geometry, api::describeImage(request)});
}

api::ImageFile ImageService::paint(const api::Identity& who,
                                   const std::string& job_id,
                                   const api::ImageRequest& request) {
  const std::string identity = identifyResults(stores_.jobs.find(who.tenant, job_id));
  const std::string tag = findTag(who, job_id, request);
  if (ByteCache::Value kept = cache_.find(tag)) {
    return share(std::move(kept));
  }
  const StoredResults results(stores_.jobs, who.tenant, job_id);
  const DrawTask task = makeTask(request, results);
  const std::int64_t pixels = countPixels(task);
  require(pixels <= limits_.pixels,
          ErrorCode::kImageSize,
          "the image would have " + std::to_string(pixels) +
              " pixels over all its poses, at most " + std::to_string(limits_.pixels) +
              " are drawn",
          {"", 0, 0, "width"});
  stores_.jobs.chargePixels(who.tenant, job_id, pixels, limits_.quota);
  const DrawReply drawn = drawing_.ask(
      {encodeDrawTask(task), makeTag({identity, request.color}), [&] {
         return encodeDrawData(readData(who.tenant, job_id, task.options.color, results));
       }});
  return share(cache_.put(tag, {drawn.content_type, drawn.bytes}));
}

DrawTask ImageService::makeTask(const api::ImageRequest& request,
                                const StoredResults& results) const {
  const CycleSpan cycle = findCycleSpan(results.summary());
  const TimeSeries& motion = results.table("kinematics", kTime);
  require(motion.rowCount() > 0, ErrorCode::kResultNotFound, "this job has no motion");
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

DrawData ImageService::readData(const std::string& tenant,
                                const std::string& job_id,
                                MuscleColor color,
                                const StoredResults& results) {
  DrawData data;
  data.model_name = "adjusted_model.osim";
  data.picture.model_osim = readModel(tenant, job_id);
  data.picture.kinematics = results.table("kinematics", kTime);
  data.picture.muscle_values = readIfThere(results, tableOf(color));
  data.picture.ground_reactions = readIfThere(results, "ground_reactions");
  data.picture.markers = readIfThere(results, "measured_markers");
  const CycleSpan cycle = findCycleSpan(results.summary());
  if (cycle.exists()) {
    data.picture.cycle = GaitCycle{cycle.start, cycle.end};
  }
  return data;
}

std::string ImageService::readModel(const std::string& tenant, const std::string& job_id) {
  return stores_.jobs.readResult(tenant, job_id, ResultKind::kFile, "adjusted_model.osim").bytes;
}

}  // namespace gaitmill
