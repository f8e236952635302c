#include "core/pipeline/quality_json.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "core/base/error.h"

namespace gaitmill {

namespace {

using Json = nlohmann::ordered_json;

Json summarizeMoment(const MomentComparison& moment) {
  return {{"rmse_nm", toJsonNumber(moment.rmse)},
          {"peak_difference_nm", toJsonNumber(moment.peak_difference)},
          {"rmse_percent_of_peak", toJsonNumber(moment.rmse_percent_of_peak)},
          {"peak_difference_percent_of_peak", toJsonNumber(moment.peak_difference_percent_of_peak)},
          {"peak_nm", toJsonNumber(moment.peak)},
          {"fraction_of_instants_at_90_percent", toJsonNumber(moment.fraction_at_90_percent)},
          {"worst_share", toJsonNumber(moment.worst_share)},
          {"worst_percent_of_cycle", toJsonNumber(moment.worst_percent)},
          {"instants", moment.instants}};
}

Json summarizeActuators(const std::vector<ActuatorStatistics>& statistics,
                        const std::vector<ActuatorSpec>& specs) {
  Json summary = Json::object();
  for (const ActuatorStatistics& entry : statistics) {
    std::string unit = "nm";
    for (const ActuatorSpec& spec : specs) {
      unit = spec.name == entry.name && spec.kind == ActuatorSpec::Kind::kPoint ? "n" : unit;
    }
    summary[entry.name] = {{"peak_" + unit, toJsonNumber(entry.peak)},
                           {"rms_" + unit, toJsonNumber(entry.rms)}};
  }
  return summary;
}

Json summarizeMarkers(const IkResult& ik) {
  return {{"mean_rms_m", toJsonNumber(ik.mean_rms)},
          {"max_rms_m", toJsonNumber(ik.max_rms)},
          {"max_error_m", toJsonNumber(ik.max_error)},
          {"max_error_marker", ik.max_error_marker},
          {"worst_frame_s", toJsonNumber(ik.worst_frame_time)}};
}

/// By marker: its errors over the trial and the frame of the largest one.
Json summarizeMarkerErrors(const std::vector<MarkerStatistics>& markers) {
  Json summary = Json::object();
  for (const MarkerStatistics& marker : markers) {
    summary[marker.marker] = {{"weight", marker.weight},
                              {"mean_m", toJsonNumber(marker.mean)},
                              {"rms_m", toJsonNumber(marker.rms)},
                              {"max_m", toJsonNumber(marker.max)},
                              {"max_frame", marker.max_frame},
                              {"max_time_s", toJsonNumber(marker.max_time)},
                              {"visible_percent", 100 * marker.visible_fraction}};
  }
  return summary;
}

Json summarizeJointReserves(const std::vector<JointReserve>& reserves) {
  Json summary = Json::object();
  for (const JointReserve& reserve : reserves) {
    summary[reserve.joint] = {
        {"actuator", reserve.actuator},
        {"peak_nm", toJsonNumber(reserve.peak)},
        {"joint_moment_nm", toJsonNumber(reserve.joint_moment)},
        {"percent_of_joint_moment", toJsonNumber(100 * reserve.peak / reserve.joint_moment)}};
  }
  return summary;
}

/// Muscles that were fully excited at all.
Json summarizeSaturations(const std::vector<Saturation>& saturations) {
  Json summary = Json::object();
  for (const Saturation& saturation : saturations) {
    if (saturation.longest_span > 0) {
      summary[saturation.muscle] = {{"longest_span_s", saturation.longest_span}};
    }
  }
  return summary;
}

/// Muscles whose fibers leave the range in which they give active force.
Json summarizeFibers(const std::vector<FiberRange>& fibers) {
  Json summary = Json::object();
  for (const FiberRange& range : fibers) {
    if (range.shortest < kShortestFiber || range.longest > kLongestFiber) {
      summary[range.muscle] = {
          {"shortest_optimal_lengths", toJsonNumber(range.shortest)},
          {"longest_optimal_lengths", toJsonNumber(range.longest)},
          {"percent_of_its_active_impulse_outside", 100 * range.outside_fraction}};
    }
  }
  return summary;
}

Json summarizeInfeasible(const CmcResult& cmc) {
  Json windows = Json::array();
  for (const InfeasibleWindow& window : cmc.infeasible_windows) {
    Json missing = Json::object();
    for (const InfeasibleWindow::Missing& entry : window.missing) {
      missing[entry.coordinate] = entry.force;
    }
    windows.push_back({{"time_s", window.time}, {"missing_nm", missing}});
  }
  return windows;
}

Json summarizeCheck(const QualityCheck& check) {
  Json summary = {{"stage", check.stage},
                  {"figure", check.figure},
                  {"worst", check.worst},
                  {"value", toJsonNumber(check.value)},
                  {"unit", check.unit},
                  {"limit", check.limit},
                  {"fail_above", toJsonNumber(check.fail_above)},
                  {"source", check.source},
                  {"fail_source", check.fail_source},
                  {"verdict", verdictName(check.judge())},
                  {"meaning", check.meaning}};
  if (check.judge() != Verdict::kPass) {
    summary["explanation"] = check.explain();
    summary["cause"] = check.cause;
    summary["fix"] = check.fix;
  }
  return summary;
}

/// The checks of one stage by name; empty if it has none.
Json summarizeStage(const std::string& stage, const std::vector<QualityCheck>& all) {
  std::vector<QualityCheck> checks;
  Json names = Json::array();
  Json reasons = Json::array();
  for (const QualityCheck& check : all) {
    if (check.stage != stage) {
      continue;
    }
    checks.push_back(check);
    names.push_back(check.figure);
    if (check.judge() != Verdict::kPass) {
      reasons.push_back(check.explain());
    }
  }
  if (checks.empty()) {
    return {};
  }
  return {{"verdict", verdictName(judgeAll(checks))}, {"checks", names}, {"reasons", reasons}};
}

/// The verdict, why, and every figure that it rests on.
void addVerdict(const std::vector<QualityCheck>& checks, Json& summary) {
  summary["verdict"] = verdictName(judgeAll(checks));
  summary["reasons"] = Json::array();
  summary["checks"] = Json::array();
  for (const QualityCheck& check : checks) {
    if (check.judge() != Verdict::kPass) {
      summary["reasons"].push_back(check.explain());
    }
    summary["checks"].push_back(summarizeCheck(check));
  }
  for (int i = 0; i < kStageCount; ++i) {
    const char* const stage = stageName(static_cast<Stage>(i));
    Json judged = summarizeStage(stage, checks);
    if (!judged.is_null()) {
      summary["stages"][stage] = std::move(judged);
    }
  }
}

void addMotion(const Job& job, const JobQuality& quality, Json& summary) {
  if (job.ik) {
    summary["markers"] = summarizeMarkers(*job.ik);
    summary["marker_errors"] = summarizeMarkerErrors(quality.markers);
  }
  if (job.rra) {
    summary["tracking"]["rra"] = summarizeTracking(*quality.rra_tracking);
    summary["rra_residuals"] =
        summarizeActuators(quality.rra_residuals, job.rra->options.actuators);
  }
}

void addStaticOptimization(const Job& job, const JobQuality& quality, Json& summary) {
  const std::vector<ActuatorSpec> actuators =
      makeActuators(job.settings.so_actuators, job.adjusted);
  summary["so_residuals"] = summarizeActuators(quality.so_residuals, actuators);
  summary["so_reserves"] = summarizeActuators(quality.so_reserves, actuators);
  summary["so_joint_reserves"] = summarizeJointReserves(quality.so_joint_reserves);
  summary["so_full_activations"] = summarizeSaturations(quality.so_saturations);
}

void addMuscleControl(const Job& job, const JobQuality& quality, Json& summary) {
  const std::vector<ActuatorSpec>& actuators = job.cmc->options.actuators;
  summary["tracking"]["cmc"] = summarizeTracking(*quality.cmc_tracking);
  summary["residuals"] = summarizeActuators(quality.residuals, actuators);
  summary["reserves"] = summarizeActuators(quality.reserves, actuators);
  summary["joint_reserves"] = summarizeJointReserves(quality.joint_reserves);
  summary["full_excitations"] = summarizeSaturations(quality.saturations);
  summary["fibers_out_of_range"] = summarizeFibers(quality.fibers);
  summary["mass_center_height_m"] = toJsonNumber(quality.mass_center_height);
  summary["infeasible_windows"] = summarizeInfeasible(*job.cmc);
}

}  // namespace

Json toJsonNumber(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json summarizeTracking(const TrackingError& error) {
  return {{"max_rms_deg", toJsonNumber(error.max_rms_deg)},
          {"max_deg", toJsonNumber(error.max_deg)},
          {"max_rms_cm", toJsonNumber(error.max_rms_cm)},
          {"max_cm", toJsonNumber(error.max_cm)},
          {"max_rms_centiradian", toJsonNumber(error.max_rms_centiradian)},
          {"worst_rotation", error.worst_rotation},
          {"worst_translation", error.worst_translation},
          {"worst_peak_rotation", error.worst_peak_rotation},
          {"worst_peak_translation", error.worst_peak_translation}};
}

Json summarizeQuality(const Job& job, const JobQuality& quality) {
  Json summary = Json::object();
  addVerdict(quality.checks, summary);
  addMotion(job, quality, summary);
  summary["peak_ground_reaction_n"] = toJsonNumber(quality.peak_reaction);
  if (job.so) {
    addStaticOptimization(job, quality, summary);
  }
  if (job.cmc) {
    addMuscleControl(job, quality, summary);
  }
  for (const MomentComparison& moment : quality.moments) {
    summary["moments"][moment.coordinate] = summarizeMoment(moment);
  }
  if (!quality.moments.empty()) {
    summary["moments"]["fraction_of_instants_at_90_percent"] =
        toJsonNumber(calcFractionAt90Percent(quality.moments));
  }
  return summary;
}

}  // namespace gaitmill
