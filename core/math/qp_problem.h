#pragma once

#include <Eigen/Core>

namespace gaitmill {

/// Sharing a demand among many forces at least cost:
///   minimise  sum_j weight_j |F_j|^p   subject to   A F = c,  lower <= F <= upper
/// The rows may be accelerations (A = M^-1 R, c = a* - b) or, which needs no inverse and gives the
/// same forces, generalized forces (A = R, c = M (a* - b)): then the slack is in N.m. Sized once,
/// refilled per instant.
struct QpProblem {
  QpProblem(int rows, int columns);

  int rows() const { return static_cast<int>(A.rows()); }
  int columns() const { return static_cast<int>(A.cols()); }

  Eigen::MatrixXd A;       ///< (rows x columns), full row rank
  Eigen::VectorXd c;       ///< (rows)
  Eigen::VectorXd weight;  ///< (columns) > 0; 1/F_opt^p of each force
  Eigen::VectorXd lower;   ///< (columns) <= upper; -infinity allowed
  Eigen::VectorXd upper;   ///< (columns); lower == upper fixes the force
};

enum class QpStop {
  kSolved,          ///< optimal and A F = c to the tolerance
  kElastic,         ///< infeasible: the violation of A F = c is as small as the bounds allow
  kIterationLimit,  ///< best point found; see residual
};

/// How a solve went.
struct QpReport {
  QpStop stop = QpStop::kIterationLimit;
  int iterations = 0;    ///< Newton steps, elastic ones included
  double residual = -1;  ///< largest |c - A F| over the rows, in the units of c
};

}  // namespace gaitmill
