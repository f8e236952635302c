#include "core/math/diagonal_qp.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace gaitmill {
namespace {

// p = 1 gets this much curvature in x = F / s. Small enough to leave the vertices of the linear
// problem optimal, large enough to keep the dual's pieces apart.
constexpr double kLinearCurvature = 1e-3;
constexpr double kLinearExponent = 1.01;  // below it the cost counts as linear

// Penalty on squared scaled slack against the cost: the violation is minimal to its inverse.
constexpr double kElasticPenalty = 1e8;
// Keeps the Newton matrix definite where every force of a row sits on a bound.
constexpr double kRegularization = 1e-13;
// Steps longer than this many Newton steps mean that the dual rises without end.
constexpr int kMaxExpansions = 40;
constexpr int kMaxBisections = 60;
// The line search ends when the slope has fallen to this part of the initial one.
constexpr double kSlopeDrop = 0.5;
// Forces of a barrier problem: relative width below which a range counts as one value, and the
// relative change that ends the search for a root.
constexpr double kFixedRange = 1e-12;
constexpr double kForceRoundOff = 1e-15;

}  // namespace

DiagonalQp::DiagonalQp(int rows, int columns, const DiagonalQpOptions& options)
    : options_(options),
      B_(rows, columns),
      row_scale_(rows),
      target_(rows),
      force_scale_(columns),
      lower_(columns),
      upper_(columns),
      x_(columns),
      y_(columns),
      y_step_(columns),
      lambda_(rows),
      lambda_step_(rows),
      residual_(rows),
      multipliers_(Eigen::VectorXd::Zero(rows)),
      slack_(Eigen::VectorXd::Zero(rows)),
      hessian_(rows, rows),
      factor_(rows) {
  require(options.exponent >= 1, ErrorCode::kInputValue, "cost exponent must be at least 1");
  require(options.barrier >= 0 && (options.barrier == 0 || options.exponent == 2),
          ErrorCode::kInputValue,
          "a barrier must not be negative and needs the cost exponent 2");
}

void DiagonalQp::resetWarmStart() {
  multipliers_.setZero();
}

QpReport DiagonalQp::solve(const QpProblem& problem, Eigen::Ref<Eigen::VectorXd> F) {
  scale(problem);
  QpReport report;
  lambda_ = multipliers_.cwiseQuotient(row_scale_);
  if (iterate(Attempt::kRigid, report)) {
    report.stop = QpStop::kSolved;
  } else if (options_.elastic == ElasticMode::kWhenInfeasible) {
    lambda_.setZero();
    if (iterate(Attempt::kElastic, report)) report.stop = QpStop::kElastic;
  }
  for (int j = 0; j < x_.size(); ++j) {
    // Bounds are met to the last bit, scaling or not.
    F(j) = x_(j) <= lower_(j)   ? problem.lower(j)
           : x_(j) >= upper_(j) ? problem.upper(j)
                                : x_(j) * force_scale_(j);
  }
  slack_ = problem.c;
  slack_.noalias() -= problem.A * F;
  report.residual = slack_.lpNorm<Eigen::Infinity>();
  // Multipliers of a violated row have no meaning for the next instant.
  if (report.stop == QpStop::kSolved) {
    multipliers_ = lambda_.cwiseProduct(row_scale_);
  } else {
    multipliers_.setZero();
  }
  return report;
}

void DiagonalQp::scale(const QpProblem& problem) {
  const int rows = static_cast<int>(B_.rows());
  check(problem.rows() == rows && problem.columns() == B_.cols(),
        "the QP has another size than its solver");
  for (int j = 0; j < B_.cols(); ++j) {
    const double weight = problem.weight(j);
    force_scale_(j) =
        options_.exponent == 2 ? 1 / std::sqrt(weight) : std::pow(weight, -1 / options_.exponent);
    B_.col(j) = problem.A.col(j) * force_scale_(j);
    lower_(j) = problem.lower(j) / force_scale_(j);
    upper_(j) = problem.upper(j) / force_scale_(j);
  }
  for (int i = 0; i < rows; ++i) {
    const double square = 0.5 * B_.row(i).squaredNorm();
    row_scale_(i) = square > 0 ? 1 / std::sqrt(square) : 1.0;
  }
  B_.array().colwise() *= row_scale_.array();
  target_ = problem.c.cwiseProduct(row_scale_);
}

// Root of 2 x - y - mu/(x - lower) + mu/(upper - x), which increases from one bound to the other.
double DiagonalQp::calcBarrierForce(int j, double y) const {
  double low = lower_(j);
  double high = upper_(j);
  const double mu = options_.barrier;
  const double lowest = low;
  const double highest = high;
  if (!std::isfinite(lowest) && !std::isfinite(highest)) return 0.5 * y;
  const double size = std::max(1.0, std::min(std::abs(low), std::abs(high)));
  if (high - low <= kFixedRange * size) return low;
  // With one bound alone the distance to it is the root of a quadratic; the other bound can only
  // push further, so these two points bracket the root.
  const auto distance = [mu](double q) {
    const double root = std::sqrt(q * q + 8 * mu);
    return q > 0 ? 0.25 * (q + root) : 2 * mu / (root - q);
  };
  if (std::isfinite(highest)) low = std::max(low, highest - distance(2 * highest - y));
  if (std::isfinite(lowest)) high = std::min(high, lowest + distance(y - 2 * lowest));
  if (!std::isfinite(lowest)) return low;
  if (!std::isfinite(highest)) return high;
  double x = y < lowest + highest ? high : low;
  if (x <= lowest || x >= highest) x = 0.5 * (low + high);
  for (int i = 0; i < kMaxBisections; ++i) {
    const double from_low = x - lowest;
    const double to_high = highest - x;
    const double value = 2 * x - y - mu / from_low + mu / to_high;
    (value > 0 ? high : low) = x;
    const double slope = 2 + mu / (from_low * from_low) + mu / (to_high * to_high);
    double next = x - value / slope;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    const double change = std::abs(next - x);
    x = next;
    if (change <= kForceRoundOff * std::max(1.0, std::abs(x))) break;
  }
  return x;
}

double DiagonalQp::calcForce(int j, double y) const {
  if (options_.barrier > 0) return calcBarrierForce(j, y);
  const double p = options_.exponent;
  double x = 0;
  if (p == 2) {
    x = 0.5 * y;
  } else if (p < kLinearExponent) {
    x = std::copysign(std::max(0.0, std::abs(y) - 1), y) / (2 * kLinearCurvature);
  } else {
    x = std::copysign(std::pow(std::abs(y) / p, 1 / (p - 1)), y);
  }
  return std::clamp(x, lower_(j), upper_(j));
}

double DiagonalQp::calcForceSlope(int j, double y) const {
  const double p = options_.exponent;
  const double x = calcForce(j, y);
  if (x <= lower_(j) || x >= upper_(j)) return 0;
  if (options_.barrier > 0) {
    const double from_low = x - lower_(j);
    const double to_high = upper_(j) - x;
    return 1 / (2 + options_.barrier * (1 / (from_low * from_low) + 1 / (to_high * to_high)));
  }
  if (p == 2) return 0.5;
  if (p < kLinearExponent) return std::abs(y) > 1 ? 0.5 / kLinearCurvature : 0;
  // Infinite at zero for p > 2: held where x is too small to matter.
  const double magnitude = std::max(std::abs(x), 1e-5);
  return std::pow(magnitude, 2 - p) / (p * (p - 1));
}

void DiagonalQp::calcResidual(Attempt attempt) {
  y_.noalias() = B_.transpose() * lambda_;
  for (int j = 0; j < x_.size(); ++j) x_(j) = calcForce(j, y_(j));
  residual_ = target_;
  residual_.noalias() -= B_ * x_;
  if (attempt == Attempt::kElastic) residual_ -= lambda_ / kElasticPenalty;
}

bool DiagonalQp::calcDirection(Attempt attempt) {
  hessian_.setZero();
  for (int j = 0; j < B_.cols(); ++j) {
    const double slope = calcForceSlope(j, y_(j));
    if (slope == 0) continue;
    for (int k = 0; k < B_.rows(); ++k) {
      const double factor = slope * B_(k, j);
      if (factor == 0) continue;
      hessian_.col(k).tail(B_.rows() - k) += factor * B_.col(j).tail(B_.rows() - k);
    }
  }
  const double elasticity = attempt == Attempt::kElastic ? 1 / kElasticPenalty : 0;
  const double floor = kRegularization * std::max(1.0, hessian_.diagonal().maxCoeff());
  hessian_.diagonal().array() += elasticity + floor;
  factor_.compute(hessian_);
  if (factor_.info() != Eigen::Success) return false;
  lambda_step_ = residual_;
  factor_.solveInPlace(lambda_step_);
  y_step_.noalias() = B_.transpose() * lambda_step_;
  return lambda_step_.allFinite();
}

// Derivative of the dual along the step: falls with the step, since the dual is concave.
double DiagonalQp::calcDualSlope(Attempt attempt, double step) const {
  double slope = target_.dot(lambda_step_);
  for (int j = 0; j < x_.size(); ++j) {
    if (y_step_(j) != 0) slope -= y_step_(j) * calcForce(j, y_(j) + step * y_step_(j));
  }
  if (attempt == Attempt::kElastic) {
    slope -= (lambda_.dot(lambda_step_) + step * lambda_step_.squaredNorm()) / kElasticPenalty;
  }
  return slope;
}

// Step length at which the dual's slope is at most half of the initial one, up or down; 0 if it
// never gets there.
double DiagonalQp::searchLine(Attempt attempt) const {
  const double small = kSlopeDrop * residual_.dot(lambda_step_);
  double below = 0;
  double above = 1;
  int expansions = 0;
  double slope = calcDualSlope(attempt, above);
  while (slope > small) {
    if (++expansions > kMaxExpansions) return 0;
    below = above;
    above *= 4;
    slope = calcDualSlope(attempt, above);
  }
  double step = above;
  for (int i = 0; i < kMaxBisections && std::abs(slope) > small; ++i) {
    step = below > 0 ? 0.5 * (below + above) : 0.25 * above;
    slope = calcDualSlope(attempt, step);
    (slope > small ? below : above) = step;
  }
  return step;
}

bool DiagonalQp::iterate(Attempt attempt, QpReport& report) {
  // The elastic residual carries round-off of multipliers that the penalty has blown up.
  const double tolerance = (attempt == Attempt::kElastic ? 1e2 : 1.0) * options_.tolerance *
                           std::max(1.0, target_.lpNorm<Eigen::Infinity>());
  calcResidual(attempt);
  for (int i = 0; i < options_.max_iterations; ++i) {
    if (residual_.lpNorm<Eigen::Infinity>() <= tolerance) return true;
    if (!calcDirection(attempt)) return false;
    const double step = searchLine(attempt);
    if (step == 0) return false;
    lambda_ += step * lambda_step_;
    calcResidual(attempt);
    ++report.iterations;
  }
  return residual_.lpNorm<Eigen::Infinity>() <= tolerance;
}

}  // namespace gaitmill
