#include "core/ik/ik_options.h"

#include "core/base/error.h"

namespace gaitmill {

void IkOptions::validate() const {
  const auto demand = [](bool ok, const char* field, const char* message) {
    require(ok, ErrorCode::kInputValue, message, {{}, 0, 0, field});
  };
  demand(range.start <= range.end, "range", "the time range ends before it starts");
  demand(fit.step_tolerance > 0, "fit.step_tolerance", "the tolerance must be positive");
  demand(fit.max_iterations > 0, "fit.max_iterations", "at least one iteration is needed");
  demand(fit.max_rotation_step > 0, "fit.max_rotation_step", "the longest step must be positive");
  demand(!tasks.markers.empty(), "tasks.markers", "no marker has a weight");
}

}  // namespace gaitmill
