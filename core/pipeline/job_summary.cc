#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/pipeline/decisions_json.h"
#include "core/pipeline/gait_reading.h"
#include "core/pipeline/job.h"
#include "core/pipeline/job_emg.h"
#include "core/pipeline/quality_json.h"
#include "core/pipeline/rra_audit.h"

namespace gaitmill {

namespace {

using Json = nlohmann::ordered_json;

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

Json summarizeMotionFit(const MotionFitResult& fit) {
  Json sizes = Json::array();
  for (const SizeEstimate& size : fit.sizes) {
    sizes.push_back({{"name", size.name},
                     {"factor", toJsonNumber(size.factor)},
                     {"expected", toJsonNumber(size.expected)},
                     {"deviations", toJsonNumber(size.deviations)},
                     {"at_bound", size.at_bound}});
  }
  Json offsets = Json::array();
  for (const OffsetEstimate& offset : fit.offsets) {
    offsets.push_back({{"marker", offset.marker},
                       {"distance_m", toJsonNumber(offset.distance)},
                       {"deviations", toJsonNumber(offset.deviations)}});
  }
  return {{"frames_s", fit.times},
          {"converged", fit.converged},
          {"iterations", fit.iterations},
          {"frames_rms_before_m", toJsonNumber(fit.frames_rms_before)},
          {"frames_rms_m", toJsonNumber(fit.frames_rms)},
          {"motion_rms_before_m", toJsonNumber(fit.motion_rms_before)},
          {"motion_rms_m", toJsonNumber(fit.motion_rms)},
          {"sizes", sizes},
          {"offsets", offsets}};
}

Json summarizeScale(const ScaleResult& scale) {
  Json factors = Json::object();
  for (const BodyScale& body : scale.factors) {
    factors[body.body] = {body.factors.x(), body.factors.y(), body.factors.z()};
  }
  Json placements = Json::array();
  for (const PlacementResult& placement : scale.placements) {
    placements.push_back({{"rms_m", toJsonNumber(placement.rms)},
                          {"max_error_m", toJsonNumber(placement.max_error)},
                          {"worst_marker", placement.worst_marker}});
  }
  Json summary = {{"method", scale.motion ? "motion" : "static"},
                  {"factors", factors},
                  {"mass_kg", toJsonNumber(scale.mass)},
                  {"placements", placements}};
  if (scale.motion) {
    summary["motion_fit"] = summarizeMotionFit(*scale.motion);
  }
  return summary;
}

Json summarizeSubject(const Job& job) {
  const double mass = job.input->mass > 0 ? job.input->mass : job.adjusted.calcTotalMass();
  return {{"mass_kg", toJsonNumber(mass)},
          {"height_m", job.input->height > 0 ? Json(job.input->height) : Json(nullptr)}};
}

Json summarizeWork(const WorkBalance& work) {
  return {{"interval_s", {work.start, work.end}},
          {"muscles_j", toJsonNumber(work.muscles)},
          {"actuators_j", toJsonNumber(work.actuators)},
          {"residuals_j", toJsonNumber(work.residuals)},
          {"ground_reactions_j", toJsonNumber(work.ground)},
          {"energy_change_j", toJsonNumber(work.energy_change)},
          {"imbalance_j", toJsonNumber(work.imbalance())}};
}

Json summarizeEvents(const std::vector<GaitEvent>& events) {
  Json list = Json::array();
  for (const GaitEvent& event : events) {
    list.push_back(
        {{"kind", event.kind == GaitEvent::Kind::kFootStrike ? "foot_strike" : "toe_off"},
         {"foot", footName(event.foot)},
         {"time_s", event.time},
         {"source", event.source == GaitEvent::Source::kForces ? "forces" : "markers"},
         {"marker_difference_s", toJsonNumber(event.marker_difference)}});
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

Json summarizeFaults(const MarkerRepair& repair) {
  Json list = Json::array();
  for (const MarkerFault& fault : repair.faults) {
    list.push_back({{"fault", faultName(fault.kind)},
                    {"action", actionName(fault.action)},
                    {"marker", fault.marker},
                    {"other", fault.other.empty() ? Json(nullptr) : Json(fault.other)},
                    {"start_s", toJsonNumber(fault.start)},
                    {"end_s", toJsonNumber(fault.end)},
                    {"frames", fault.last_frame - fault.first_frame + 1},
                    {"size_m", toJsonNumber(fault.size)}});
  }
  return list;
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
    summary["rra_passes"] = summarizeRraPasses(*job.rra);
    summary["rra"] = auditRra(*job.rra);
  }
  if (const std::optional<GaitCycle> cycle = findGaitCycle(job)) {
    summary["gait_cycle_s"] = {cycle->start, cycle->end};
  }
  summary["subject"] = summarizeSubject(job);
  summary["events"] = summarizeEvents(job.gait.events);
  summary["gait"] = Json::parse(describeAsJson(job.gait));
  summary["cycles"] = {{"right", summarizeCycles(findGaitCycles(job, Foot::kRight))},
                       {"left", summarizeCycles(findGaitCycles(job, Foot::kLeft))}};
  if (job.analysis) {
    summary["work"] = summarizeWork(job.analysis->balance);
  }
  if (job.emg) {
    summary["emg"] = summarizeEmg(job);
  }
  summary["decisions"] = Json::parse(describeAsJson(job.decisions));
  summary["marker_faults"] = summarizeFaults(job.marker_repair);
  summary["settings_used"] = Json::parse(writeSettings(job.settings));
  summary["warnings"] = job.warnings;
  return summary.dump(2) + "\n";
}

}  // namespace gaitmill
