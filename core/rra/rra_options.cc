#include "core/rra/rra_options.h"

#include "core/base/error.h"

namespace gaitmill {
namespace {

void requireSetting(bool ok, const char* field, const std::string& message) {
  require(ok, ErrorCode::kSettingsValue, message, {"", 0, 0, field});
}

void validatePass(const RraPassOptions& pass) {
  requireSetting(pass.start_time < pass.end_time, "end_time_s", "a pass ends before it starts");
  requireSetting(!pass.tasks.empty(), "tasks", "a pass tracks no coordinate");
  for (const TrackingTask& task : pass.tasks) {
    requireSetting(task.weight >= 0, "weight", "weight of '" + task.coordinate + "' is negative");
    requireSetting(task.position_gain >= 0 && task.velocity_gain >= 0,
                   "position_gain",
                   "a gain of '" + task.coordinate + "' is negative");
  }
}

}  // namespace

void RraOptions::validate() const {
  requireSetting(!passes.empty(), "passes", "residual reduction needs at least one pass");
  for (const RraPassOptions& pass : passes) validatePass(pass);
  requireSetting(max_passes >= 0, "max_passes", "the number of passes is negative");
  requireSetting(mass_tolerance >= 0, "mass_tolerance_kg", "a tolerance is negative");
  requireSetting(mass_center_tolerance >= 0, "mass_center_tolerance_m", "a tolerance is negative");
  requireSetting(!lowpass_cutoff || *lowpass_cutoff > 0,
                 "lowpass_cutoff_hz",
                 "low-pass cutoff must be above 0 Hz");
  requireSetting(padding_rows >= 0, "padding_rows", "the number of padded rows is negative");
  requireSetting(max_mass_center_shift >= 0, "max_mass_center_shift_m", "the limit is negative");
  requireSetting(max_mass_change >= 0 && max_mass_change < 1,
                 "max_mass_change",
                 "the largest mass change must be a share from 0 to below 1");
  for (const double limit : {limits.rotation_rms,
                             limits.rotation_peak,
                             limits.translation_rms,
                             limits.translation_peak,
                             limits.force_rms,
                             limits.force_peak,
                             limits.moment_rms,
                             limits.moment_peak}) {
    requireSetting(limit > 0, "limits", "a limit of deviations or residuals must be above 0");
  }
  requireSetting(window > 0, "window_s", "the control window must be above 0 s");
  requireSetting(
      integration_tolerance > 0, "integration_tolerance", "the tolerance must be above 0");
  for (const ActuatorSpec& actuator : actuators) {
    requireSetting(actuator.optimal_force > 0,
                   "optimal_force",
                   "optimal force of '" + actuator.name + "' must be above 0");
    requireSetting(actuator.min_control <= actuator.max_control,
                   "min_control",
                   "control limits of '" + actuator.name + "' are swapped");
  }
}

}  // namespace gaitmill
