// Force sharing of a CMC-sized window: 29 rows, 80 muscles and 29 torques.
#include <cmath>
#include <random>

#include <benchmark/benchmark.h>

#include "core/math/diagonal_qp.h"
#include "core/math/ipopt_qp.h"

namespace gaitmill {
namespace {

constexpr int kRows = 29;
constexpr int kMuscles = 80;

QpProblem makeWindow() {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  QpProblem problem(kRows, kMuscles + kRows);
  for (int j = 0; j < kMuscles; ++j) {
    for (int k = 0; k < 3; ++k) {
      problem.A(static_cast<int>(uniform(random) * kRows), j) = 0.04 * normal(random);
    }
    const double strength = 100 + 5000 * uniform(random);
    problem.weight(j) = 1 / (strength * strength);
    problem.lower(j) = 0.1 * strength * uniform(random);
    problem.upper(j) = problem.lower(j) + strength * uniform(random);
    problem.c += problem.A.col(j) * (0.7 * problem.lower(j) + 0.3 * problem.upper(j));
  }
  problem.A.rightCols(kRows).setIdentity();
  problem.weight.tail(kRows).setConstant(1 / (2.5 * 2.5));
  return problem;
}

void forceSharingCold(benchmark::State& run) {
  const QpProblem problem = makeWindow();
  DiagonalQp solver(problem.rows(), problem.columns());
  Eigen::VectorXd F(problem.columns());
  int iterations = 0;
  for (auto _ : run) {
    solver.resetWarmStart();
    iterations = solver.solve(problem, F).iterations;
  }
  run.counters["iterations"] = iterations;
}
BENCHMARK(forceSharingCold)->Unit(benchmark::kMicrosecond);

// The demand moves by a tenth of a percent from window to window.
void forceSharingWarm(benchmark::State& run) {
  QpProblem problem = makeWindow();
  const Eigen::VectorXd c = problem.c;
  DiagonalQp solver(problem.rows(), problem.columns());
  Eigen::VectorXd F(problem.columns());
  int iterations = 0;
  double phase = 0;
  for (auto _ : run) {
    phase += 0.1;
    problem.c = c * (1 + 0.01 * std::sin(phase));
    iterations = solver.solve(problem, F).iterations;
  }
  run.counters["iterations"] = iterations;
}
BENCHMARK(forceSharingWarm)->Unit(benchmark::kMicrosecond);

void forceSharingByIpopt(benchmark::State& run) {
  const QpProblem problem = makeWindow();
  Eigen::VectorXd F(problem.columns());
  int iterations = 0;
  for (auto _ : run) {
    F.setZero();
    iterations = solveByIpopt(problem, {}, F).iterations;
  }
  run.counters["iterations"] = iterations;
}
BENCHMARK(forceSharingByIpopt)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace gaitmill
