#include "core/scale/scale_solver.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/model/model.h"
#include "core/scale/apply_scale.h"
#include "core/scale/marker_placement.h"
#include "core/scale/virtual_markers.h"

namespace gaitmill {

namespace {

/// Factors that change by less have settled (spec/scale.md 7).
constexpr double kFactorTolerance = 1e-4;
/// The published trials take five to fifteen rounds.
constexpr int kMaxPoseRounds = 40;

bool measuresInFittedPose(const MarkerSetSpec& set) {
  return std::any_of(set.measurements.begin(),
                     set.measurements.end(),
                     [](const MeasurementSpec& one) { return one.in_fitted_pose; });
}

double calcChange(const std::vector<BodyScale>& before, const std::vector<BodyScale>& after) {
  double change = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    change = std::max(change, (after[i].factors - before[i].factors).cwiseAbs().maxCoeff());
  }
  return change;
}

void warnOfPlacement(const ScaleOptions& options,
                     const PlacementResult& placement,
                     std::vector<std::string>& warnings) {
  if (placement.rms > options.warn_rms || placement.max_error > options.warn_max) {
    warnings.push_back("the static pose meets its markers to " +
                       formatFixed(100 * placement.rms, 1) + " cm RMS, " +
                       formatFixed(100 * placement.max_error, 1) + " cm at most (" +
                       placement.worst_marker + ")");
  }
  if (!placement.converged) {
    warnings.emplace_back("the fit of the static pose did not converge to its tolerance");
  }
}

}  // namespace

ScaleSolver::ScaleSolver(ModelSpec generic, ScaleOptions options)
    : generic_(std::move(generic)), options_(std::move(options)) {
  options_.validate();
  addMarkers(options_.marker_set.markers, generic_);
}

ScaleResult ScaleSolver::solve(const std::vector<MarkerTrajectories>& recorded) const {
  ScaleResult result;
  std::vector<MarkerTrajectories> static_poses = recorded;
  for (MarkerTrajectories& pose : static_poses) {
    addVirtualMarkers(options_.marker_set.virtual_markers, pose);
  }
  stretchModel(static_poses, result);
  finishSubject(options_, result.model);
  result.mass = result.model.calcTotalMass();
  place(static_poses, result);
  return result;
}

void ScaleSolver::stretchModel(const std::vector<MarkerTrajectories>& static_poses,
                               ScaleResult& result) const {
  require(!static_poses.empty() || options_.marker_set.measurements.empty(),
          ErrorCode::kInputMissing,
          "scaling by marker distances needs a static trial",
          {{}, 0, 0, "static"});
  const MarkerTrajectories nothing;
  ScaleFactors factors = findFactors(static_poses.empty() ? nothing : static_poses.front(), result);
  result.model = applyScaleFactors(generic_,
                                   factors.bodies,
                                   options_.marker_set.preserve_mass_distribution
                                       ? MassDistribution::kPreserved
                                       : MassDistribution::kFollowsVolume);
  result.factors = std::move(factors.bodies);
  result.measurements = std::move(factors.measurements);
  result.warnings = std::move(factors.warnings);
}

ScaleFactors ScaleSolver::findFactors(const MarkerTrajectories& pose, ScaleResult& result) const {
  if (!measuresInFittedPose(options_.marker_set)) {
    return calcScaleFactors(Model(generic_), pose, options_);
  }
  require(!options_.marker_set.placements.empty(),
          ErrorCode::kInputMissing,
          "measurements in the fitted pose need a placement that says how it is fitted",
          {{}, 0, 0, "placement"});
  ModelSpec bones = generic_;
  bones.muscles.clear();
  const Model model(bones);
  ScaleFactors factors;
  for (const BodySpec& body : bones.bodies) {
    factors.bodies.push_back(
        {body.name, Eigen::Vector3d::Constant(options_.marker_set.size_ratio)});
  }
  std::optional<Eigen::VectorXd> q;
  for (double change = 1; change > kFactorTolerance; ++result.pose_rounds) {
    if (result.pose_rounds == kMaxPoseRounds) {
      factors.warnings.push_back("the scale factors still change by " + std::to_string(change) +
                                 " after " + std::to_string(kMaxPoseRounds) +
                                 " rounds of scaling and fitting");
      break;
    }
    const Model sized(applyScaleFactors(bones, factors.bodies, MassDistribution::kPreserved));
    q = findStaticPose(sized, options_.marker_set.placements.front(), pose, options_.fit, q);
    const FittedModel fitted{sized, *q, factors.bodies};
    ScaleFactors next = calcScaleFactors(model, pose, options_, &fitted);
    change = calcChange(factors.bodies, next.bodies);
    factors = std::move(next);
  }
  return factors;
}

void ScaleSolver::place(const std::vector<MarkerTrajectories>& static_poses,
                        ScaleResult& result) const {
  for (std::size_t i = 0; i < options_.marker_set.placements.size(); ++i) {
    if (i >= static_poses.size()) {
      result.warnings.push_back("the marker set describes " +
                                std::to_string(options_.marker_set.placements.size()) +
                                " static poses, but only " + std::to_string(static_poses.size()) +
                                " were given; the others are left out");
      return;
    }
    result.placements.push_back(placeMarkers(
        options_.marker_set.placements[i], static_poses[i], options_.fit, result.model));
    warnOfPlacement(options_, result.placements.back(), result.warnings);
  }
}

void finishSubject(const ScaleOptions& options, ModelSpec& model) {
  if (options.subject_mass > 0) {
    setTotalMass(model, options.subject_mass, InertiaScaling::kWithMass);
  }
  for (MuscleSpec& muscle : model.muscles) {
    muscle.max_contraction_velocity =
        options.max_contraction_velocity.value_or(muscle.max_contraction_velocity);
    muscle.fiber_damping = options.fiber_damping.value_or(muscle.fiber_damping);
  }
}

}  // namespace gaitmill
