#include "core/math/nonlinear_program.h"

#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <cstddef>
#include <exception>
#include <mutex>
#include <utility>

#include "core/base/error.h"
#include "core/math/ipopt_lock.h"

namespace gaitmill {
namespace {

using Ipopt::Index;
using Ipopt::Number;

// Ipopt takes any bound beyond this as absent.
constexpr double kInfiniteBound = 1e19;

/// The program as Ipopt asks for it. An exception of the program must not unwind through Ipopt: it
/// is kept, ends the solve, and is thrown again outside.
class IpoptProblem : public Ipopt::TNLP {
 public:
  IpoptProblem(NonlinearProgram& program,
               const NlpOptions& options,
               const Progress& progress,
               Eigen::VectorXd start)
      : program_(program),
        options_(options),
        progress_(progress),
        jacobian_(program.jacobianPattern()),
        hessian_(program.hessianPattern()),
        x_(std::move(start)) {}

  const Eigen::VectorXd& x() const { return x_; }
  double objective() const { return objective_; }
  int iterations() const { return iterations_; }
  void rethrow() const {
    if (failure_) {
      std::rethrow_exception(failure_);
    }
  }

  bool get_nlp_info(
      Index& n, Index& m, Index& jacobian, Index& hessian, IndexStyleEnum& style) override {
    n = program_.variableCount();
    m = program_.constraintCount();
    jacobian = static_cast<Index>(jacobian_.size());
    hessian = static_cast<Index>(hessian_.size());
    style = TNLP::C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* xl, Number* xu, Index m, Number* gl, Number* gu) override {
    return guard([&] {
      program_.getBounds(vector(xl, n), vector(xu, n));
      limit(vector(xl, n), vector(xu, n));
      if (m > 0) {
        program_.getConstraintBounds(vector(gl, m), vector(gu, m));
        limit(vector(gl, m), vector(gu, m));
      }
    });
  }

  bool get_starting_point(
      Index n, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
    vector(x, n) = x_;
    return true;
  }

  bool eval_f(Index n, const Number* x, bool, Number& value) override {
    return guard([&] { value = program_.calcObjective(vector(x, n)); });
  }

  bool eval_grad_f(Index n, const Number* x, bool, Number* gradient) override {
    return guard([&] { program_.calcGradient(vector(x, n), vector(gradient, n)); });
  }

  bool eval_g(Index n, const Number* x, bool, Index m, Number* g) override {
    return m == 0 || guard([&] { program_.calcConstraints(vector(x, n), vector(g, m)); });
  }

  bool eval_jac_g(Index n,
                  const Number* x,
                  bool,
                  Index m,
                  Index count,
                  Index* rows,
                  Index* columns,
                  Number* values) override {
    if (values == nullptr) {
      return store(jacobian_, rows, columns);
    }
    return m == 0 || guard([&] { program_.calcJacobian(vector(x, n), vector(values, count)); });
  }

  bool eval_h(Index n,
              const Number* x,
              bool,
              Number factor,
              Index m,
              const Number* multipliers,
              bool,
              Index count,
              Index* rows,
              Index* columns,
              Number* values) override {
    if (values == nullptr) {
      return store(hessian_, rows, columns);
    }
    return guard([&] {
      program_.calcHessian(vector(x, n), factor, vector(multipliers, m), vector(values, count));
    });
  }

  bool intermediate_callback(Ipopt::AlgorithmMode,
                             Index iteration,
                             Number,
                             Number,
                             Number,
                             Number,
                             Number,
                             Number,
                             Number,
                             Number,
                             Index,
                             const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    iterations_ = iteration;
    return guard([&] {
      reportProgress(progress_, static_cast<double>(iteration) / options_.max_iterations);
    });
  }

  void finalize_solution(Ipopt::SolverReturn,
                         Index n,
                         const Number* x,
                         const Number*,
                         const Number*,
                         Index,
                         const Number*,
                         const Number*,
                         Number objective,
                         const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    x_ = vector(x, n);
    objective_ = objective;
  }

 private:
  static Eigen::Map<const Eigen::VectorXd> vector(const Number* x, Index n) { return {x, n}; }
  static Eigen::Map<Eigen::VectorXd> vector(Number* x, Index n) { return {x, n}; }

  static void limit(Eigen::Map<Eigen::VectorXd> lower, Eigen::Map<Eigen::VectorXd> upper) {
    lower = lower.cwiseMax(-kInfiniteBound);
    upper = upper.cwiseMin(kInfiniteBound);
  }

  static bool store(const std::vector<SparseEntry>& pattern, Index* rows, Index* columns) {
    for (std::size_t k = 0; k < pattern.size(); ++k) {
      rows[k] = pattern[k].row;
      columns[k] = pattern[k].column;
    }
    return true;
  }

  template <class Body>
  bool guard(const Body& body) {
    if (failure_) {
      return false;
    }
    try {
      body();
      return true;
    } catch (...) {
      failure_ = std::current_exception();
      return false;
    }
  }

  NonlinearProgram& program_;
  const NlpOptions& options_;
  const Progress& progress_;
  std::vector<SparseEntry> jacobian_, hessian_;
  Eigen::VectorXd x_;
  double objective_ = -1;
  int iterations_ = 0;
  std::exception_ptr failure_;
};

NlpStop findStop(Ipopt::ApplicationReturnStatus status) {
  switch (status) {
    case Ipopt::Solve_Succeeded:
      return NlpStop::kSolved;
    case Ipopt::Solved_To_Acceptable_Level:
    case Ipopt::Search_Direction_Becomes_Too_Small:
      return NlpStop::kAcceptable;
    case Ipopt::Maximum_Iterations_Exceeded:
      return NlpStop::kIterationLimit;
    default:
      return NlpStop::kFailed;
  }
}

void setOptions(const NlpOptions& options, Ipopt::OptionsList& list) {
  list.SetIntegerValue("print_level", 0);
  list.SetStringValue("sb", "yes");
  list.SetStringValue("nlp_scaling_method", "none");
  list.SetStringValue("linear_solver", "mumps");
  list.SetNumericValue("tol", options.tolerance);
  list.SetIntegerValue("max_iter", options.max_iterations);
  list.SetNumericValue("mu_init", options.initial_barrier);
  list.SetNumericValue("bound_push", options.bound_push);
  list.SetNumericValue("bound_frac", options.bound_push);
  list.SetNumericValue("bound_relax_factor", 0.0);
}

}  // namespace

void NonlinearProgram::getConstraintBounds(Eigen::Ref<Eigen::VectorXd>,
                                           Eigen::Ref<Eigen::VectorXd>) const {
  check(false, "a program with constraints must state their bounds");
}

void NonlinearProgram::calcConstraints(const Eigen::Ref<const Eigen::VectorXd>&,
                                       Eigen::Ref<Eigen::VectorXd>) {
  check(false, "a program with constraints must evaluate them");
}

void NonlinearProgram::calcJacobian(const Eigen::Ref<const Eigen::VectorXd>&,
                                    Eigen::Ref<Eigen::VectorXd>) {
  check(false, "a program with constraints must differentiate them");
}

NlpReport solveNonlinearProgram(NonlinearProgram& program,
                                const NlpOptions& options,
                                const Progress& progress,
                                Eigen::Ref<Eigen::VectorXd> x) {
  check(x.size() == program.variableCount(), "solveNonlinearProgram: start of another size");
  const std::lock_guard<std::mutex> lock(ipoptLock());
  Ipopt::SmartPtr<Ipopt::IpoptApplication> application = IpoptApplicationFactory();
  setOptions(options, *application->Options());
  check(application->Initialize("") == Ipopt::Solve_Succeeded, "Ipopt did not start");

  auto* problem = new IpoptProblem(program, options, progress, x);  // owned by the smart pointer
  const Ipopt::SmartPtr<Ipopt::TNLP> handle = problem;
  NlpReport report;
  report.stop = findStop(application->OptimizeTNLP(handle));
  problem->rethrow();
  x = problem->x();
  report.objective = problem->objective();
  report.iterations = problem->iterations();
  return report;
}

}  // namespace gaitmill
