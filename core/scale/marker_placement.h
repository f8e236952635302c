#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/data/marker_set.h"
#include "core/data/marker_trajectories.h"
#include "core/data/model_spec.h"
#include "core/model/marker_fit.h"
#include "core/model/model.h"
#include "core/scale/scale_result.h"

namespace gaitmill {

/// Adds the laboratory's markers, replacing those of the same name.
/// @throws Error kModelReference if a marker names an unknown body
void addMarkers(const std::vector<MarkerSpec>& markers, ModelSpec& model);

/// Pose of the model in a static trial (spec/scale.md 4, steps 2 and 3).
/// @param start  (n_coordinates) where the fit begins; without one the pose is searched for
/// @throws Error kInputMarkers, kInputTimeRange
Eigen::VectorXd findStaticPose(const Model& model,
                               const PlacementSpec& placement,
                               const MarkerTrajectories& trial,
                               const MarkerFitOptions& options,
                               const std::optional<Eigen::VectorXd>& start = {});

/// Fits the model to a static pose and moves every marker that is not fixed onto its measured mean
/// (spec/scale.md 4). Markers that the file does not have are removed from the model. A marker that
/// is missing in too many frames of the range is moved to the mean of the others, but does not
/// pull. The model's default pose stays: it defines muscle lengths and measured distances.
/// @throws Error kInputMarkers, kInputTimeRange
PlacementResult placeMarkers(const PlacementSpec& placement,
                             const MarkerTrajectories& trial,
                             const MarkerFitOptions& options,
                             ModelSpec& model);

}  // namespace gaitmill
