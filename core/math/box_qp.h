#pragma once

#include <vector>

#include <Eigen/Core>

namespace gaitmill {

/// Minimizes 1/2 x'Hx + g'x within lower <= x <= upper by an active set: exact, for small dense
/// problems that are solved over and over. One per thread; sizes its memory in the constructor;
/// solve() does not allocate.
class BoxQp {
 public:
  explicit BoxQp(int size);

  /// @param hessian  (n x n), lower triangle used
  /// @param lower, upper  (n) bounds with lower <= 0 <= upper, infinite where there is none; equal
  ///   bounds fix an unknown
  /// @param x  (n) out: the minimizer
  /// @returns false if the Hessian is not positive definite on the unknowns that are not on a
  ///   bound; x is then unusable
  bool solve(const Eigen::Ref<const Eigen::MatrixXd>& hessian,
             const Eigen::Ref<const Eigen::VectorXd>& gradient,
             const Eigen::Ref<const Eigen::VectorXd>& lower,
             const Eigen::Ref<const Eigen::VectorXd>& upper,
             Eigen::Ref<Eigen::VectorXd> x);

 private:
  struct Problem;
  void fixInitially(const Problem& problem);
  bool solveUnfixed(const Problem& problem);
  bool clampViolators(const Problem& problem);
  bool releaseWorst(const Problem& problem);

  int size_;
  std::vector<bool> fixed_;
  std::vector<int> unfixed_;
  Eigen::MatrixXd reduced_;  ///< Hessian of the unfixed unknowns, then its factor
  Eigen::VectorXd solution_;
};

}  // namespace gaitmill
