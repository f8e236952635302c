// Quality of the stages that make the model and the motion: scale, inverse kinematics, inverse
// dynamics, residual reduction.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/pipeline/job_checks.h"
#include "core/pipeline/quality_rules.h"

namespace gaitmill {

namespace {

constexpr double kForceLimit = 25;    // [N] OpenSim checklist
constexpr double kForceShare = 0.05;  // of the peak ground reaction, Hicks et al. (2015)
constexpr const char* kAxes[] = {"x", "y", "z"};

/// A figure and who has it.
struct Worst {
  double value = -1;  ///< below every figure
  std::string name;
  void keep(double candidate, const std::string& whose) {
    if (candidate > value) {
      value = candidate;
      name = whose;
    }
  }
};

void add(const std::string& figure, const Worst& worst, JobQuality& quality) {
  // Where nothing is amiss nobody is to blame.
  const bool found = worst.value != 0;
  quality.checks.push_back(makeQualityCheck(figure, worst.value, found ? worst.name : ""));
}

/// How many percent a factor is away from 1, as much for 1/1.4 as for 1.4.
double calcFactorDeviation(double factor) {
  return 100 * (std::max(factor, 1 / factor) - 1);
}

const BodyScale* findOtherSide(const std::vector<BodyScale>& factors, const std::string& body) {
  if (body.size() < 2 || body.compare(body.size() - 2, 2, "_r") != 0) {
    return nullptr;
  }
  const std::string left = body.substr(0, body.size() - 1) + "l";
  const auto found = std::find_if(
      factors.begin(), factors.end(), [&](const BodyScale& other) { return other.body == left; });
  return found == factors.end() ? nullptr : &*found;
}

void checkFactors(const std::vector<BodyScale>& factors, JobQuality& quality) {
  Worst deviation, sides;
  for (const BodyScale& body : factors) {
    const BodyScale* other = findOtherSide(factors, body.body);
    for (int axis = 0; axis < 3; ++axis) {
      const std::string name = body.body + " " + kAxes[axis];
      deviation.keep(calcFactorDeviation(body.factors[axis]), name);
      if (other != nullptr) {
        sides.keep(calcFactorDeviation(body.factors[axis] / other->factors[axis]), name);
      }
    }
  }
  add("scale_factor_deviation", deviation, quality);
  if (!sides.name.empty()) {
    add("scale_side_difference", sides, quality);
  }
}

void checkPlacements(const std::vector<PlacementResult>& placements, JobQuality& quality) {
  Worst rms, peak;
  for (const PlacementResult& placement : placements) {
    rms.keep(100 * placement.rms, "");
    peak.keep(100 * placement.max_error, placement.worst_marker);
  }
  if (!placements.empty()) {
    add("static_pose_rms", {rms.value, ""}, quality);
    add("static_pose_peak", peak, quality);
  }
}

void checkGaps(const std::vector<MarkerStatistics>& markers, JobQuality& quality) {
  Worst gaps;
  for (const MarkerStatistics& marker : markers) {
    gaps.keep(100 * (1 - marker.visible_fraction), marker.marker);
  }
  if (!markers.empty()) {
    add("marker_gaps", gaps, quality);
  }
}

Worst findLargest(const TimeSeries& table, const std::vector<std::string>& columns) {
  Worst largest;
  for (const std::string& name : columns) {
    largest.keep(table.values.col(table.getColumn(name)).cwiseAbs().maxCoeff(), name);
  }
  return largest;
}

using Statistic = double ActuatorStatistics::*;

/// The largest of the three components; nothing unless all three are there.
std::optional<Worst> findLargest(const std::vector<ActuatorStatistics>& residuals,
                                 char kind,
                                 Statistic statistic) {
  Worst largest;
  int count = 0;
  for (const ActuatorStatistics& residual : residuals) {
    if (residual.name.size() == 2 && residual.name[0] == kind) {
      largest.keep(residual.*statistic, residual.name);
      ++count;
    }
  }
  return count == 3 ? std::optional(largest) : std::nullopt;
}

void raiseLimit(double limit, QualityCheck& check) {
  const double factor = check.fail_above / check.limit;
  check.limit = limit;
  check.fail_above = factor * limit;
}

void checkMassAdjustment(const Job& job, JobQuality& quality) {
  double mass = 0, x = 0, z = 0;
  for (const RraPassResult& pass : job.rra->passes) {
    mass += pass.adjustment.mass_change;
    x += pass.adjustment.shift_x;
    z += pass.adjustment.shift_z;
  }
  const double before = job.rra->passes.front().adjustment.mass_before;
  add("rra_mass_change", {100 * std::abs(mass) / before, ""}, quality);
  add("rra_center_shift", {100 * std::hypot(x, z), job.rra->options.adjusted_body}, quality);
}

}  // namespace

double findForceLimit(double peak_reaction) {
  return std::isnan(peak_reaction) ? kForceLimit
                                   : std::max(kForceLimit, kForceShare * peak_reaction);
}

void checkTracking(const char* stage, const TrackingError& error, JobQuality& quality) {
  const std::string figure = std::string(stage) + "_tracking_";
  add(figure + "rotation_rms", {error.max_rms_deg, error.worst_rotation}, quality);
  add(figure + "rotation_peak", {error.max_deg, error.worst_peak_rotation}, quality);
  add(figure + "translation_rms", {error.max_rms_cm, error.worst_translation}, quality);
  add(figure + "translation_peak", {error.max_cm, error.worst_peak_translation}, quality);
}

void checkResiduals(const char* prefix,
                    const std::vector<ActuatorStatistics>& residuals,
                    JobQuality& quality) {
  const std::string figure = std::string(prefix) + "residual_";
  const auto check = [&](const char* name, char kind, Statistic statistic) {
    if (const auto largest = findLargest(residuals, kind, statistic)) {
      add(figure + name, *largest, quality);
    }
  };
  if (const auto largest = findLargest(residuals, 'F', &ActuatorStatistics::peak)) {
    add(figure + "force_peak", *largest, quality);
    raiseLimit(findForceLimit(quality.peak_reaction), quality.checks.back());
  }
  check("force_rms", 'F', &ActuatorStatistics::rms);
  check("moment_peak", 'M', &ActuatorStatistics::peak);
  check("moment_rms", 'M', &ActuatorStatistics::rms);
}

void checkScale(const Job& job, JobQuality& quality) {
  if (job.scale) {
    checkPlacements(job.scale->placements, quality);
    checkFactors(job.scale->factors, quality);
  }
  const double mass = job.input->mass;
  if (mass > 0) {
    const double difference = std::abs(job.scaled.calcTotalMass() - mass);
    add("model_mass_difference", {100 * difference / mass, ""}, quality);
  }
}

void checkIk(const Job& job, JobQuality& quality) {
  if (!job.ik) {
    return;
  }
  add("marker_error_rms", {100 * job.ik->max_rms, ""}, quality);
  add("marker_error_peak", {100 * job.ik->max_error, job.ik->max_error_marker}, quality);
  checkGaps(quality.markers, quality);
  const double frames = job.ik->coordinates.rowCount();
  add("ik_unconverged", {100 * job.ik->unconverged_frames / frames, ""}, quality);
}

void checkId(const Job& job, JobQuality& quality) {
  if (!job.id || job.id->residual_wrench.columnCount() == 0) {
    return;
  }
  const TimeSeries& wrench = job.id->residual_wrench;
  add("id_residual_force_peak",
      findLargest(wrench, {"residual_force_x", "residual_force_y", "residual_force_z"}),
      quality);
  raiseLimit(findForceLimit(quality.peak_reaction), quality.checks.back());
  add("id_residual_moment_peak",
      findLargest(wrench, {"residual_moment_x", "residual_moment_y", "residual_moment_z"}),
      quality);
}

void checkRra(const Job& job, JobQuality& quality) {
  if (!job.rra) {
    return;
  }
  checkTracking("rra", *quality.rra_tracking, quality);
  const std::size_t first = quality.checks.size();
  checkResiduals("rra_", quality.rra_residuals, quality);
  // Names without a stage belong to the last simulation.
  for (std::size_t i = first; i < quality.checks.size() && !job.cmc; ++i) {
    quality.checks[i].figure.erase(0, std::string("rra_").size());
  }
  checkMassAdjustment(job, quality);
}

}  // namespace gaitmill
