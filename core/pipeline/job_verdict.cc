// What makes a result trustworthy, in the figures that the field agreed on: Hicks et al. (2015),
// J Biomech Eng 137:020905, where it gives one; the paper's own bounds for muscles against inverse
// dynamics. Beyond twice a limit a result is not to be used.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "core/pipeline/job.h"

namespace gaitmill {

namespace {

constexpr double kFailFactor = 2;

constexpr double kMarkerRms = 2;         // [cm] largest of any frame
constexpr double kMarkerError = 4;       // [cm] of any marker
constexpr double kResidualForce = 25;    // [N], or
constexpr double kResidualShare = 0.05;  // of the peak ground reaction, whichever is larger
constexpr double kResidualMoment = 75;   // [N.m]
constexpr double kTrackingRms = 2;       // [deg] or [cm]
constexpr double kTrackingPeak = 5;      // [deg] or [cm]
constexpr double kReserveShare = 10;     // [%] of the largest joint moment
constexpr double kMomentRmse = 3;        // [%] of the joint's peak moment
constexpr double kMomentPeak = 11;       // [%]
constexpr double kInfeasible = 0;        // [%] of the windows or rows
constexpr double kInfeasibleFail = 5;    // [%]

constexpr const char* kHicks = "Hicks et al. 2015";
constexpr const char* kGuidance = "OpenSim guidance";
constexpr const char* kPaper = "Rajagopal et al. 2016";

QualityCheck makeCheck(
    const char* figure, const char* meaning, const char* unit, double limit, const char* source) {
  QualityCheck check;
  check.figure = figure;
  check.meaning = meaning;
  check.unit = unit;
  check.limit = limit;
  check.fail_above = kFailFactor * limit;
  check.source = source;
  return check;
}

void add(QualityCheck check, double value, const std::string& worst, JobQuality& quality) {
  check.value = value;
  check.worst = worst;
  quality.checks.push_back(std::move(check));
}

void checkMarkers(const IkResult& ik, JobQuality& quality) {
  add(makeCheck("marker_error_rms",
                "inverse kinematics misses the markers by an RMS of up to",
                "cm",
                kMarkerRms,
                kGuidance),
      100 * ik.max_rms,
      "",
      quality);
  add(makeCheck("marker_error_peak",
                "inverse kinematics misses a marker by",
                "cm",
                kMarkerError,
                kGuidance),
      100 * ik.max_error,
      ik.max_error_marker,
      quality);
}

void checkTracking(const char* stage, const TrackingError& error, JobQuality& quality) {
  const std::string name = stage;
  const auto check = [&](const char* kind, const char* unit, double limit) {
    QualityCheck one = makeCheck("", "", unit, limit, kGuidance);
    one.figure = name + "_tracking_" + kind;
    one.meaning = name + " departs from the motion by";
    return one;
  };
  add(check("rotation_rms", "deg", kTrackingRms), error.max_rms_deg, error.worst_rotation, quality);
  add(check("rotation_peak", "deg", kTrackingPeak), error.max_deg, "", quality);
  add(check("translation_rms", "cm", kTrackingRms),
      error.max_rms_cm,
      error.worst_translation,
      quality);
  add(check("translation_peak", "cm", kTrackingPeak), error.max_cm, "", quality);
}

double findPeakReaction(const GroundReaction& reaction) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(reaction.time.size()));
  for (const ExternalForce& force : reaction.forces) {
    sum += force.force.row(1).transpose();
  }
  return sum.size() > 0 ? sum.maxCoeff() : 0.0;
}

void checkResiduals(const TimeSeries& forces, const Job& job, JobQuality& quality) {
  const auto check = [&](const std::vector<std::string>& names, const QualityCheck& one) {
    const bool complete = std::all_of(names.begin(), names.end(), [&](const std::string& name) {
      return forces.findColumn(name).has_value();
    });
    if (complete) {
      const std::vector<ActuatorStatistics> statistics = calcActuatorStatistics(forces, names);
      const ActuatorStatistics& largest = findLargestPeak(statistics);
      add(one, largest.peak, largest.name, quality);
    }
  };
  const double force_limit =
      std::max(kResidualForce, kResidualShare * findPeakReaction(job.reaction));
  check({"FX", "FY", "FZ"},
        makeCheck("residual_force_peak",
                  "the residual force at the pelvis peaks at",
                  "N",
                  force_limit,
                  kHicks));
  check({"MX", "MY", "MZ"},
        makeCheck("residual_moment_peak",
                  "the residual moment at the pelvis peaks at",
                  "N.m",
                  kResidualMoment,
                  kHicks));
}

/// The largest reserve against the largest moment of any joint.
void checkReserves(const Job& job, JobQuality& quality) {
  if (quality.reserves.empty() || !job.id) {
    return;
  }
  double largest_moment = 0;
  for (const ActuatorSpec& actuator : job.cmc->options.actuators) {
    const TimeSeries& moments = job.id->generalized_forces;
    if (const std::optional<int> column = moments.findColumn(actuator.coordinate + "_moment")) {
      largest_moment = std::max(largest_moment, moments.values.col(*column).cwiseAbs().maxCoeff());
    }
  }
  const ActuatorStatistics& largest = findLargestPeak(quality.reserves);
  if (largest_moment > 0) {
    add(makeCheck(
            "reserve_peak",
            "a reserve actuator helps the muscles, in share of the largest joint moment, by up to",
            "%",
            kReserveShare,
            kHicks),
        100 * largest.peak / largest_moment,
        largest.name,
        quality);
  }
}

void checkMoments(JobQuality& quality) {
  for (const MomentComparison& moment : quality.moments) {
    add(makeCheck("moment_rmse",
                  "muscle moments differ from inverse dynamics, RMS in share of the peak, by",
                  "%",
                  kMomentRmse,
                  kPaper),
        moment.rmse_percent_of_peak,
        moment.coordinate,
        quality);
    add(makeCheck("moment_peak_difference",
                  "muscle moments differ from inverse dynamics, in share of the peak, by up to",
                  "%",
                  kMomentPeak,
                  kPaper),
        moment.peak_difference_percent_of_peak,
        moment.coordinate,
        quality);
  }
}

void checkFeasible(const char* stage, std::size_t infeasible, int all, JobQuality& quality) {
  QualityCheck check =
      makeCheck("",
                "the muscles cannot produce the motion, in share of all instants, at",
                "%",
                kInfeasible,
                "gaitmill");
  check.figure = std::string(stage) + "_infeasible";
  check.fail_above = kInfeasibleFail;
  add(check, all > 0 ? 100.0 * static_cast<double>(infeasible) / all : 0.0, stage, quality);
}

void checkFinished(const CmcResult& cmc, JobQuality& quality) {
  QualityCheck check = makeCheck("cmc_finished",
                                 "the forward simulation ran away from the motion before its end",
                                 "",
                                 0,
                                 "gaitmill");
  check.fail_above = 0;
  add(check, cmc.stop == CmcStop::kDiverged ? 1 : 0, "", quality);
}

}  // namespace

void addChecks(const Job& job, JobQuality& quality) {
  if (job.ik) {
    checkMarkers(*job.ik, quality);
  }
  if (quality.rra_tracking) {
    checkTracking("rra", *quality.rra_tracking, quality);
  }
  if (job.so) {
    checkFeasible("so", job.so->infeasible_rows.size(), job.so->activations.rowCount(), quality);
  }
  if (job.cmc) {
    checkTracking("cmc", *quality.cmc_tracking, quality);
    checkResiduals(job.cmc->actuator_force, job, quality);
    checkReserves(job, quality);
    checkMoments(quality);
    checkFeasible("cmc", job.cmc->infeasible_windows.size(), job.cmc->counters.windows, quality);
    checkFinished(*job.cmc, quality);
  } else if (job.rra) {
    checkResiduals(job.rra->passes.back().actuator_forces, job, quality);
  }
}

}  // namespace gaitmill
