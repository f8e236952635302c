#include "core/math/bounded_least_squares.h"

#include <cmath>
#include <limits>

#include "core/base/error.h"

namespace gaitmill {
namespace {

// A multiplier must point inward by this part of the gradient's size to release its bound.
constexpr double kReleaseTolerance = 1e-10;
// Every factorization binds or releases one component; three times the unknowns is generous.
constexpr int kFactorizationsPerUnknown = 3;

}  // namespace

BoundedLeastSquares::BoundedLeastSquares(int rows, int columns)
    : places_(static_cast<std::size_t>(columns), Place::kFree),
      reduced_(rows, columns),
      right_(rows),
      candidate_(columns),
      gradient_(columns),
      misfit_(rows) {
  require(rows >= columns, ErrorCode::kInputValue, "least squares needs as many rows as unknowns");
  free_.reserve(static_cast<std::size_t>(columns));
}

BoundedLeastSquares::Report BoundedLeastSquares::solve(
    const Eigen::Ref<const Eigen::MatrixXd>& C,
    const Eigen::Ref<const Eigen::VectorXd>& d,
    const Eigen::Ref<const Eigen::VectorXd>& lower,
    const Eigen::Ref<const Eigen::VectorXd>& upper,
    Eigen::Ref<Eigen::VectorXd> x) {
  const int n = static_cast<int>(C.cols());
  Report report;
  for (Place& place : places_) place = Place::kFree;
  // Any feasible point starts the active set; it is replaced at once where no bound is active.
  x.setZero();
  x = x.cwiseMax(lower).cwiseMin(upper);

  while (report.factorizations < kFactorizationsPerUnknown * n + 1) {
    solveFree(C, d, x);
    ++report.factorizations;
    if (!stepToCandidate(lower, upper, x)) continue;
    if (!releaseOne(C, d, lower, upper, x)) {
      report.converged = true;
      break;
    }
  }
  report.active_bounds = n - static_cast<int>(free_.size());
  return report;
}

// Least squares over the free components with the others held: Householder QR column by column.
void BoundedLeastSquares::solveFree(const Eigen::Ref<const Eigen::MatrixXd>& C,
                                    const Eigen::Ref<const Eigen::VectorXd>& d,
                                    const Eigen::Ref<const Eigen::VectorXd>& x) {
  free_.clear();
  right_ = d;
  for (int j = 0; j < C.cols(); ++j) {
    if (places_[static_cast<std::size_t>(j)] != Place::kFree) {
      right_ -= x(j) * C.col(j);
      continue;
    }
    reduced_.col(static_cast<Eigen::Index>(free_.size())) = C.col(j);
    free_.push_back(j);
  }
  const int count = static_cast<int>(free_.size());
  for (int k = 0; k < count; ++k) reduceColumn(k, count);
  for (int k = count - 1; k >= 0; --k) {
    double sum = right_(k);
    for (int j = k + 1; j < count; ++j) sum -= reduced_(k, j) * candidate_(j);
    candidate_(k) = sum / reduced_(k, k);
  }
}

// Reflects column k onto its first k + 1 entries and applies the reflection to all that follows.
void BoundedLeastSquares::reduceColumn(int k, int free_count) {
  const Eigen::Index tail = reduced_.rows() - k;
  auto v = reduced_.col(k).tail(tail);
  const double norm = v.norm();
  check(norm > 0, "least squares without full column rank");
  const double diagonal = v(0) > 0 ? -norm : norm;
  v(0) -= diagonal;
  const double factor = 1 / (diagonal * v(0));  // = -2 / v^T v
  for (int j = k + 1; j < free_count; ++j) {
    auto column = reduced_.col(j).tail(tail);
    column += (factor * v.dot(column)) * v;
  }
  auto right = right_.tail(tail);
  right += (factor * v.dot(right)) * v;
  v(0) = diagonal;  // below the diagonal lies the reflector, which nobody reads any more
}

// Moves as far towards the candidate as the bounds allow; false if one of them stopped the move
// (that component is then held there).
bool BoundedLeastSquares::stepToCandidate(const Eigen::Ref<const Eigen::VectorXd>& lower,
                                          const Eigen::Ref<const Eigen::VectorXd>& upper,
                                          Eigen::Ref<Eigen::VectorXd> x) {
  double step = 1;
  int blocking = -1;
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const int j = free_[k];
    const double target = candidate_(static_cast<Eigen::Index>(k));
    if (target >= lower(j) && target <= upper(j)) continue;
    const double bound = target < lower(j) ? lower(j) : upper(j);
    const double allowed = (bound - x(j)) / (target - x(j));
    if (allowed < step) {
      step = allowed;
      blocking = j;
    }
  }
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const int j = free_[k];
    const double target = candidate_(static_cast<Eigen::Index>(k));
    x(j) = step == 1 ? target : x(j) + step * (target - x(j));
  }
  if (blocking < 0) return true;
  const bool at_lower =
      std::abs(x(blocking) - lower(blocking)) < std::abs(x(blocking) - upper(blocking));
  places_[static_cast<std::size_t>(blocking)] = at_lower ? Place::kAtLower : Place::kAtUpper;
  x(blocking) = at_lower ? lower(blocking) : upper(blocking);
  return false;
}

// Frees the bound whose multiplier points inward most; false if there is none: x is optimal.
bool BoundedLeastSquares::releaseOne(const Eigen::Ref<const Eigen::MatrixXd>& C,
                                     const Eigen::Ref<const Eigen::VectorXd>& d,
                                     const Eigen::Ref<const Eigen::VectorXd>& lower,
                                     const Eigen::Ref<const Eigen::VectorXd>& upper,
                                     const Eigen::Ref<const Eigen::VectorXd>& x) {
  if (free_.size() == places_.size()) return false;
  misfit_ = d;
  misfit_.noalias() -= C * x;
  gradient_.noalias() = C.transpose() * misfit_;  // downhill
  const double scale = misfit_.norm();
  double best = 0;
  int released = -1;
  for (int j = 0; j < x.size(); ++j) {
    const Place place = places_[static_cast<std::size_t>(j)];
    if (place == Place::kFree || lower(j) == upper(j)) continue;
    const double inward = place == Place::kAtLower ? gradient_(j) : -gradient_(j);
    const double relative = inward / (scale * C.col(j).norm() + std::numeric_limits<double>::min());
    if (relative > kReleaseTolerance && relative > best) {
      best = relative;
      released = j;
    }
  }
  if (released < 0) return false;
  places_[static_cast<std::size_t>(released)] = Place::kFree;
  return true;
}

}  // namespace gaitmill
