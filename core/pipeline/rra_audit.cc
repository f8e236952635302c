#include "core/pipeline/rra_audit.h"

#include <cstddef>
#include <limits>
#include <string>

#include "core/base/units.h"
#include "core/pipeline/quality_json.h"
#include "core/rra/rra_limits.h"

namespace gaitmill {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kCentimetersPerMeter = 100;

Json summarizeResiduals(const ResidualSum& sum) {
  return {{"force_n", {sum.force.x(), sum.force.y(), sum.force.z()}},
          {"moment_nm", {sum.moment.x(), sum.moment.y(), sum.moment.z()}}};
}

Json summarizeStatistics(const ResidualStatistics& statistics) {
  return {{"average", summarizeResiduals(statistics.average)},
          {"rms", summarizeResiduals(statistics.rms)},
          {"peak", summarizeResiduals(statistics.peak)}};
}

/// The largest of each kind. Discarded passes have statistics but no table.
TrackingError findLargest(const std::vector<CoordinateDeviation>& deviations) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  TrackingError error{kNan, kNan, kNan, kNan, kNan, "", ""};
  const auto keep = [](double value, const std::string& name, double& largest, std::string& worst) {
    if (!(value <= largest)) {
      largest = value;
      worst = name;
    }
  };
  for (const CoordinateDeviation& deviation : deviations) {
    const std::string& name = deviation.coordinate;
    if (deviation.translation) {
      keep(kCentimetersPerMeter * deviation.peak, name, error.max_cm, error.worst_peak_translation);
      keep(kCentimetersPerMeter * deviation.rms, name, error.max_rms_cm, error.worst_translation);
    } else {
      keep(toDegrees(deviation.peak), name, error.max_deg, error.worst_peak_rotation);
      keep(toDegrees(deviation.rms), name, error.max_rms_deg, error.worst_rotation);
    }
  }
  error.max_rms_centiradian = 100 * toRadians(error.max_rms_deg);
  return error;
}

Json auditLimits(const RraLimits& limits) {
  return {{"rotation_rms_deg", toDegrees(limits.rotation_rms)},
          {"rotation_peak_deg", toDegrees(limits.rotation_peak)},
          {"translation_rms_cm", kCentimetersPerMeter * limits.translation_rms},
          {"translation_peak_cm", kCentimetersPerMeter * limits.translation_peak},
          {"force_rms_n", limits.force_rms},
          {"force_peak_n", limits.force_peak},
          {"moment_rms_nm", limits.moment_rms},
          {"moment_peak_nm", limits.moment_peak}};
}

Json auditAdjustment(const MassAdjustment& adjustment) {
  return {{"mass_before_kg", toJsonNumber(adjustment.mass_before)},
          {"mass_change_kg", toJsonNumber(adjustment.mass_change)},
          {"mass_limited", adjustment.mass_limited},
          {"center_shift_x_m", toJsonNumber(adjustment.shift_x)},
          {"center_shift_z_m", toJsonNumber(adjustment.shift_z)},
          {"center_shift_limited", adjustment.shift_limited},
          {"average_residuals_before", summarizeResiduals(adjustment.average_before)},
          {"average_residuals_after", summarizeResiduals(adjustment.average_after)}};
}

Json auditWeights(const RraPassResult& pass) {
  Json weights = Json::object();
  for (const TrackingTask& task : pass.used.tasks) {
    weights[task.coordinate] = task.weight;
  }
  return weights;
}

Json auditChanges(const RraPassResult& pass) {
  Json changes = Json::array();
  for (const WeightChange& change : pass.weight_changes) {
    changes.push_back({{"coordinate", change.coordinate},
                       {"before", change.before},
                       {"after", change.after},
                       {"reason", change.reason}});
  }
  return changes;
}

Json auditDeviations(const RraPassResult& pass) {
  Json deviations = Json::object();
  for (const CoordinateDeviation& deviation : pass.deviations) {
    const std::string unit = deviation.translation ? "cm" : "deg";
    const double factor = deviation.translation ? kCentimetersPerMeter : kDegreesPerRadian;
    deviations[deviation.coordinate] = {{"rms_" + unit, toJsonNumber(factor * deviation.rms)},
                                        {"peak_" + unit, toJsonNumber(factor * deviation.peak)},
                                        {"percent_of_limit", toJsonNumber(100 * deviation.share)}};
  }
  return deviations;
}

Json auditExcess(const RraPassResult& pass, const RraLimits& limits) {
  Json exceeded = Json::array();
  for (const LimitedFigure& figure : listFigures(pass, limits)) {
    if (figure.share() > 1) {
      exceeded.push_back({{"figure", figure.name},
                          {"value", figure.value},
                          {"limit", figure.limit},
                          {"unit", figure.unit}});
    }
  }
  return exceeded;
}

Json auditPass(const RraPassResult& pass, std::size_t number, const RraLimits& limits) {
  return {{"pass", number},
          {"from_pass", pass.from_pass > 0 ? Json(pass.from_pass) : Json(nullptr)},
          {"decision", pass.decision},
          {"merit", toJsonNumber(pass.merit)},
          {"exceeded", auditExcess(pass, limits)},
          {"weight_changes", auditChanges(pass)},
          {"weights", auditWeights(pass)},
          {"time_range_s", {pass.used.start_time, pass.used.end_time}},
          {"adjustment", auditAdjustment(pass.adjustment)},
          {"residuals_before", summarizeStatistics(pass.adjustment.desired)},
          {"residuals_after", summarizeStatistics(pass.residuals)},
          {"deviations", auditDeviations(pass)}};
}

}  // namespace

Json auditRra(const RraResult& rra) {
  const bool autopilot = rra.options.strategy == RraStrategy::kAutopilot;
  Json audit = {{"strategy", autopilot ? "autopilot" : "passes"},
                {"kept_pass", rra.kept + 1},
                {"limits_hold", rra.keptPass().merit == 0},
                {"lowpass_cutoff_hz",
                 rra.options.lowpass_cutoff ? Json(*rra.options.lowpass_cutoff) : Json(nullptr)},
                {"lowpass_reason", rra.options.lowpass_reason},
                {"adjusted_body", rra.options.adjusted_body},
                {"limits", auditLimits(rra.options.limits)},
                {"mass_steps", Json::array()},
                {"passes", Json::array()}};
  for (const MassAdjustment& step : rra.mass_steps) {
    audit["mass_steps"].push_back(auditAdjustment(step));
  }
  for (std::size_t i = 0; i < rra.passes.size(); ++i) {
    audit["passes"].push_back(auditPass(rra.passes[i], i + 1, rra.options.limits));
  }
  audit["warnings"] = rra.warnings;
  return audit;
}

Json summarizeRraPasses(const RraResult& rra) {
  Json passes = Json::array();
  for (const RraPassResult& pass : rra.passes) {
    passes.push_back(
        {{"mass_before_kg", toJsonNumber(pass.adjustment.mass_before)},
         {"mass_change_kg", toJsonNumber(pass.adjustment.mass_change)},
         {"center_shift_x_m", toJsonNumber(pass.adjustment.shift_x)},
         {"center_shift_z_m", toJsonNumber(pass.adjustment.shift_z)},
         {"average_residuals_before", summarizeResiduals(pass.adjustment.average_before)},
         {"average_residuals_after", summarizeResiduals(pass.adjustment.average_after)},
         {"peak_residuals", summarizeResiduals(pass.residuals.peak)},
         {"rms_residuals", summarizeResiduals(pass.residuals.rms)},
         {"tracking", summarizeTracking(findLargest(pass.deviations))},
         {"merit", toJsonNumber(pass.merit)},
         {"weights_changed", pass.weight_changes.size()},
         {"decision", pass.decision}});
  }
  return passes;
}

}  // namespace gaitmill
