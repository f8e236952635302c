// Agreement with OpenSim's static optimization of both published trials.

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/io/grf_reader.h"
#include "core/io/table_reader.h"
#include "core/so/so_solver.h"
#include "tests/support/model_files.h"
#include "tests/support/shared_data.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

struct Trial {
  const char* name;
  const char* reference;
  const char* kinematics;  ///< result of the last residual reduction
  const char* grf;
  Eigen::Vector3d residual_point;  ///< in the pelvis [m]
  double knee_and_ankle_reserve;   ///< optimal force [N.m]
  double start, end;               ///< [s]
};

const Trial kWalk{"walk",
                  "reference/walk",
                  "rra/pass2/kinematics_q.sto",
                  "data/walk/grf_walk.mot",
                  {-0.107324, 0.0155155, 0},
                  2.5,
                  0.45,
                  1.799};
const Trial kRun{"run",
                 "reference/run",
                 "rra/pass3/kinematics_q.sto",
                 "data/run/paper_subject01/grf_run.mot",
                 {-0.073, -0.02525, 0},
                 1.0,
                 0.83,
                 1.545};

/// Residuals and reserves of the published CMC set-ups (spec/cmc.md 1).
std::vector<ActuatorSpec> makeActuators(const Trial& trial) {
  std::vector<ActuatorSpec> actuators;
  const auto add = [&](const std::string& name, ActuatorSpec::Kind kind, double optimal_force) {
    actuators.emplace_back();
    actuators.back().name = name;
    actuators.back().kind = kind;
    actuators.back().optimal_force = optimal_force;
  };
  for (int axis = 0; axis < 3; ++axis) {
    add(std::string("F") + "XYZ"[axis], ActuatorSpec::Kind::kPoint, 10);
    actuators.back().body = "pelvis";
    actuators.back().point = trial.residual_point;
    actuators.back().direction = Eigen::Vector3d::Unit(axis);
  }
  for (int axis = 0; axis < 3; ++axis) {
    add(std::string("M") + "XYZ"[axis], ActuatorSpec::Kind::kTorque, 15);
    actuators.back().body = "pelvis";
    actuators.back().reaction_body = "ground";
    actuators.back().direction = Eigen::Vector3d::Unit(axis);
  }
  for (const char* side : {"_r", "_l"}) {
    const std::pair<const char*, double> reserves[] = {
        {"hip_flexion", 2.5},
        {"hip_adduction", 5},
        {"hip_rotation", 10},
        {"knee_angle", trial.knee_and_ankle_reserve},
        {"ankle_angle", trial.knee_and_ankle_reserve}};
    for (const auto& [coordinate, optimal_force] : reserves) {
      add(coordinate + std::string(side) + "_reserve",
          ActuatorSpec::Kind::kCoordinate,
          optimal_force);
      actuators.back().coordinate = coordinate + std::string(side);
    }
  }
  return actuators;
}

/// The reference holds every tenth row of the residual reduction's output, which is not quite
/// evenly spaced, interpolated linearly to 10 ms; so do we.
class SoReferenceTest : public SharedDataTest, public ::testing::WithParamInterface<Trial> {
 protected:
  void SetUp() override {
    SharedDataTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) {
      return;
    }
    const Trial& trial = GetParam();
    const std::string folder = shared(trial.reference) + "/";
    model_ = std::make_unique<Model>(readModelFile(folder + "subject_adjusted.osim"));
    const std::string path = folder + trial.kinematics;
    const TimeSeries coordinates = toCoordinates(readTable(readFile(path), path), model_->spec());
    GrfOptions grf_options;
    grf_options.threshold = 0;
    const std::string grf_path = shared(trial.grf);
    const ExternalLoads loads(
        *model_, readGroundReaction(readTable(readFile(grf_path), grf_path), grf_options));
    options_.actuators = makeActuators(trial);
    options_.range = {trial.start, trial.end};
    options_.row_interval = 10;
    result_ = SoSolver(*model_, options_).solve(coordinates, loads);
    reference_ = readCsvSeries(folder + "so/activation.csv");
    reference_forces_ = readCsvSeries(folder + "so/force_N.csv");
  }

  std::unique_ptr<Model> model_;
  SoOptions options_;
  SoResult result_;
  TimeSeries reference_;
  TimeSeries reference_forces_;
};

/// RMS over the reference's times of one column.
double calcRms(const TimeSeries& ours, const TimeSeries& reference, const std::string& name) {
  const int a = ours.getColumn(name);
  const int b = reference.getColumn(name);
  double sum = 0;
  for (int row = 0; row < reference.rowCount(); ++row) {
    const double t = reference.time[static_cast<std::size_t>(row)];
    const double difference = ours.interpolate(t)[a] - reference.values(row, b);
    sum += difference * difference;
  }
  return std::sqrt(sum / reference.rowCount());
}

TEST_P(SoReferenceTest, ActivationsAreThoseOfOpenSim) {
  ASSERT_GT(reference_.rowCount(), 70);
  double mean = 0;
  for (int m = 0; m < result_.muscle_count; ++m) {
    const std::string& name = result_.activations.labels[static_cast<std::size_t>(m)];
    const double rms = calcRms(result_.activations, reference_, name);
    EXPECT_LE(rms, tol(0.02)) << name;
    mean += rms / result_.muscle_count;
  }
  EXPECT_LE(mean, tol(0.001));  // measured: walk 0.0004 (worst 0.0035), run 0.0007 (0.0069)
}

TEST_P(SoReferenceTest, JointTorquesWithoutMusclesAreThoseOfOpenSim) {
  for (const char* name : {"lumbar_ext",
                           "lumbar_bend",
                           "lumbar_rot",
                           "shoulder_flex_r",
                           "shoulder_add_l",
                           "elbow_flex_r",
                           "MX",
                           "MY",
                           "MZ",
                           "FX",
                           "FY"}) {
    EXPECT_LE(calcRms(result_.forces, reference_forces_, name), tol(0.1)) << name;
  }
}

TEST_P(SoReferenceTest, NoRowIsInfeasible) {
  EXPECT_TRUE(result_.infeasible_rows.empty());
  EXPECT_TRUE(result_.warnings.empty());
}

INSTANTIATE_TEST_SUITE_P(BothTrials,
                         SoReferenceTest,
                         ::testing::Values(kWalk, kRun),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace gaitmill
