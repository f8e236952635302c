#pragma once

#include <cstdint>
#include <string>

#include "api/ports.h"
#include "service/byte_cache.h"
#include "service/draw_process.h"
#include "service/draw_task.h"
#include "service/stored_results.h"
#include "service/stores.h"

namespace gaitmill {

/// Most that images may have.
struct ImageLimits {
  std::int64_t pixels = 250'000'000;  ///< of one image, over all its poses or frames
  Quota quota;                        ///< of each API key: its pixels
  std::string geometry;               ///< folder of meshes that the process draws with
};

/// Images of a job behind the API. The motion, model and values are those of the last stage that
/// has finished.
class ImageService : public api::ImagePort {
 public:
  /// @param drawing, cache  outlive this
  ImageService(Stores& stores, DrawProcess& drawing, ByteCache& cache, ImageLimits limits);

  std::string findTag(const api::Identity& who,
                      const std::string& job_id,
                      const api::ImageRequest& request) override;
  api::ImageFile paint(const api::Identity& who,
                       const std::string& job_id,
                       const api::ImageRequest& request) override;

 private:
  DrawData readData(const std::string& tenant,
                    const std::string& job_id,
                    MuscleColor color,
                    const StoredResults& results);

  Stores& stores_;
  DrawProcess& drawing_;
  ByteCache& cache_;
  ImageLimits limits_;
};

}  // namespace gaitmill
