#pragma once

#include "core/math/qp_problem.h"

namespace gaitmill {

struct IpoptQpOptions {
  double exponent = 2;      ///< p > 1 of the cost
  double tolerance = 1e-8;  ///< of Ipopt's scaled optimality error; 1e-4 in the published set-ups
  int max_iterations = 2000;
};

/// The same QpProblem by Ipopt's interior point: the cross-check of DiagonalQp, and a solver a job
/// may ask for. Forces at a bound stay off it by about barrier / multiplier. Some milliseconds per
/// call; allocates. Any thread may call, but one solve runs at a time in the process (the linear
/// solver behind Ipopt is not re-entrant).
/// @param F  in: starting point; out: (columns), within the bounds to 1e-8 relative
/// @throws Error kInternal if Ipopt cannot be set up
QpReport solveByIpopt(const QpProblem& problem,
                      const IpoptQpOptions& options,
                      Eigen::Ref<Eigen::VectorXd> F);

}  // namespace gaitmill
