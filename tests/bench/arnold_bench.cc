// Static optimization with the leg of Arnold et al. (2010) and with the project's model over the
// same running strides: how long a row takes. The paper had the Arnold model 40 % slower. The leg
// has 27 muscles of one side, the project's model 80 of both; the counters tell what a row takes
// per muscle. Needs the shared folder (GAITMILL_SHARED, by default ../shared).
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/io/files.h"
#include "core/io/grf_reader.h"
#include "core/io/table_reader.h"
#include "core/math/table_filters.h"
#include "core/so/so_solver.h"
#include "tests/support/model_files.h"
#include "tests/support/shared_data.h"

namespace gaitmill {
namespace {

// The stride that the paper simulated [s], and the cutoff of its kinematics [Hz].
constexpr double kStart = 0.86;
constexpr double kEnd = 1.546;
constexpr double kCutoff = 15;

/// Inverse kinematics of the paper run, [rad|m], filtered.
TimeSeries readRun(const std::string& shared, const ModelSpec& model) {
  const std::string path = shared + "/reference/run/ik/ik.mot";
  const TimeSeries table = toCoordinates(readTable(readFile(path), path), model);
  return filterRecursive(table, kCutoff);
}

GroundReaction readLoads(const std::string& shared) {
  const std::string path = shared + "/data/run/paper_subject01/grf_run.mot";
  return readGroundReaction(readTable(readFile(path), path));
}

/// The leg on a pelvis that moves as the project's does, its knee and ankle let go.
ModelSpec makeMovingLeg(const std::string& shared, const ModelSpec& own) {
  ModelSpec leg = readModelFile(shared + "/data/models/Arnold2010_right_leg_27musc.osim");
  for (JointSpec& joint : leg.joints) {
    if (joint.child.body == "pelvis") {
      joint = own.joints.front();
    }
    for (CoordinateSpec& coordinate : joint.coordinates) {
      coordinate.locked = coordinate.name == "subtalar_angle" || coordinate.name == "mtp_angle";
    }
  }
  return leg;
}

/// Columns under the names of the leg: "knee_angle_r" becomes "knee_angle".
TimeSeries nameForLeg(TimeSeries table, const ModelSpec& leg) {
  std::vector<int> kept;
  std::vector<std::string> labels;
  for (int c = 0; c < table.columnCount(); ++c) {
    std::string label = table.labels[static_cast<std::size_t>(c)];
    if (label.size() > 2 && label.compare(label.size() - 2, 2, "_r") == 0) {
      label.resize(label.size() - 2);
    }
    if (leg.findCoordinate(label) != nullptr) {
      kept.push_back(c);
      labels.push_back(label);
    }
  }
  RowMatrix values(table.rowCount(), static_cast<Eigen::Index>(kept.size()));
  for (std::size_t k = 0; k < kept.size(); ++k) {
    values.col(static_cast<Eigen::Index>(k)) = table.values.col(kept[k]);
  }
  table.labels = std::move(labels);
  table.units.clear();
  table.values = std::move(values);
  return table;
}

SoOptions makeOptions(const Model& model) {
  SoOptions options;
  options.range = {kStart, kEnd};
  const FreeCoordinates free(model);
  for (const CoordinateIndex c : free.indices()) {
    ActuatorSpec actuator;
    actuator.name = model.coordinate(c).name + "_reserve";
    actuator.coordinate = model.coordinate(c).name;
    actuator.optimal_force = actuator.coordinate.rfind("pelvis", 0) == 0 ? 100 : 5;
    options.actuators.push_back(actuator);
  }
  return options;
}

void runStride(benchmark::State& run,
               const Model& model,
               const TimeSeries& coordinates,
               GroundReaction reaction) {
  auto& forces = reaction.forces;
  forces.erase(
      std::remove_if(forces.begin(),
                     forces.end(),
                     [&](const auto& force) { return model.spec().findBody(force.body) < 0; }),
      forces.end());
  const ExternalLoads loads(model, reaction);
  SoSolver solver(model, makeOptions(model));
  int rows = 0;
  for (auto _ : run) {
    rows = solver.solve(coordinates, loads).activations.rowCount();
  }
  using benchmark::Counter;
  run.counters["rows"] = rows;
  run.counters["muscles"] = model.muscleCount();
  run.counters["s_per_row_and_muscle"] =
      Counter(static_cast<double>(rows) * model.muscleCount(),
              Counter::kIsIterationInvariantRate | Counter::kInvert);
}

void soRunOwnModel(benchmark::State& run) {
  const std::string shared = findSharedFolder();
  if (shared.empty()) {
    run.SkipWithError("the shared folder is absent");
    return;
  }
  const Model model(readOwnModel());
  runStride(run, model, readRun(shared, model.spec()), readLoads(shared));
}
BENCHMARK(soRunOwnModel)->Unit(benchmark::kMillisecond);

void soRunArnoldLeg(benchmark::State& run) {
  const std::string shared = findSharedFolder();
  if (shared.empty()) {
    run.SkipWithError("the shared folder is absent");
    return;
  }
  const ModelSpec own = readOwnModel();
  const Model model(makeMovingLeg(shared, own));
  GroundReaction reaction = readLoads(shared);
  for (auto& force : reaction.forces) {
    force.body = force.body == "calcn_r" ? "calcn" : "";
  }
  runStride(run, model, nameForLeg(readRun(shared, own), model.spec()), std::move(reaction));
}
BENCHMARK(soRunArnoldLeg)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gaitmill
