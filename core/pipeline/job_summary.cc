#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/analysis/actuator_statistics.h"
#include "core/analysis/moment_comparison.h"
#include "core/analysis/tracking_error.h"
#include "core/pipeline/job.h"

namespace gaitmill {

namespace {

using Json = nlohmann::ordered_json;

/// JSON has no NaN: a figure that does not exist is null.
Json toJson(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json summarizeMoment(const MomentComparison& moment) {
  return {{"rmse_nm", toJson(moment.rmse)},
          {"peak_difference_nm", toJson(moment.peak_difference)},
          {"rmse_percent_of_peak", toJson(moment.rmse_percent_of_peak)},
          {"peak_difference_percent_of_peak", toJson(moment.peak_difference_percent_of_peak)},
          {"peak_nm", toJson(moment.peak)},
          {"fraction_of_instants_at_90_percent", toJson(moment.fraction_at_90_percent)},
          {"worst_share", toJson(moment.worst_share)},
          {"worst_percent_of_cycle", toJson(moment.worst_percent)},
          {"instants", moment.instants}};
}

Json summarizeTracking(const TrackingError& error) {
  return {{"max_rms_deg", toJson(error.max_rms_deg)},
          {"max_deg", toJson(error.max_deg)},
          {"max_rms_cm", toJson(error.max_rms_cm)},
          {"max_cm", toJson(error.max_cm)},
          {"max_rms_centiradian", toJson(error.max_rms_centiradian)},
          {"worst_rotation", error.worst_rotation},
          {"worst_translation", error.worst_translation}};
}

Json summarizeActuators(const std::vector<ActuatorStatistics>& statistics,
                        const std::vector<ActuatorSpec>& specs) {
  Json summary = Json::object();
  for (const ActuatorStatistics& entry : statistics) {
    std::string unit = "nm";
    for (const ActuatorSpec& spec : specs) {
      unit = spec.name == entry.name && spec.kind == ActuatorSpec::Kind::kPoint ? "n" : unit;
    }
    summary[entry.name] = {{"peak_" + unit, toJson(entry.peak)},
                           {"rms_" + unit, toJson(entry.rms)}};
  }
  return summary;
}

Json summarizeStages(const Job& job) {
  Json stages = Json::object();
  for (int i = 0; i < kStageCount; ++i) {
    const Stage stage = static_cast<Stage>(i);
    if (job.ran(stage)) {
      stages[stageName(stage)]["seconds"] = job.seconds[static_cast<std::size_t>(i)];
    }
  }
  if (job.ik) {
    stages["ik"]["frames"] = job.ik->coordinates.rowCount();
  }
  if (job.rra) {
    stages["rra"]["passes"] = job.rra->passes.size();
  }
  if (job.id) {
    stages["id"]["frames"] = job.id->generalized_forces.rowCount();
  }
  if (job.so) {
    stages["so"]["frames"] = job.so->activations.rowCount();
  }
  if (job.cmc) {
    const double simulated = job.cmc->pose.time.back() - job.cmc->pose.time.front();
    stages["cmc"]["simulated_seconds"] = simulated;
    stages["cmc"]["real_time_factor"] =
        job.seconds[static_cast<std::size_t>(Stage::kCmc)] / simulated;
    stages["cmc"]["windows"] = job.cmc->counters.windows;
    stages["cmc"]["finished"] = job.cmc->stop == CmcStop::kFinished;
  }
  return stages;
}

Json summarizeMarkers(const IkResult& ik) {
  return {{"mean_rms_m", toJson(ik.mean_rms)},
          {"max_rms_m", toJson(ik.max_rms)},
          {"max_error_m", toJson(ik.max_error)},
          {"max_error_marker", ik.max_error_marker},
          {"worst_frame_s", toJson(ik.worst_frame_time)}};
}

Json summarizeScale(const ScaleResult& scale) {
  Json factors = Json::object();
  for (const BodyScale& body : scale.factors) {
    factors[body.body] = {body.factors.x(), body.factors.y(), body.factors.z()};
  }
  Json placements = Json::array();
  for (const PlacementResult& placement : scale.placements) {
    placements.push_back({{"rms_m", toJson(placement.rms)},
                          {"max_error_m", toJson(placement.max_error)},
                          {"worst_marker", placement.worst_marker}});
  }
  return {{"factors", factors}, {"mass_kg", toJson(scale.mass)}, {"placements", placements}};
}

Json summarizeResiduals(const ResidualSum& sum) {
  return {{"force_n", {sum.force.x(), sum.force.y(), sum.force.z()}},
          {"moment_nm", {sum.moment.x(), sum.moment.y(), sum.moment.z()}}};
}

Json summarizeRra(const RraResult& rra) {
  Json passes = Json::array();
  for (const RraPassResult& pass : rra.passes) {
    passes.push_back(
        {{"mass_before_kg", toJson(pass.adjustment.mass_before)},
         {"mass_change_kg", toJson(pass.adjustment.mass_change)},
         {"center_shift_x_m", toJson(pass.adjustment.shift_x)},
         {"center_shift_z_m", toJson(pass.adjustment.shift_z)},
         {"average_residuals_before", summarizeResiduals(pass.adjustment.average_before)},
         {"average_residuals_after", summarizeResiduals(pass.adjustment.average_after)},
         {"peak_residuals", summarizeResiduals(pass.residuals.peak)},
         {"tracking", summarizeTracking(calcTrackingError(pass.tracking_errors))}});
  }
  return passes;
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

Json summarizeSubject(const Job& job) {
  const double mass = job.input->mass > 0 ? job.input->mass : job.adjusted.calcTotalMass();
  return {{"mass_kg", toJson(mass)},
          {"height_m", job.input->height > 0 ? Json(job.input->height) : Json(nullptr)}};
}

Json summarizeWork(const WorkBalance& work) {
  return {{"interval_s", {work.start, work.end}},
          {"muscles_j", toJson(work.muscles)},
          {"actuators_j", toJson(work.actuators)},
          {"residuals_j", toJson(work.residuals)},
          {"ground_reactions_j", toJson(work.ground)},
          {"energy_change_j", toJson(work.energy_change)},
          {"imbalance_j", toJson(work.imbalance())}};
}

Json summarizeEvents(const std::vector<GaitEvent>& events) {
  Json list = Json::array();
  for (const GaitEvent& event : events) {
    list.push_back(
        {{"kind", event.kind == GaitEvent::Kind::kFootStrike ? "foot_strike" : "toe_off"},
         {"foot", event.foot == Foot::kRight ? "right" : "left"},
         {"time_s", event.time}});
  }
  return list;
}

Json summarizeCycles(const std::vector<GaitCycle>& cycles) {
  Json list = Json::array();
  for (const GaitCycle& cycle : cycles) {
    list.push_back({cycle.start, cycle.end});
  }
  return list;
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
    summary["checks"].push_back({{"figure", check.figure},
                                 {"worst", check.worst},
                                 {"value", toJson(check.value)},
                                 {"unit", check.unit},
                                 {"limit", check.limit},
                                 {"fail_above", check.fail_above},
                                 {"source", check.source},
                                 {"verdict", verdictName(check.judge())}});
  }
}

Json summarizeQuality(const Job& job, const JobQuality& quality) {
  Json summary = Json::object();
  addVerdict(quality.checks, summary);
  if (job.ik) {
    summary["markers"] = summarizeMarkers(*job.ik);
  }
  if (quality.rra_tracking) {
    summary["tracking"]["rra"] = summarizeTracking(*quality.rra_tracking);
  }
  if (job.cmc) {
    const std::vector<ActuatorSpec>& actuators = job.cmc->options.actuators;
    summary["tracking"]["cmc"] = summarizeTracking(*quality.cmc_tracking);
    summary["residuals"] = summarizeActuators(quality.residuals, actuators);
    summary["reserves"] = summarizeActuators(quality.reserves, actuators);
    summary["infeasible_windows"] = summarizeInfeasible(*job.cmc);
  }
  for (const MomentComparison& moment : quality.moments) {
    summary["moments"][moment.coordinate] = summarizeMoment(moment);
  }
  if (!quality.moments.empty()) {
    summary["moments"]["fraction_of_instants_at_90_percent"] =
        toJson(calcFractionAt90Percent(quality.moments));
  }
  return summary;
}

}  // namespace

std::string makeSummary(const Job& job, const JobQuality& quality) {
  Json summary;
  summary["settings"] = job.settings.name;
  summary["verdict"] = verdictName(judgeAll(quality.checks));
  summary["stages"] = summarizeStages(job);
  summary["quality"] = summarizeQuality(job, quality);
  if (job.scale) {
    summary["scale"] = summarizeScale(*job.scale);
  }
  if (job.rra) {
    summary["rra_passes"] = summarizeRra(*job.rra);
  }
  if (const std::optional<GaitCycle> cycle = findGaitCycle(job)) {
    summary["gait_cycle_s"] = {cycle->start, cycle->end};
  }
  summary["subject"] = summarizeSubject(job);
  summary["events"] = summarizeEvents(findGaitEvents(job));
  summary["cycles"] = {{"right", summarizeCycles(findGaitCycles(job, Foot::kRight))},
                       {"left", summarizeCycles(findGaitCycles(job, Foot::kLeft))}};
  if (job.analysis) {
    summary["work"] = summarizeWork(job.analysis->balance);
  }
  summary["settings_used"] = Json::parse(writeSettings(job.settings));
  summary["warnings"] = job.warnings;
  return summary.dump(2) + "\n";
}

}  // namespace gaitmill
