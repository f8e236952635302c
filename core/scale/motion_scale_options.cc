#include "core/scale/motion_scale_options.h"

#include <cmath>

#include "core/base/error.h"

namespace gaitmill {

void MotionScaleOptions::validate() const {
  const auto demand = [](bool ok, const char* field, const char* message) {
    require(ok, ErrorCode::kInputValue, message, {{}, 0, 0, field});
  };
  const auto positive = [](double value) {
    return std::isfinite(value) && value > 0;
  };
  demand(positive(subject_height), "height", "the subject's height must be a positive number");
  demand(positive(generic_height), "generic_height", "the model's height must be positive");
  demand(frame_count > 0, "frame_count", "at least one frame is needed");
  demand(positive(independent_frames), "independent_frames", "the number must be positive");
  demand(positive(marker_deviation), "marker_deviation", "the deviation must be positive");
  demand(positive(landmark_deviation), "landmark_deviation", "the deviation must be positive");
  demand(positive(tracking_deviation), "tracking_deviation", "the deviation must be positive");
  demand(positive(rotation_deviation), "rotation_deviation", "the deviation must be positive");
  demand(min_relative_size > 0 && min_relative_size < 1 && max_relative_size > 1,
         "min_relative_size",
         "the sizes tried must include 1");
}

}  // namespace gaitmill
