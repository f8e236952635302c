#include "core/scale/scale_options.h"

#include <cmath>

#include "core/base/error.h"

namespace gaitmill {

void ScaleOptions::validate() const {
  const auto demand = [](bool ok, const char* field, const char* message) {
    require(ok, ErrorCode::kInputValue, message, {{}, 0, 0, field});
  };
  demand(std::isfinite(subject_mass) && subject_mass >= 0, "mass", "mass must not be negative");
  demand(min_visible_fraction > 0 && min_visible_fraction <= 1,
         "min_visible_fraction",
         "the fraction must lie in (0, 1]");
  demand(max_contraction_velocity.value_or(1) > 0,
         "max_contraction_velocity",
         "the velocity must be positive");
  demand(fiber_damping.value_or(0) >= 0, "fiber_damping", "damping must not be negative");
  for (const ManualScaleSpec& manual : marker_set.manual) {
    demand(manual.factors.minCoeff() > 0, "manual", "scale factors must be positive");
  }
}

}  // namespace gaitmill
