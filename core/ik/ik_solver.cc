#include "core/ik/ik_solver.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"

namespace gaitmill {

namespace {

/// A frame whose error grows by more than this factor over the previous one, and beyond kJumpRms,
/// is searched afresh: after a gap the previous pose may lie behind a half turn.
constexpr double kJumpFactor = 2.0;
constexpr double kJumpRms = 0.05;  // [m]

enum ErrorColumn { kTotal, kRms, kMax, kWeighted };

std::pair<int, int> findFrames(const std::vector<double>& time, const TimeRange& range) {
  const TimeSeries axis{"markers", {}, {}, time, {}};
  require(!time.empty() && range.start <= time.back() && range.end >= time.front(),
          ErrorCode::kInputTimeRange,
          "no marker frame lies in the time range",
          {{}, 0, 0, "time_range_s"});
  return {axis.findNearestRow(std::max(range.start, time.front())),
          axis.findNearestRow(std::min(range.end, time.back()))};
}

std::string formatCentimetres(double metres) {
  return formatFixed(100 * metres, 1) + " cm";
}

std::string formatSeconds(double seconds) {
  return formatFixed(seconds, 3) + " s";
}

std::string join(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

IkResult makeResult(const Model& model, const MarkerFit& fit, std::vector<double> time) {
  IkResult result;
  result.coordinates = makeTimeSeries("coordinates", model.coordinateNames(), time);
  for (int c = 0; c < model.coordinateCount(); ++c) {
    const bool is_length = model.motionKind(CoordinateIndex(c)) == MotionKind::kTranslational;
    result.coordinates.units.emplace_back(is_length ? "m" : "rad");
  }
  result.errors = makeTimeSeries(
      "marker_errors",
      {"total_squared_error", "marker_error_RMS", "marker_error_max", "weighted_squared_error"},
      time);
  result.errors.units = {"m^2", "m", "m", "m^2"};
  result.marker_errors = makeTimeSeries("error_per_marker", fit.markers(), std::move(time));
  result.marker_errors.units.assign(fit.markers().size(), "m");
  const auto rows = static_cast<std::size_t>(result.coordinates.rowCount());
  result.worst_markers.resize(rows);
  result.visible_counts.assign(rows, 0);
  result.iterations.assign(rows, 0);
  result.markers = fit.markers();
  result.weights = fit.weights();
  result.unused_tasks = fit.unusedTasks();
  result.held_coordinates = fit.heldCoordinates();
  return result;
}

/// Fills the summary; returns the number of frames without a visible marker.
int summarize(IkResult& result) {
  double rms_total = 0;
  int seen = 0;
  std::size_t worst = 0;
  for (std::size_t row = 0; row < result.errors.time.size(); ++row) {
    const auto index = static_cast<Eigen::Index>(row);
    const double rms = result.errors.values(index, kRms);
    if (result.visible_counts[row] == 0) {
      continue;
    }
    ++seen;
    rms_total += rms;
    if (rms > result.max_rms) {
      result.max_rms = rms;
      result.worst_frame_time = result.errors.time[row];
    }
    if (result.errors.values(index, kMax) > result.max_error) {
      result.max_error = result.errors.values(index, kMax);
      worst = row;
    }
  }
  require(seen > 0, ErrorCode::kInputMarkers, "no weighted marker is visible in any frame");
  result.mean_rms = rms_total / seen;
  result.max_error_marker = result.worst_markers[worst];
  return static_cast<int>(result.errors.time.size()) - seen;
}

void warn(const IkOptions& options, int blind, IkResult& result) {
  std::vector<std::string>& warnings = result.warnings;
  if (result.max_rms > options.warn_rms) {
    warnings.push_back("markers are met to " + formatCentimetres(result.max_rms) + " RMS at " +
                       formatSeconds(result.worst_frame_time) + "; below " +
                       formatCentimetres(options.warn_rms) + " is usual");
  }
  if (result.max_error > options.warn_max) {
    warnings.push_back("marker " + result.max_error_marker + " is " +
                       formatCentimetres(result.max_error) + " from its measurement; below " +
                       formatCentimetres(options.warn_max) + " is usual");
  }
  if (!result.unused_tasks.empty()) {
    warnings.push_back("weighted markers that are not measured or not in the model: " +
                       join(result.unused_tasks));
  }
  if (!result.held_coordinates.empty()) {
    warnings.push_back("no marker observes these coordinates, they are held at their default: " +
                       join(result.held_coordinates));
  }
  if (blind > 0) {
    warnings.push_back(std::to_string(blind) +
                       " frames show no weighted marker; they repeat the pose before them");
  }
  if (result.unconverged_frames > 0) {
    warnings.push_back(std::to_string(result.unconverged_frames) +
                       " frames did not converge to the tolerance");
  }
}

}  // namespace

IkSolver::IkSolver(const Model& model,
                   const IkOptions& options,
                   const std::vector<std::string>& marker_names)
    : model_(model),
      options_((options.validate(), options)),
      fit_(model, options.tasks, marker_names, options.fit),
      search_(model, fit_),
      measured_(3, static_cast<Eigen::Index>(fit_.markers().size())) {
  for (const std::string& name : fit_.markers()) {
    const auto found = std::find(marker_names.begin(), marker_names.end(), name);
    columns_.push_back(static_cast<int>(std::distance(marker_names.begin(), found)));
  }
}

MarkerFitSummary IkSolver::solveFrame(const Eigen::Ref<const Eigen::Matrix3Xd>& measured,
                                      Eigen::Ref<Eigen::VectorXd> q) {
  return fit_.solve(measured, q);
}

MarkerFitSummary IkSolver::searchFrame(const Eigen::Ref<const Eigen::Matrix3Xd>& measured,
                                       Eigen::Ref<Eigen::VectorXd> q) {
  return search_.solve(measured, q);
}

IkResult IkSolver::solve(const MarkerTrajectories& trajectories, const Progress& progress) {
  const auto [first, last] = findFrames(trajectories.time, options_.range);
  IkResult result = makeResult(
      model_, fit_, {trajectories.time.begin() + first, trajectories.time.begin() + last + 1});
  Eigen::VectorXd q = model_.defaultPose();
  const int rows = last - first + 1;
  for (int row = 0; row < rows; ++row) {
    reportProgress(progress, static_cast<double>(row) / rows);
    readFrame(trajectories, first + row);
    solveRow(row, q, result);
    if (row == 0) {
      result.observability = fit_.calcObservability();
    }
  }
  warn(options_, summarize(result), result);
  return result;
}

void IkSolver::readFrame(const MarkerTrajectories& trajectories, int frame) {
  for (std::size_t m = 0; m < columns_.size(); ++m) {
    measured_.col(static_cast<Eigen::Index>(m)) = trajectories.position(frame, columns_[m]);
  }
}

void IkSolver::solveRow(int row, Eigen::VectorXd& q, IkResult& result) {
  if (row == 0) {
    const MarkerFitSummary searched = search_.solve(measured_, q);
    storeRow(row, q, searched, result);
    return;
  }
  MarkerFitSummary summary = fit_.solve(measured_, q);
  storeRow(row, q, summary, result);
  const double rms = result.errors.values(row, kRms);
  if (rms > kJumpRms && rms > kJumpFactor * result.errors.values(row - 1, kRms)) {
    Eigen::VectorXd fresh = q;
    const MarkerFitSummary searched = search_.solve(measured_, fresh);
    if (searched.objective < summary.objective) {
      q = fresh;
      storeRow(row, q, searched, result);
    }
  }
}

void IkSolver::storeRow(int row,
                        const Eigen::VectorXd& q,
                        const MarkerFitSummary& summary,
                        IkResult& result) const {
  const auto index = static_cast<std::size_t>(row);
  double total = 0;
  double worst = 0;
  int visible = 0;
  for (std::size_t m = 0; m < columns_.size(); ++m) {
    const double error = fit_.errors()[static_cast<Eigen::Index>(m)];
    if (std::isnan(error)) {
      continue;
    }
    ++visible;
    total += error * error;
    if (error >= worst) {
      worst = error;
      result.worst_markers[index] = fit_.markers()[m];
    }
  }
  result.coordinates.values.row(row) = q.transpose();
  result.marker_errors.values.row(row) = fit_.errors().transpose();
  result.errors.values(row, kTotal) = total;
  if (visible > 0) {
    result.errors.values(row, kRms) = std::sqrt(total / visible);
    result.errors.values(row, kMax) = worst;
  }
  result.errors.values(row, kWeighted) = summary.objective;
  result.visible_counts[index] = visible;
  result.iterations[index] = summary.iterations;
  result.unconverged_frames += summary.stop == FitStop::kConverged ? 0 : 1;
}

}  // namespace gaitmill
