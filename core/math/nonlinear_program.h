#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/base/progress.h"

namespace gaitmill {

/// Place of one entry of a sparse matrix.
struct SparseEntry {
  int row = 0;
  int column = 0;
};

/// A smooth problem with sparse derivatives:
///   minimise f(x)  subject to  lower <= x <= upper,  constraint_lower <= c(x) <= constraint_upper
/// Derivatives are exact: the solver trusts them. Infinite bounds are absent; equal ones fix a
/// variable. The solver calls from one thread and may repeat a point.
class NonlinearProgram {
 public:
  virtual ~NonlinearProgram() = default;

  virtual int variableCount() const = 0;
  virtual int constraintCount() const { return 0; }
  virtual void getBounds(Eigen::Ref<Eigen::VectorXd> lower,
                         Eigen::Ref<Eigen::VectorXd> upper) const = 0;
  /// Needed where there are constraints, as are all functions of constraints below.
  virtual void getConstraintBounds(Eigen::Ref<Eigen::VectorXd> lower,
                                   Eigen::Ref<Eigen::VectorXd> upper) const;

  virtual double calcObjective(const Eigen::Ref<const Eigen::VectorXd>& x) = 0;
  virtual void calcGradient(const Eigen::Ref<const Eigen::VectorXd>& x,
                            Eigen::Ref<Eigen::VectorXd> gradient) = 0;
  virtual void calcConstraints(const Eigen::Ref<const Eigen::VectorXd>& x,
                               Eigen::Ref<Eigen::VectorXd> values);

  /// Entries that may differ from zero, each once.
  virtual std::vector<SparseEntry> jacobianPattern() const { return {}; }
  virtual void calcJacobian(const Eigen::Ref<const Eigen::VectorXd>& x,
                            Eigen::Ref<Eigen::VectorXd> values);
  /// Lower triangle (row >= column), each entry once.
  virtual std::vector<SparseEntry> hessianPattern() const = 0;
  /// Second derivatives of objective_factor f(x) + multipliers' c(x), in the pattern's order. A
  /// Gauss-Newton matrix may stand in; convergence then is as good as that is.
  virtual void calcHessian(const Eigen::Ref<const Eigen::VectorXd>& x,
                           double objective_factor,
                           const Eigen::Ref<const Eigen::VectorXd>& multipliers,
                           Eigen::Ref<Eigen::VectorXd> values) = 0;
};

struct NlpOptions {
  double tolerance = 1e-6;  ///< of Ipopt's optimality error
  int max_iterations = 200;
  double initial_barrier = 0.1;  ///< of the objective's unit; small keeps a good start
  double bound_push = 0.01;      ///< how far inside its bounds the start is moved, relative
};

enum class NlpStop {
  kSolved,          ///< optimal to the tolerance
  kAcceptable,      ///< no further progress, optimal to Ipopt's acceptable level (1e-6)
  kIterationLimit,  ///< best point so far
  kFailed,          ///< no step could be found; the last point
};

/// How a solve went.
struct NlpReport {
  NlpStop stop = NlpStop::kFailed;
  int iterations = 0;
  double objective = -1;
};

/// Local minimum by Ipopt's interior point (Waechter and Biegler 2006, Math Program 106:25) with
/// the program's own derivatives. Same input, same bits. One solve at a time in the process, as
/// with solveByIpopt(); others wait.
/// @param progress  told the iterations done of the most allowed; may stop the solve
/// @param x         in: start; out: best point, within the bounds
/// @throws Error kCancelled, kInternal if Ipopt cannot be set up, and what the program throws
NlpReport solveNonlinearProgram(NonlinearProgram& program,
                                const NlpOptions& options,
                                const Progress& progress,
                                Eigen::Ref<Eigen::VectorXd> x);

}  // namespace gaitmill
