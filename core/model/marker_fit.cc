#include "core/model/marker_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "core/base/error.h"
#include "core/base/where.h"

namespace gaitmill {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Damping that is always there, relative to the diagonal's mean: holds directions that nothing
/// observes. Far too small to move an observed coordinate or to slow its convergence.
constexpr double kMinDamping = 1e-10;
constexpr double kFirstDamping = 1e-4;
constexpr double kMaxDamping = 1e8;

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

MarkerFit::MarkerFit(const Model& model,
                     const FitTasks& tasks,
                     const std::vector<std::string>& available,
                     const MarkerFitOptions& options)
    : model_(model),
      options_(options),
      free_(model),
      movers_(model, free_),
      state_(model),
      q_(free_.count()),
      trial_(free_.count()),
      full_(model.coordinateCount()),
      gradient_(free_.count()),
      step_(free_.count()),
      step_lower_(free_.count()),
      step_upper_(free_.count()),
      gauss_newton_(free_.count(), free_.count()),
      newton_(free_.count(), free_.count()),
      damped_(free_.count(), free_.count()),
      moments_(3, model.coordinateCount()),
      columns_(3, model.coordinateCount()),
      step_qp_(free_.count()) {
  findMarkers(tasks, available);
  findTargets(tasks);
  findBounds(tasks);
  findHeld();
  const std::size_t n = names_.size();
  measured_.resize(3, static_cast<Eigen::Index>(n));
  residuals_.resize(3, static_cast<Eigen::Index>(n));
  errors_.setConstant(static_cast<Eigen::Index>(n), kNaN);
  active_weights_.resize(n);
  everything_.markers.assign(n, true);
  everything_.coordinates.assign(static_cast<std::size_t>(free_.count()), true);
}

BodyIndex MarkerFit::body(int marker) const {
  return BodyIndex(markers_[static_cast<std::size_t>(marker)].body);
}

void MarkerFit::findMarkers(const FitTasks& tasks, const std::vector<std::string>& available) {
  for (const MarkerWeight& task : tasks.markers) {
    require(std::isfinite(task.weight) && task.weight >= 0,
            ErrorCode::kInputValue,
            "the weight of a marker must be a finite number >= 0",
            atMarker(task.marker));
    const int index = model_.spec().findMarker(task.marker);
    if (task.weight == 0) {
      continue;
    }
    if (index < 0 || !contains(available, task.marker)) {
      unused_.push_back(task.marker);
      continue;
    }
    const MarkerSpec& marker = model_.spec().markers[static_cast<std::size_t>(index)];
    names_.push_back(task.marker);
    weights_.push_back(task.weight);
    markers_.push_back({model_.getBody(marker.body).value(), marker.location});
  }
  require(!names_.empty(),
          ErrorCode::kInputMarkers,
          "none of the measured markers is both in the model and weighted; the model's markers "
          "carry other names, or the marker set does not fit the file");
}

void MarkerFit::findTargets(const FitTasks& tasks) {
  for (const CoordinateTask& task : tasks.coordinates) {
    const CoordinateIndex index = model_.getCoordinate(task.coordinate);
    require(std::isfinite(task.weight) && task.weight >= 0,
            ErrorCode::kInputValue,
            "the weight of a coordinate must be a finite number >= 0",
            atCoordinate(task.coordinate));
    const int f = free_.findFree(index);
    if (f >= 0 && task.weight > 0) {
      const double value = task.value.value_or(model_.coordinate(index).default_value);
      targets_.push_back({f, task.weight, value});
    }
  }
}

void MarkerFit::findBounds(const FitTasks& tasks) {
  for (const CoordinateIndex c : free_.indices()) {
    rotates_.push_back(model_.motionKind(c) != MotionKind::kTranslational);
  }
  lower_.setConstant(free_.count(), -kInfinity);
  upper_.setConstant(free_.count(), kInfinity);
  for (int f = 0; f < free_.count(); ++f) {
    const CoordinateSpec& spec = model_.coordinate(free_.indices()[static_cast<std::size_t>(f)]);
    if (spec.clamped) {
      lower_[f] = spec.range_min;
      upper_[f] = spec.range_max;
    }
  }
  for (const CoordinateRange& range : tasks.ranges) {
    const int f = free_.findFree(model_.getCoordinate(range.coordinate));
    if (f >= 0) {
      lower_[f] = range.min;
      upper_[f] = range.max;
    }
  }
}

void MarkerFit::findHeld() {
  std::vector<bool> pulled(static_cast<std::size_t>(free_.count()), false);
  for (const FitMarker& marker : markers_) {
    if (marker.body >= 0) {
      for (const Mover& mover : movers_.of(BodyIndex(marker.body))) {
        pulled[static_cast<std::size_t>(mover.free)] = true;
      }
    }
  }
  for (const Target& target : targets_) {
    pulled[static_cast<std::size_t>(target.free)] = true;
  }
  for (int f = 0; f < free_.count(); ++f) {
    if (!pulled[static_cast<std::size_t>(f)]) {
      held_.push_back(model_.coordinate(free_.indices()[static_cast<std::size_t>(f)]).name);
    }
  }
}

MarkerFitSummary MarkerFit::solve(const Eigen::Ref<const Eigen::Matrix3Xd>& measured,
                                  Eigen::Ref<Eigen::VectorXd> q) {
  return solve(measured, everything_, q);
}

MarkerFitSummary MarkerFit::solve(const Eigen::Ref<const Eigen::Matrix3Xd>& measured,
                                  const FitScope& scope,
                                  Eigen::Ref<Eigen::VectorXd> q) {
  check(measured.cols() == measured_.cols(), "MarkerFit: measured markers in another number");
  scope_ = &scope;
  measured_ = measured;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const bool visible = measured_.col(static_cast<Eigen::Index>(i)).allFinite();
    active_weights_[i] = visible && scope.markers[i] ? weights_[i] : 0.0;
  }
  free_.pick(q, q_);
  for (int f = 0; f < free_.count(); ++f) {
    if (scope.coordinates[static_cast<std::size_t>(f)]) {
      q_[f] = std::clamp(q_[f], lower_[f], upper_[f]);
    }
  }
  const MarkerFitSummary summary = iterate();
  free_.expandPose(q_, q);
  storeErrors();
  return summary;
}

MarkerFitSummary MarkerFit::iterate() {
  MarkerFitSummary summary;
  summary.objective = evaluate(q_);
  const bool nothing_pulls =
      targets_.empty() && std::all_of(active_weights_.begin(),
                                      active_weights_.end(),
                                      [](double weight) { return weight == 0; });
  if (nothing_pulls) {
    summary.stop = FitStop::kConverged;
    return summary;
  }
  double damping = kFirstDamping;
  while (summary.iterations < options_.max_iterations) {
    ++summary.iterations;
    linearize();
    if (!descend(damping, summary.objective)) {
      evaluate(q_);
      summary.stop = FitStop::kStalled;
      return summary;
    }
    q_ = trial_;
    if (step_.lpNorm<Eigen::Infinity>() < options_.step_tolerance) {
      summary.stop = FitStop::kConverged;
      return summary;
    }
  }
  return summary;
}

// Newton's step where the model is convex and the step lowers the objective, else Gauss-Newton's,
// else with more damping.
bool MarkerFit::descend(double& damping, double& objective) {
  bool newton = true;
  while (damping < kMaxDamping) {
    const bool solved = newton ? calcStep(newton_, kMinDamping) : calcStep(gauss_newton_, damping);
    if (solved) {
      limitStep();
      trial_ = q_ + step_;
      const double slope = gradient_.dot(step_);
      const double reached = evaluate(trial_);
      // Below this the objective cannot tell better from worse, but Newton's step still can.
      const bool at_rounding = std::abs(slope) <= 1e-13 * objective ||
                               step_.lpNorm<Eigen::Infinity>() < options_.step_tolerance;
      if (reached <= objective + 1e-4 * slope || at_rounding) {
        objective = reached;
        damping = std::max(damping * 0.1, kMinDamping);
        return true;
      }
    }
    damping *= newton ? 1.0 : 10.0;
    newton = false;
  }
  return false;
}

double MarkerFit::evaluate(const Eigen::VectorXd& q_free) {
  free_.expandPose(q_free, full_);
  state_.setPose(full_);
  double objective = 0;
  for (std::size_t i = 0; i < markers_.size(); ++i) {
    if (active_weights_[i] == 0) {
      continue;
    }
    const auto column = static_cast<Eigen::Index>(i);
    const Eigen::Vector3d p_GM = state_.pose(BodyIndex(markers_[i].body)) * markers_[i].location;
    residuals_.col(column) = p_GM - measured_.col(column);
    objective += active_weights_[i] * residuals_.col(column).squaredNorm();
  }
  for (const Target& target : targets_) {
    const double error = q_free[target.free] - target.value;
    objective += target.weight * error * error;
  }
  return objective;
}

// Gradient and Hessians of half the objective at the pose of the state.
void MarkerFit::linearize() {
  gradient_.setZero();
  gauss_newton_.setZero();
  moments_.setZero();
  for (std::size_t i = 0; i < markers_.size(); ++i) {
    if (active_weights_[i] > 0 && markers_[i].body >= 0) {
      addMarker(i);
    }
  }
  for (const Target& target : targets_) {
    gradient_[target.free] += target.weight * (q_[target.free] - target.value);
    gauss_newton_(target.free, target.free) += target.weight;
  }
  newton_ = gauss_newton_;
  addSecondDerivatives();
  setStepBounds();
}

void MarkerFit::addMarker(std::size_t marker) {
  const FitMarker& m = markers_[marker];
  const double weight = active_weights_[marker];
  const Eigen::Vector3d residual = residuals_.col(static_cast<Eigen::Index>(marker));
  const Eigen::Vector3d p_GM = residual + measured_.col(static_cast<Eigen::Index>(marker));
  const Matrix6X& screws = state_.screws();
  const std::vector<Mover>& movers = movers_.of(BodyIndex(m.body));
  // dx/dq of each mover, and J'W J, J'W r on the fly.
  for (std::size_t a = 0; a < movers.size(); ++a) {
    const int c = movers[a].coordinate;
    const Eigen::Vector3d velocity =
        screws.col(c).tail<3>() + Eigen::Vector3d(screws.col(c).head<3>()).cross(p_GM);
    columns_.col(static_cast<Eigen::Index>(a)) = movers[a].slope * velocity;
    moments_.col(c) += weight * velocity.cross(residual);
    gradient_[movers[a].free] += weight * columns_.col(static_cast<Eigen::Index>(a)).dot(residual);
    for (std::size_t b = 0; b <= a; ++b) {
      const double product = weight * columns_.col(static_cast<Eigen::Index>(a))
                                          .dot(columns_.col(static_cast<Eigen::Index>(b)));
      const auto [low, high] = std::minmax(movers[a].free, movers[b].free);
      gauss_newton_(high, low) += low == high && a != b ? 2 * product : product;
    }
  }
}

// sum_i w_i r_i . d2x_i/dq_j dq_k = w_j . sum_i w_i (dx_i/dq_k x r_i) for j proximal to k.
void MarkerFit::addSecondDerivatives() {
  for (const auto& [j, k] : movers_.proximalPairs()) {
    const Mover& proximal = movers_.all()[j];
    const Mover& distal = movers_.all()[k];
    const double curvature =
        proximal.slope * distal.slope *
        state_.screws().col(proximal.coordinate).head<3>().dot(moments_.col(distal.coordinate));
    const auto [low, high] = std::minmax(proximal.free, distal.free);
    newton_(high, low) += low == high && j != k ? 2 * curvature : curvature;
  }
}

void MarkerFit::setStepBounds() {
  for (int f = 0; f < free_.count(); ++f) {
    const bool moves = scope_->coordinates[static_cast<std::size_t>(f)];
    step_lower_[f] = moves ? lower_[f] - q_[f] : 0.0;
    step_upper_[f] = moves ? upper_[f] - q_[f] : 0.0;
  }
}

bool MarkerFit::calcStep(const Eigen::MatrixXd& hessian, double damping) {
  const double mean = gauss_newton_.diagonal().mean();
  damped_ = hessian;
  damped_.diagonal().array() += kMinDamping * mean;
  damped_.diagonal() += damping * gauss_newton_.diagonal();
  return step_qp_.solve(damped_, gradient_, step_lower_, step_upper_, step_);
}

// Shortens the whole step, so that it stays inside the bounds.
void MarkerFit::limitStep() {
  double longest = 0;
  for (int f = 0; f < free_.count(); ++f) {
    if (rotates_[static_cast<std::size_t>(f)]) {
      longest = std::max(longest, std::abs(step_[f]));
    }
  }
  if (longest > options_.max_rotation_step) {
    step_ *= options_.max_rotation_step / longest;
  }
}

void MarkerFit::storeErrors() {
  for (std::size_t i = 0; i < markers_.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const Eigen::Vector3d p_GM = state_.pose(BodyIndex(markers_[i].body)) * markers_[i].location;
    const double distance = (p_GM - measured_.col(column)).norm();
    errors_[column] = std::isfinite(distance) ? distance : kNaN;
  }
}

double MarkerFit::calcObservability() const {
  std::vector<int> inside;
  for (int f = 0; f < free_.count(); ++f) {
    const std::string& name = model_.coordinate(free_.indices()[static_cast<std::size_t>(f)]).name;
    if (q_[f] > lower_[f] && q_[f] < upper_[f] && !contains(held_, name)) {
      inside.push_back(f);
    }
  }
  double total_weight = 0;
  for (const double weight : active_weights_) {
    total_weight += weight;
  }
  const auto n = static_cast<Eigen::Index>(inside.size());
  Eigen::MatrixXd normal(n, n);
  for (Eigen::Index a = 0; a < n; ++a) {
    for (Eigen::Index b = 0; b <= a; ++b) {
      normal(a, b) =
          gauss_newton_(inside[static_cast<std::size_t>(a)], inside[static_cast<std::size_t>(b)]);
    }
  }
  if (n == 0 || total_weight == 0) {
    return kNaN;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(normal, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[0] / total_weight;
}

}  // namespace gaitmill
