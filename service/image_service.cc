#include "service/image_service.h"

#include <memory>
#include <utility>

#include "core/base/error.h"
#include "service/image_task.h"
#include "service/job_tag.h"
#include "service/picture_data.h"

namespace gaitmill {

namespace {

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
  const DrawTask task = makeDrawTask(request,
                                     results.table("kinematics", ResultSource::Axis::kTime),
                                     findCycleSpan(results.summary()));
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

DrawData ImageService::readData(const std::string& tenant,
                                const std::string& job_id,
                                MuscleColor color,
                                const StoredResults& results) {
  DrawData data;
  data.model_name = kMotionModel;
  data.picture = collectPictureData(results, color);
  data.picture.model_osim =
      stores_.jobs.readResult(tenant, job_id, ResultKind::kFile, kMotionModel).bytes;
  return data;
}

}  // namespace gaitmill
