#include "core/so/so_options.h"

#include <cmath>

#include "core/base/error.h"

namespace gaitmill {

void SoOptions::validate() const {
  const auto demand = [](bool ok, const char* field, const char* message) {
    require(ok, ErrorCode::kInputValue, message, {{}, 0, 0, field});
  };
  demand(std::isfinite(exponent) && exponent >= 1, "exponent", "the exponent must be at least 1");
  demand(
      solver == Solver::kDualNewton || exponent > 1, "exponent", "Ipopt needs an exponent above 1");
  demand(row_interval >= 1, "row_interval", "the row interval must be at least 1");
  demand(range.start <= range.end, "range", "the time range ends before it starts");
  demand(infeasible_above > 0, "infeasible_above", "the limit must be positive");
  for (const ActuatorSpec& actuator : actuators) {
    demand(std::isfinite(actuator.optimal_force) && actuator.optimal_force != 0,
           actuator.name.c_str(),
           "an actuator's optimal force must not be zero");
    demand(actuator.min_control <= actuator.max_control,
           actuator.name.c_str(),
           "an actuator's control range ends before it starts");
  }
}

}  // namespace gaitmill
