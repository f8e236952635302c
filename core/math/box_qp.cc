#include "core/math/box_qp.h"

#include <cstddef>

#include <Eigen/Cholesky>

namespace gaitmill {

struct BoxQp::Problem {
  const Eigen::Ref<const Eigen::MatrixXd>& hessian;
  const Eigen::Ref<const Eigen::VectorXd>& gradient;
  const Eigen::Ref<const Eigen::VectorXd>& lower;
  const Eigen::Ref<const Eigen::VectorXd>& upper;
  Eigen::Ref<Eigen::VectorXd>& x;

  double entry(int row, int column) const {
    return row >= column ? hessian(row, column) : hessian(column, row);
  }
};

BoxQp::BoxQp(int size)
    : size_(size),
      fixed_(static_cast<std::size_t>(size), false),
      reduced_(size, size),
      solution_(size) {
  unfixed_.reserve(static_cast<std::size_t>(size));
}

bool BoxQp::solve(const Eigen::Ref<const Eigen::MatrixXd>& hessian,
                  const Eigen::Ref<const Eigen::VectorXd>& gradient,
                  const Eigen::Ref<const Eigen::VectorXd>& lower,
                  const Eigen::Ref<const Eigen::VectorXd>& upper,
                  Eigen::Ref<Eigen::VectorXd> x) {
  const Problem problem{hessian, gradient, lower, upper, x};
  x.setZero();
  fixInitially(problem);
  // Every round fixes or releases an unknown; a cycle is cut short with a feasible point.
  const int round_limit = 5 * size_ + 10;
  for (int round = 0; round < round_limit; ++round) {
    if (!solveUnfixed(problem)) {
      return false;
    }
    if (!clampViolators(problem) && !releaseWorst(problem)) {
      break;
    }
  }
  x = x.cwiseMax(lower).cwiseMin(upper);
  return true;
}

void BoxQp::fixInitially(const Problem& problem) {
  for (int i = 0; i < size_; ++i) {
    const bool at_lower = problem.lower[i] >= 0 && problem.gradient[i] > 0;
    const bool at_upper = problem.upper[i] <= 0 && problem.gradient[i] < 0;
    const bool no_room = problem.lower[i] >= problem.upper[i];
    fixed_[static_cast<std::size_t>(i)] = at_lower || at_upper || no_room;
  }
}

bool BoxQp::solveUnfixed(const Problem& problem) {
  unfixed_.clear();
  for (int i = 0; i < size_; ++i) {
    if (!fixed_[static_cast<std::size_t>(i)]) {
      unfixed_.push_back(i);
    }
  }
  const auto count = static_cast<Eigen::Index>(unfixed_.size());
  for (Eigen::Index a = 0; a < count; ++a) {
    const int i = unfixed_[static_cast<std::size_t>(a)];
    double right_side = -problem.gradient[i];
    for (int j = 0; j < size_; ++j) {
      right_side -= fixed_[static_cast<std::size_t>(j)] ? problem.entry(i, j) * problem.x[j] : 0.0;
    }
    solution_[a] = right_side;
    for (Eigen::Index b = 0; b <= a; ++b) {
      reduced_(a, b) = problem.entry(i, unfixed_[static_cast<std::size_t>(b)]);
    }
  }
  if (count == 0) {
    return true;
  }
  // In place, so that nothing is allocated.
  Eigen::Ref<Eigen::MatrixXd> block = reduced_.topLeftCorner(count, count);
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(block);
  if (factor.info() != Eigen::Success) {
    return false;
  }
  auto part = solution_.head(count);
  factor.solveInPlace(part);
  for (Eigen::Index a = 0; a < count; ++a) {
    problem.x[unfixed_[static_cast<std::size_t>(a)]] = solution_[a];
  }
  return true;
}

bool BoxQp::clampViolators(const Problem& problem) {
  bool clamped = false;
  for (const int i : unfixed_) {
    if (problem.x[i] < problem.lower[i] || problem.x[i] > problem.upper[i]) {
      problem.x[i] = problem.x[i] < problem.lower[i] ? problem.lower[i] : problem.upper[i];
      fixed_[static_cast<std::size_t>(i)] = true;
      clamped = true;
    }
  }
  return clamped;
}

bool BoxQp::releaseWorst(const Problem& problem) {
  int worst = -1;
  // A multiplier that is zero up to rounding does not ask for release.
  double worst_multiplier = 1e-14 * problem.gradient.lpNorm<Eigen::Infinity>();
  for (int i = 0; i < size_; ++i) {
    if (!fixed_[static_cast<std::size_t>(i)] || problem.lower[i] >= problem.upper[i]) {
      continue;
    }
    double slope = problem.gradient[i];
    for (int j = 0; j < size_; ++j) {
      slope += problem.entry(i, j) * problem.x[j];
    }
    // On the lower bound the slope must push down (>= 0), on the upper one up.
    const double inward = problem.x[i] <= problem.lower[i] ? -slope : slope;
    if (inward > worst_multiplier) {
      worst_multiplier = inward;
      worst = i;
    }
  }
  if (worst < 0) {
    return false;
  }
  fixed_[static_cast<std::size_t>(worst)] = false;
  return true;
}

}  // namespace gaitmill
