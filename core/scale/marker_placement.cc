#include "core/scale/marker_placement.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/where.h"
#include "core/model/model.h"
#include "core/model/pose_search.h"
#include "core/scale/scale_factors.h"

namespace gaitmill {

namespace {

/// Mean position of one marker; NaN if it is never seen.
struct MeanPosition {
  Eigen::Vector3d position = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  double visible_fraction = 0;  ///< of the frames in the range
};

MeanPosition calcMean(const MarkerTrajectories& trial, int marker, const FrameRange& rows) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int seen = 0;
  for (int row = rows.first; row <= rows.last; ++row) {
    if (!trial.isMissing(row, marker)) {
      sum += trial.position(row, marker);
      ++seen;
    }
  }
  MeanPosition mean;
  mean.visible_fraction = static_cast<double>(seen) / (rows.last - rows.first + 1);
  if (seen > 0) {
    mean.position = sum / seen;
  }
  return mean;
}

void removeUnmeasured(const MarkerTrajectories& trial,
                      ModelSpec& model,
                      std::vector<std::string>& removed) {
  const auto unmeasured = [&](const MarkerSpec& marker) {
    return !trial.findMarker(marker.name).has_value();
  };
  for (const MarkerSpec& marker : model.markers) {
    if (unmeasured(marker)) {
      removed.push_back(marker.name);
    }
  }
  model.markers.erase(std::remove_if(model.markers.begin(), model.markers.end(), unmeasured),
                      model.markers.end());
}

Eigen::Matrix3Xd collectTargets(const MarkerFit& fit,
                                const MarkerTrajectories& trial,
                                const FrameRange& rows,
                                double min_visible_fraction) {
  Eigen::Matrix3Xd targets(3, static_cast<Eigen::Index>(fit.markers().size()));
  for (std::size_t m = 0; m < fit.markers().size(); ++m) {
    const MeanPosition mean = calcMean(trial, *trial.findMarker(fit.markers()[m]), rows);
    targets.col(static_cast<Eigen::Index>(m)) =
        mean.visible_fraction >= min_visible_fraction ? mean.position : MeanPosition{}.position;
  }
  return targets;
}

void storeErrors(const MarkerFit& fit, PlacementResult& result) {
  double total = 0;
  int count = 0;
  for (std::size_t m = 0; m < fit.markers().size(); ++m) {
    const double error = fit.errors()[static_cast<Eigen::Index>(m)];
    result.markers.push_back(fit.markers()[m]);
    result.errors.push_back(error);
    if (std::isnan(error)) {
      continue;
    }
    total += error * error;
    ++count;
    if (error > result.max_error) {
      result.max_error = error;
      result.worst_marker = fit.markers()[m];
    }
  }
  require(count > 0,
          ErrorCode::kInputMarkers,
          "no weighted marker is visible throughout the static pose");
  result.rms = std::sqrt(total / count);
}

void moveMarkers(const Model& fitted,
                 const Eigen::VectorXd& q,
                 const MarkerTrajectories& trial,
                 const FrameRange& rows,
                 ModelSpec& model,
                 std::vector<std::string>& moved) {
  ModelState state(fitted);
  state.setPose(q);
  for (MarkerSpec& marker : model.markers) {
    const MeanPosition mean = calcMean(trial, *trial.findMarker(marker.name), rows);
    if (marker.fixed || !mean.position.allFinite()) {
      continue;
    }
    const Pose& X_GB = state.pose(fitted.getBody(marker.body));
    marker.location = X_GB.R.transpose() * (mean.position - X_GB.p);
    moved.push_back(marker.name);
  }
}

}  // namespace

void addMarkers(const std::vector<MarkerSpec>& markers, ModelSpec& model) {
  for (const MarkerSpec& marker : markers) {
    require(marker.body == "ground" || model.findBody(marker.body) >= 0,
            ErrorCode::kModelReference,
            "marker '" + marker.name + "' sits on body '" + marker.body +
                "', which the model does not have",
            atMarker(marker.name));
    const int existing = model.findMarker(marker.name);
    if (existing >= 0) {
      model.markers[static_cast<std::size_t>(existing)] = marker;
    } else {
      model.markers.push_back(marker);
    }
  }
}

Eigen::VectorXd findStaticPose(const Model& model,
                               const PlacementSpec& placement,
                               const MarkerTrajectories& trial,
                               const MarkerFitOptions& options,
                               const std::optional<Eigen::VectorXd>& start) {
  const FrameRange rows = findFrameRange(trial.time, placement.range);
  MarkerFit fit(model, placement.tasks, trial.names, options);
  const Eigen::Matrix3Xd targets = collectTargets(fit, trial, rows, placement.min_visible_fraction);
  Eigen::VectorXd q = start.value_or(model.defaultPose());
  if (start) {
    fit.solve(targets, q);
  } else {
    PoseSearch(model, fit).solve(targets, q);
  }
  return q;
}

PlacementResult placeMarkers(const PlacementSpec& placement,
                             const MarkerTrajectories& trial,
                             const MarkerFitOptions& options,
                             ModelSpec& model) {
  PlacementResult result;
  removeUnmeasured(trial, model, result.removed_markers);
  const FrameRange rows = findFrameRange(trial.time, placement.range);
  const Model fitted(model);
  MarkerFit fit(fitted, placement.tasks, trial.names, options);
  Eigen::VectorXd q = fitted.defaultPose();
  const MarkerFitSummary summary =
      PoseSearch(fitted, fit)
          .solve(collectTargets(fit, trial, rows, placement.min_visible_fraction), q);
  result.iterations = summary.iterations;
  result.converged = summary.stop == FitStop::kConverged;
  storeErrors(fit, result);
  result.pose = makeTimeSeries(
      "static_pose", fitted.coordinateNames(), {trial.time[static_cast<std::size_t>(rows.first)]});
  result.pose.values.row(0) = q.transpose();
  for (int c = 0; c < fitted.coordinateCount(); ++c) {
    const bool is_length = fitted.motionKind(CoordinateIndex(c)) == MotionKind::kTranslational;
    result.pose.units.emplace_back(is_length ? "m" : "rad");
  }
  moveMarkers(fitted, q, trial, rows, model, result.moved_markers);
  return result;
}

}  // namespace gaitmill
