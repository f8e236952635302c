#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "core/math/qp_problem.h"

namespace gaitmill {

enum class ElasticMode { kOff, kWhenInfeasible };

struct DiagonalQpOptions {
  double exponent = 2;       ///< p >= 1 of the cost
  double tolerance = 1e-10;  ///< of each row's |c - A F|, relative to what the row can move (below)
  int max_iterations = 200;  ///< Newton steps per attempt
  ElasticMode elastic = ElasticMode::kWhenInfeasible;
  /// mu >= 0 of -mu sum log(x - lower) + log(upper - x), x = F weight^(1/2), added to the cost: the
  /// forces then stay off their bounds by about mu / multiplier, as an interior-point solver of
  /// that final barrier leaves them. Needs p = 2. 0 gives the exact solution.
  double barrier = 0;
};

/// Solves a QpProblem exactly by semismooth Newton on its dual (spec/cmc.md 6g). With multipliers
/// lambda of the rows, p = 2:
///   F_j = clip(A_j^T lambda / (2 weight_j), lower_j, upper_j),   find lambda with A F(lambda) = c.
/// The dual is concave and piecewise quadratic: about ten steps from zero, one to three from the
/// previous instant's lambda. Rows are scaled by r_i = 1 / sqrt(sum_j A_ij^2 / (2 weight_j)); a
/// line search on the dual's slope makes every start converge. Other p > 1 use the same iteration
/// with F_j = sign(y) (|y| / (p weight_j))^(1/(p-1)); p = 1 is solved as |x| + kLinearCurvature x^2
/// with x = F weight, the spread-out one of the cheapest solutions.
///
/// Infeasible problems (dual unbounded) are answered, if asked, with the F that minimises
/// sum_i (r_i slack_i)^2, slack = c - A F, and is cheapest among those (to 1e-8).
///
/// One per thread. solve() does not allocate.
class DiagonalQp {
 public:
  DiagonalQp(int rows, int columns, const DiagonalQpOptions& options = {});

  /// @param problem  of the constructor's size, finite but for infinite bounds
  /// @param F        out: (columns), always within its bounds
  /// Starts from the multipliers of the previous call.
  QpReport solve(const QpProblem& problem, Eigen::Ref<Eigen::VectorXd> F);

  /// Forgets the previous multipliers: the next solve starts from zero.
  void resetWarmStart();

  /// c - A F of the last solve (rows): what is missing where the bounds did not allow more.
  const Eigen::VectorXd& slack() const { return slack_; }
  /// d cost / d c of the last solve (rows).
  const Eigen::VectorXd& multipliers() const { return multipliers_; }

 private:
  enum class Attempt { kRigid, kElastic };

  void scale(const QpProblem& problem);
  bool iterate(Attempt attempt, QpReport& report);
  double calcForce(int j, double y) const;
  double calcBarrierForce(int j, double y) const;
  double calcForceSlope(int j, double y) const;
  void calcResidual(Attempt attempt);
  bool calcDirection(Attempt attempt);
  double searchLine(Attempt attempt) const;
  double calcDualSlope(Attempt attempt, double step) const;

  DiagonalQpOptions options_;
  // In scaled variables x = F / s, s = weight^(-1/p), and rows B = r A s.
  Eigen::MatrixXd B_;          // (rows x columns)
  Eigen::VectorXd row_scale_;  // r
  Eigen::VectorXd target_;     // r c
  Eigen::VectorXd force_scale_;
  Eigen::VectorXd lower_, upper_, x_;
  Eigen::VectorXd y_, y_step_;            // B^T lambda and B^T step
  Eigen::VectorXd lambda_, lambda_step_;  // scaled multipliers
  Eigen::VectorXd residual_;              // target - B x (- lambda / rho)
  Eigen::VectorXd multipliers_, slack_;   // unscaled, kept for the next start
  Eigen::MatrixXd hessian_;               // (rows x rows), lower triangle
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

}  // namespace gaitmill
