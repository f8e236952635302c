// Cost of one evaluation of the model in a walking pose.
#include <Eigen/Cholesky>
#include <benchmark/benchmark.h>

#include "core/model/free_coordinates.h"
#include "core/model/model.h"
#include "core/model/muscle_paths.h"
#include "tests/support/model_files.h"

namespace gaitmill {
namespace {

struct Bench {
  Model model{readOwnModel()};
  ModelState state{model};
  FreeCoordinates free{model};
  MusclePaths paths{model};
  Eigen::VectorXd q = model.defaultPose();
  Eigen::VectorXd u = Eigen::VectorXd::Constant(model.coordinateCount(), 0.5);

  Bench() {
    const auto set = [&](const char* name, double value) {
      q[model.getCoordinate(name).value()] = value;
    };
    set("hip_flexion_r", 0.4);
    set("knee_angle_r", 0.15);
    set("hip_flexion_l", -0.2);
    set("knee_angle_l", 0.5);
    free.conformPose(q);
    free.conformRates(u);
    state.setMotion(q, u);
  }
};

void modelSetPose(benchmark::State& run) {
  Bench b;
  for (auto _ : run) {
    b.q[0] += 1e-9;
    b.state.setPose(b.q);
  }
}
BENCHMARK(modelSetPose);

void modelSetMotion(benchmark::State& run) {
  Bench b;
  for (auto _ : run) {
    b.q[0] += 1e-9;
    b.state.setMotion(b.q, b.u);
  }
}
BENCHMARK(modelSetMotion);

void modelInverseDynamics(benchmark::State& run) {
  Bench b;
  Eigen::VectorXd tau(b.model.coordinateCount());
  const Eigen::VectorXd udot = b.u;
  for (auto _ : run) {
    b.state.calcInverseDynamics(udot, {}, tau);
    benchmark::DoNotOptimize(tau.data());
  }
}
BENCHMARK(modelInverseDynamics);

void modelReducedMassMatrixAndFactor(benchmark::State& run) {
  Bench b;
  Eigen::MatrixXd M(b.model.coordinateCount(), b.model.coordinateCount());
  Eigen::MatrixXd M_free(b.free.count(), b.free.count());
  Eigen::LLT<Eigen::MatrixXd> factor(b.free.count());
  for (auto _ : run) {
    b.state.calcMassMatrix(M);
    b.free.reduceMassMatrix(M, M_free);
    factor.compute(M_free);
    benchmark::DoNotOptimize(factor.matrixLLT().data());
  }
}
BENCHMARK(modelReducedMassMatrixAndFactor);

void musclePathsAll80(benchmark::State& run) {
  Bench b;
  for (auto _ : run) {
    b.paths.calc(b.state);
    benchmark::DoNotOptimize(b.paths.lengths().data());
  }
}
BENCHMARK(musclePathsAll80);

}  // namespace
}  // namespace gaitmill
