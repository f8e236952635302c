#include "core/cmc/cmc_options.h"

#include <cstddef>

#include "core/base/error.h"

namespace gaitmill {
namespace {

void requireField(bool ok, const char* field, const char* expected) {
  require(ok,
          ErrorCode::kSettingsValue,
          std::string("cmc: ") + field + " must be " + expected,
          {{}, 0, 0, field});
}

void validate(const ExcitationLimit& limit) {
  requireField(!limit.nodes.empty(), "excitation_limits", "lists of at least one node");
  for (std::size_t k = 0; k < limit.nodes.size(); ++k) {
    const ExcitationLimit::Node& node = limit.nodes[k];
    requireField(node.upper >= 0 && node.upper <= 1, "excitation_limits", "values in [0, 1]");
    requireField(k == 0 || node.time > limit.nodes[k - 1].time,
                 "excitation_limits",
                 "nodes at increasing times");
  }
}

}  // namespace

void CmcOptions::validate() const {
  requireField(window > 0, "window", "positive");
  requireField(initial_window > 0, "initial_window", "positive");
  requireField(hold_duration >= 0, "hold_duration", "not negative");
  requireField(position_gain >= 0 && velocity_gain >= 0, "gains", "not negative");
  requireField(min_excitation > 0 && min_excitation <= max_excitation && max_excitation <= 1,
               "min_excitation",
               "in (0, max_excitation], and that at most 1");
  requireField(torque_control_limit > 0, "torque_control_limit", "positive");
  requireField(uncontrollable_range >= 0, "uncontrollable_range", "not negative");
  requireField(excitation_tolerance > 0, "excitation_tolerance", "positive");
  requireField(barrier >= 0, "barrier", "not negative");
  requireField(fiber_tolerance > 0, "fiber_tolerance", "positive");
  requireField(integration_step > 0, "integration_step", "positive");
  for (const ExcitationLimit& limit : excitation_limits) {
    gaitmill::validate(limit);
  }
  require(end_time >= start_time + initial_window + 2 * window,
          ErrorCode::kInputTimeRange,
          "cmc: the time range is shorter than the initial stage and two windows",
          {{}, 0, 0, "time_range_s"});
}

}  // namespace gaitmill
