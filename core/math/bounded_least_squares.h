#pragma once

#include <vector>

#include <Eigen/Core>

namespace gaitmill {

/// minimise |C x - d|^2  subject to  lower <= x <= upper,  C (rows x columns), rows >= columns,
/// full column rank. Householder QR of the columns that are off their bounds, active set around it
/// (Stark & Parker 1995, Comput Stat 10:129): when no bound is active, one factorization. QR rather
/// than normal equations, whose condition of 1e12 in residual reduction leaves four digits.
///
/// One per thread; solve() does not allocate.
class BoundedLeastSquares {
 public:
  BoundedLeastSquares(int rows, int columns);

  struct Report {
    bool converged = false;
    int factorizations = 0;
    int active_bounds = 0;  ///< components that end on a bound
  };

  /// @param x  out: (columns), within the bounds
  Report solve(const Eigen::Ref<const Eigen::MatrixXd>& C,
               const Eigen::Ref<const Eigen::VectorXd>& d,
               const Eigen::Ref<const Eigen::VectorXd>& lower,
               const Eigen::Ref<const Eigen::VectorXd>& upper,
               Eigen::Ref<Eigen::VectorXd> x);

 private:
  enum class Place { kFree, kAtLower, kAtUpper };

  void solveFree(const Eigen::Ref<const Eigen::MatrixXd>& C,
                 const Eigen::Ref<const Eigen::VectorXd>& d,
                 const Eigen::Ref<const Eigen::VectorXd>& x);
  void reduceColumn(int k, int free_count);
  bool stepToCandidate(const Eigen::Ref<const Eigen::VectorXd>& lower,
                       const Eigen::Ref<const Eigen::VectorXd>& upper,
                       Eigen::Ref<Eigen::VectorXd> x);
  bool releaseOne(const Eigen::Ref<const Eigen::MatrixXd>& C,
                  const Eigen::Ref<const Eigen::VectorXd>& d,
                  const Eigen::Ref<const Eigen::VectorXd>& lower,
                  const Eigen::Ref<const Eigen::VectorXd>& upper,
                  const Eigen::Ref<const Eigen::VectorXd>& x);

  std::vector<Place> places_;
  std::vector<int> free_;      ///< columns off their bounds, in order
  Eigen::MatrixXd reduced_;    ///< (rows x columns) free columns, then R
  Eigen::VectorXd right_;      ///< (rows) d minus the fixed columns, then Q^T of it
  Eigen::VectorXd candidate_;  ///< (columns) unconstrained values of the free ones
  Eigen::VectorXd gradient_;   ///< (columns)
  Eigen::VectorXd misfit_;     ///< (rows)
};

}  // namespace gaitmill
