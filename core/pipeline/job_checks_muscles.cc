// Quality of the stages that find muscle forces: static optimization and computed muscle control.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "core/pipeline/job_checks.h"
#include "core/pipeline/quality_rules.h"

namespace gaitmill {

namespace {

void add(const std::string& figure, double value, const std::string& worst, JobQuality& quality) {
  quality.checks.push_back(makeQualityCheck(figure, value, worst));
}

void checkFeasible(const char* stage, std::size_t infeasible, int all, JobQuality& quality) {
  const double share = all > 0 ? 100.0 * static_cast<double>(infeasible) / all : 0.0;
  add(std::string(stage) + "_infeasible", share, stage, quality);
}

double calcPercent(const JointReserve& reserve) {
  return 100 * reserve.peak / reserve.joint_moment;
}

void checkSaturation(const char* figure,
                     const std::vector<Saturation>& saturations,
                     JobQuality& quality) {
  const auto worst = std::max_element(
      saturations.begin(), saturations.end(), [](const Saturation& a, const Saturation& b) {
        return a.longest_span < b.longest_span;
      });
  if (worst != saturations.end()) {
    add(figure, 1000 * worst->longest_span, worst->longest_span > 0 ? worst->muscle : "", quality);
  }
}

/// The largest reserve against the largest moment of any joint.
void checkReserves(JobQuality& quality) {
  double largest_moment = 0;
  for (const JointReserve& reserve : quality.joint_reserves) {
    largest_moment = std::max(largest_moment, reserve.joint_moment);
  }
  if (largest_moment > 0) {
    const ActuatorStatistics& largest = findLargestPeak(quality.reserves);
    add("reserve_peak", 100 * largest.peak / largest_moment, largest.name, quality);
  }
  for (const JointReserve& reserve : quality.joint_reserves) {
    add("joint_reserve", calcPercent(reserve), reserve.actuator, quality);
  }
}

void checkMoments(JobQuality& quality) {
  for (const MomentComparison& moment : quality.moments) {
    add("moment_rmse", moment.rmse_percent_of_peak, moment.coordinate, quality);
    add("moment_peak_difference",
        moment.peak_difference_percent_of_peak,
        moment.coordinate,
        quality);
  }
}

/// Peak residual moment by the mass centre's height and the peak ground reaction.
void checkMomentShare(JobQuality& quality) {
  const double scale = quality.mass_center_height * quality.peak_reaction;
  std::vector<ActuatorStatistics> moments;
  for (const ActuatorStatistics& residual : quality.residuals) {
    if (residual.name[0] == 'M') {
      moments.push_back(residual);
    }
  }
  if (scale > 0 && moments.size() == 3) {
    const ActuatorStatistics& largest = findLargestPeak(moments);
    add("residual_moment_share", 100 * largest.peak / scale, largest.name, quality);
  }
}

/// All muscles together; the one that has the largest part in it is named.
void checkFibers(JobQuality& quality) {
  double share = 0;
  const FiberRange* worst = nullptr;
  for (const FiberRange& range : quality.fibers) {
    share += range.impulse_share;
    worst = worst == nullptr || range.impulse_share > worst->impulse_share ? &range : worst;
  }
  if (worst != nullptr) {
    add("fiber_length_share", 100 * share, share > 0 ? worst->muscle : "", quality);
  }
}

/// Shares of the work that muscles, actuators, residuals and ground do, whatever its sign.
void checkWork(const Job& job, JobQuality& quality) {
  if (!job.analysis) {
    return;
  }
  const WorkBalance& work = job.analysis->balance;
  const double all = std::abs(work.muscles) + std::abs(work.actuators) + std::abs(work.residuals) +
                     std::abs(work.ground);
  if (all > 0) {
    add("residual_work", 100 * std::abs(work.residuals) / all, "", quality);
    add("work_imbalance", 100 * std::abs(work.imbalance()) / all, "", quality);
  }
}

/// The mean over the channels; the one that agrees least is named.
void checkEmg(JobQuality& quality) {
  double sum = 0;
  int count = 0;
  const EmgComparison* worst = nullptr;
  for (const EmgComparison& channel : quality.emg) {
    if (std::isfinite(channel.overlap)) {
      sum += 1 - channel.overlap;
      ++count;
      worst = worst == nullptr || channel.overlap < worst->overlap ? &channel : worst;
    }
  }
  if (count > 0) {
    add("emg_timing", 100 * sum / count, worst->channel, quality);
  }
}

}  // namespace

void checkSo(const Job& job, JobQuality& quality) {
  if (!job.so) {
    return;
  }
  checkFeasible("so", job.so->infeasible_rows.size(), job.so->activations.rowCount(), quality);
  const std::vector<JointReserve>& reserves = quality.so_joint_reserves;
  const auto worst = std::max_element(
      reserves.begin(), reserves.end(), [](const JointReserve& a, const JointReserve& b) {
        return calcPercent(a) < calcPercent(b);
      });
  if (worst != reserves.end()) {
    add("so_joint_reserve", calcPercent(*worst), worst->actuator, quality);
    if (job.cmc) {
      // Static optimization has no passive fiber forces; muscle control, which has, decides.
      quality.checks.back().fail_above = std::numeric_limits<double>::infinity();
      quality.checks.back().fail_source = "";
    }
  }
  checkSaturation("so_saturation", quality.so_saturations, quality);
}

void checkCmc(const Job& job, JobQuality& quality) {
  if (!job.cmc) {
    return;
  }
  checkTracking("cmc", *quality.cmc_tracking, quality);
  checkResiduals("", quality.residuals, quality);
  checkMomentShare(quality);
  checkReserves(quality);
  checkMoments(quality);
  checkSaturation("saturation", quality.saturations, quality);
  checkFibers(quality);
  checkWork(job, quality);
  checkEmg(quality);
  checkFeasible("cmc", job.cmc->infeasible_windows.size(), job.cmc->counters.windows, quality);
  add("cmc_finished", job.cmc->stop == CmcStop::kDiverged ? 1 : 0, "", quality);
}

}  // namespace gaitmill
