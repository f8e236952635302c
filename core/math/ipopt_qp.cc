#include "core/math/ipopt_qp.h"

#include <IpIpoptApplication.hpp>
#include <IpSolveStatistics.hpp>
#include <IpTNLP.hpp>
#include <algorithm>
#include <cmath>
#include <mutex>

#include "core/base/error.h"
#include "core/math/ipopt_lock.h"

namespace gaitmill {
namespace {

using Ipopt::Index;
using Ipopt::Number;

// Ipopt takes any bound beyond this as absent.
constexpr double kInfiniteBound = 1e19;

// The problem in scaled variables x = F / s and rows r A s, so that Ipopt sees numbers near one.
class ScaledProgram : public Ipopt::TNLP {
 public:
  ScaledProgram(const QpProblem& problem, double exponent, const Eigen::VectorXd& start)
      : exponent_(exponent), scale_(problem.weight.array().pow(-1 / exponent)) {
    B_ = problem.A * scale_.asDiagonal();
    row_scale_ = B_.rowwise().norm().cwiseMax(1e-300).cwiseInverse();
    B_ = row_scale_.asDiagonal() * B_;
    target_ = row_scale_.cwiseProduct(problem.c);
    lower_ = problem.lower.cwiseQuotient(scale_).cwiseMax(-kInfiniteBound);
    upper_ = problem.upper.cwiseQuotient(scale_).cwiseMin(kInfiniteBound);
    x_ = start.cwiseQuotient(scale_).cwiseMax(lower_).cwiseMin(upper_);
  }

  Eigen::VectorXd force() const { return x_.cwiseProduct(scale_); }

  bool get_nlp_info(
      Index& n, Index& m, Index& jacobian, Index& hessian, IndexStyleEnum& style) override {
    n = static_cast<Index>(B_.cols());
    m = static_cast<Index>(B_.rows());
    jacobian = n * m;
    hessian = n;
    style = TNLP::C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* xl, Number* xu, Index m, Number* gl, Number* gu) override {
    Eigen::Map<Eigen::VectorXd>(xl, n) = lower_;
    Eigen::Map<Eigen::VectorXd>(xu, n) = upper_;
    Eigen::Map<Eigen::VectorXd>(gl, m) = target_;
    Eigen::Map<Eigen::VectorXd>(gu, m) = target_;
    return true;
  }

  bool get_starting_point(
      Index n, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
    Eigen::Map<Eigen::VectorXd>(x, n) = x_;
    return true;
  }

  bool eval_f(Index n, const Number* x, bool, Number& value) override {
    value = map(x, n).array().abs().pow(exponent_).sum();
    return true;
  }

  bool eval_grad_f(Index n, const Number* x, bool, Number* gradient) override {
    for (Index j = 0; j < n; ++j) {
      gradient[j] = exponent_ * std::copysign(std::pow(std::abs(x[j]), exponent_ - 1), x[j]);
    }
    return true;
  }

  bool eval_g(Index n, const Number* x, bool, Index m, Number* g) override {
    Eigen::Map<Eigen::VectorXd>(g, m) = B_ * map(x, n);
    return true;
  }

  bool eval_jac_g(Index n,
                  const Number*,
                  bool,
                  Index m,
                  Index,
                  Index* row,
                  Index* column,
                  Number* values) override {
    Index k = 0;
    for (Index i = 0; i < m; ++i) {
      for (Index j = 0; j < n; ++j, ++k) {
        if (values == nullptr) {
          row[k] = i;
          column[k] = j;
        } else {
          values[k] = B_(i, j);
        }
      }
    }
    return true;
  }

  bool eval_h(Index n,
              const Number* x,
              bool,
              Number factor,
              Index,
              const Number*,
              bool,
              Index,
              Index* row,
              Index* column,
              Number* values) override {
    for (Index j = 0; j < n; ++j) {
      if (values == nullptr) {
        row[j] = j;
        column[j] = j;
      } else {
        const double magnitude = std::max(std::abs(x[j]), 1e-9);  // infinite at zero for p < 2
        values[j] = factor * exponent_ * (exponent_ - 1) * std::pow(magnitude, exponent_ - 2);
      }
    }
    return true;
  }

  void finalize_solution(Ipopt::SolverReturn,
                         Index n,
                         const Number* x,
                         const Number*,
                         const Number*,
                         Index,
                         const Number*,
                         const Number*,
                         Number,
                         const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    x_ = map(x, n);
  }

 private:
  static Eigen::Map<const Eigen::VectorXd> map(const Number* x, Index n) { return {x, n}; }

  double exponent_;
  Eigen::VectorXd scale_, row_scale_, target_, lower_, upper_, x_;
  Eigen::MatrixXd B_;
};

QpReport makeReport(const QpProblem& problem,
                    const Eigen::VectorXd& F,
                    Ipopt::ApplicationReturnStatus status,
                    int iterations) {
  QpReport report;
  const bool solved =
      status == Ipopt::Solve_Succeeded || status == Ipopt::Solved_To_Acceptable_Level;
  const bool infeasible = status == Ipopt::Infeasible_Problem_Detected;
  report.stop = solved ? QpStop::kSolved : infeasible ? QpStop::kElastic : QpStop::kIterationLimit;
  report.iterations = iterations;
  report.residual = (problem.c - problem.A * F).lpNorm<Eigen::Infinity>();
  return report;
}

}  // namespace

QpReport solveByIpopt(const QpProblem& problem,
                      const IpoptQpOptions& options,
                      Eigen::Ref<Eigen::VectorXd> F) {
  const std::lock_guard<std::mutex> lock(ipoptLock());

  require(options.exponent > 1, ErrorCode::kInputValue, "Ipopt needs a cost exponent above 1");
  Ipopt::SmartPtr<Ipopt::IpoptApplication> application = IpoptApplicationFactory();
  application->Options()->SetIntegerValue("print_level", 0);
  application->Options()->SetStringValue("sb", "yes");
  application->Options()->SetStringValue("nlp_scaling_method", "none");
  application->Options()->SetStringValue("linear_solver", "mumps");
  application->Options()->SetNumericValue("tol", options.tolerance);
  application->Options()->SetIntegerValue("max_iter", options.max_iterations);
  check(application->Initialize("") == Ipopt::Solve_Succeeded, "Ipopt did not start");

  auto* program = new ScaledProgram(problem, options.exponent, F);  // owned by the smart pointer
  const Ipopt::SmartPtr<Ipopt::TNLP> handle = program;
  const Ipopt::ApplicationReturnStatus status = application->OptimizeTNLP(handle);
  F = program->force().cwiseMax(problem.lower).cwiseMin(problem.upper);
  const Ipopt::SmartPtr<Ipopt::SolveStatistics> statistics = application->Statistics();
  const int iterations = IsValid(statistics) ? static_cast<int>(statistics->IterationCount()) : 0;
  return makeReport(problem, F, status, iterations);
}

}  // namespace gaitmill
