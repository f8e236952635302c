// Muscle control of the models that others use: one leg swings on a pelvis held by residuals. Their
// muscles' states must stay sane and follow the motion; what they do in a real trial is tested in
// core/pipeline.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/cmc/cmc_solver.h"
#include "core/muscle/muscle.h"
#include "tests/support/model_files.h"
#include "tests/support/shared_data.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr double kPeriod = 1.0;  // [s]

// Hip flexes by 30 deg, knee by 50, ankle dorsiflexes by 10, from the default pose and back.
TimeSeries makeSwing(const Model& model, double knee_sign) {
  std::vector<double> time;
  for (int i = -60; i <= 160; ++i) {
    time.push_back(0.01 * i);
  }
  TimeSeries swing = makeTimeSeries("swing", model.coordinateNames(), time);
  const auto column = [&](const char* name) {
    return model.getCoordinate(name).value();
  };
  for (int row = 0; row < swing.rowCount(); ++row) {
    const double share =
        0.5 - 0.5 * std::cos(2 * kPi * time[static_cast<std::size_t>(row)] / kPeriod);
    Eigen::VectorXd q = model.defaultPose();
    q[column("hip_flexion_r")] += toRadians(30) * share;
    q[column("knee_angle_r")] = knee_sign * toRadians(5 + 50 * share);
    q[column("ankle_angle_r")] += toRadians(10) * share;
    swing.values.row(row) = q.transpose();
  }
  return swing;
}

std::vector<ActuatorSpec> makeActuators(const Model& model) {
  std::vector<ActuatorSpec> actuators;
  for (const std::string& name : model.coordinateNames()) {
    const CoordinateSpec& coordinate = model.coordinate(model.getCoordinate(name));
    if (coordinate.locked || name.find("_beta") != std::string::npos) {
      continue;
    }
    ActuatorSpec actuator;
    actuator.name = name + "_torque";
    actuator.coordinate = name;
    actuator.optimal_force = name.rfind("pelvis_", 0) == 0 ? 1000 : 1;
    actuator.min_control = -1000;
    actuator.max_control = 1000;
    actuators.push_back(actuator);
  }
  return actuators;
}

// Subtalar and toe joints locked, as the full-body models publish them and users of gait2392 do: a
// foot's toes are too light for controls that last 10 ms.
ModelSpec readWithLockedFeet(const std::string& file) {
  ModelSpec spec = readModelFile(file);
  for (JointSpec& joint : spec.joints) {
    for (CoordinateSpec& coordinate : joint.coordinates) {
      const std::string stem = coordinate.name.substr(0, coordinate.name.size() - 2);
      coordinate.locked = coordinate.locked || stem == "subtalar_angle" || stem == "mtp_angle";
    }
  }
  return spec;
}

struct ModelCase {
  const char* file;
  double knee_sign;  ///< of flexion
};

class OtherModelsTest : public SharedDataTest, public ::testing::WithParamInterface<ModelCase> {};

TEST_P(OtherModelsTest, MusclesSwingTheLeg) {
  const Model model(readWithLockedFeet(shared(GetParam().file)));
  const FreeCoordinates free(model);
  GroundReaction nothing;
  nothing.time = {0, 1, 2, 3};
  CmcOptions options;
  options.end_time = kPeriod;
  options.actuators = makeActuators(model);
  const CmcResult result =
      solveCmc(model,
               ReferenceMotion(model, free, makeSwing(model, GetParam().knee_sign)),
               ExternalLoads(model, nothing),
               options);
  ASSERT_EQ(result.stop, CmcStop::kFinished);
  EXPECT_TRUE(result.infeasible_windows.empty());
  EXPECT_LT(result.tracking_error.values.cwiseAbs().maxCoeff(), toRadians(1));
  const auto muscles = makeMuscles(model.spec().muscles);
  for (std::size_t m = 0; m < muscles.size(); ++m) {
    const auto column = static_cast<Eigen::Index>(m);
    SCOPED_TRACE(model.spec().muscles[m].name);
    const auto activation = result.activation.values.col(column);
    EXPECT_GE(activation.minCoeff(), std::min(0.01, muscles[m].minimumActivation()));
    EXPECT_LE(activation.maxCoeff(), 1.0);
    EXPECT_GE(result.tendon_force.values.col(column).minCoeff(), 0.0);
    EXPECT_LT(result.tendon_force.values.col(column).maxCoeff(),
              2 * muscles[m].maxIsometricForce());
    EXPECT_GE(result.fiber_length.values.col(column).minCoeff(), muscles[m].minFiberLength());
    EXPECT_LT(result.fiber_length.values.col(column).maxCoeff(),
              2.5 * muscles[m].optimalFiberLength());
  }
  // The muscles do it, not the torques beside them.
  for (const char* joint : {"hip_flexion_r", "knee_angle_r", "ankle_angle_r"}) {
    const int column = result.actuator_force.getColumn(std::string(joint) + "_torque");
    EXPECT_LT(result.actuator_force.values.col(column).cwiseAbs().maxCoeff(), 2.0) << joint;
  }
}

std::string nameModel(const ::testing::TestParamInfo<ModelCase>& test) {
  const std::string file = test.param.file;
  const std::size_t start = file.rfind('/') + 1;
  return file.substr(start, file.rfind('.') - start);
}

INSTANTIATE_TEST_SUITE_P(
    Models,
    OtherModelsTest,
    ::testing::Values(ModelCase{"data/models/gait2392_thelen2003muscle.osim", -1},
                      ModelCase{"data/models/gait2392_millard2012muscle.osim", -1},
                      ModelCase{"data/models/FullBodyModel_Hamner2010_v2_0.osim", -1},
                      ModelCase{"data/walk/example3DWalking/subject_walk_scaled.osim", 1}),
    nameModel);

}  // namespace
}  // namespace gaitmill
