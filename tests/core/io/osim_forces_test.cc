#include "core/io/osim_forces.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/io/osim_reader.h"
#include "tests/core/io/osim_samples.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

ModelSpec readForces(const std::string& forces,
                     const std::string& version = "40000",
                     std::vector<std::string>* warnings = nullptr) {
  OsimPieces pieces;
  pieces.version = version;
  pieces.forces = forces;
  return readOsim(makeOsim(pieces), "leg.osim", warnings);
}

// spec/muscle.md 2.
TEST(OsimForces, BareMuscleHasTheClassDefaults) {
  const MuscleSpec muscle = readForces(makeMuscleElement("")).muscles.at(0);
  EXPECT_EQ(muscle.optimal_fiber_length, 0.1);
  EXPECT_EQ(muscle.tendon_slack_length, 0.2);
  EXPECT_EQ(muscle.fiber_damping, 0.1);
  EXPECT_EQ(muscle.default_activation, 0.05);
  EXPECT_EQ(muscle.min_control, 0.01);
  EXPECT_EQ(muscle.tendon, TendonKind::kElastic);
  EXPECT_NEAR(muscle.curves.active_min_length, 0.4441, tol(1e-15));
  EXPECT_EQ(muscle.curves.active_max_length, 1.8123);
  EXPECT_EQ(muscle.curves.active_minimum_value, 0.1);
  EXPECT_EQ(muscle.curves.passive_curviness, 0.75);
  EXPECT_EQ(muscle.curves.tendon_force_at_toe_end, 2.0 / 3.0);
}

TEST(OsimForces, ElasticStiffnessFollowsTheStrain) {
  const MuscleSpec muscle =
      readForces(makeMuscleElement("<TendonForceLengthCurve><strain_at_one_norm_force>0.033"
                                   "</strain_at_one_norm_force></TendonForceLengthCurve>"))
          .muscles.at(0);
  EXPECT_EQ(muscle.curves.tendon_stiffness_at_one_force, 1.375 / 0.033);
}

TEST(OsimForces, OldLowerControlLimitOfZeroCountsAsUnstated) {
  const std::string muscle = makeMuscleElement("<min_control>0</min_control>");
  EXPECT_EQ(readForces(muscle, "30000").muscles.at(0).min_control, 0.01);
  EXPECT_EQ(readForces(muscle).muscles.at(0).min_control, 0);
}

// Also with the prototypes of the paper's models, whose flags differ from the class defaults.
TEST(OsimForces, ActuatorsTakeTheirFlagsFromThePrototype) {
  const std::string actuator = "<PointActuator name=\"FX\"><body>thigh</body></PointActuator>";
  EXPECT_FALSE(readForces(actuator).actuators.at(0).direction_in_ground);
  OsimPieces pieces;
  pieces.forces = actuator;
  pieces.defaults =
      "<PointActuator name=\"default\"><direction>-1 -0 -0</direction>"
      "<force_is_global>true</force_is_global><optimal_force>1000</optimal_force></PointActuator>";
  const ActuatorSpec spec = readOsim(makeOsim(pieces), "leg.osim").actuators.at(0);
  EXPECT_TRUE(spec.direction_in_ground);
  EXPECT_EQ(spec.direction, Eigen::Vector3d(-1, 0, 0));
  EXPECT_EQ(spec.optimal_force, 1000);
  EXPECT_EQ(spec.min_control, -1e300);
}

TEST(OsimForces, TorqueActuatorNamesItsReaction) {
  const ModelSpec spec = readForces(
      "<TorqueActuator name=\"a\"><bodyA>shank</bodyA><bodyB>thigh</bodyB></TorqueActuator>"
      "<TorqueActuator name=\"b\"><bodyA>shank</bodyA><bodyB>Unassigned</bodyB>"
      "<max_control>Inf</max_control></TorqueActuator>");
  EXPECT_EQ(spec.actuators.at(0).reaction_body, "thigh");
  EXPECT_EQ(spec.actuators.at(0).direction, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(spec.actuators.at(1).reaction_body, "");
  EXPECT_EQ(spec.actuators.at(1).max_control, 1e300);
}

TEST(OsimForces, WhatIsSwitchedOffIsLeftOutWithAWarning) {
  std::vector<std::string> warnings;
  const ModelSpec spec =
      readForces(makeMuscleElement("<appliesForce>false</appliesForce>") +
                     "<HuntCrossleyForce name=\"floor\"/><CoordinateLimitForce name=\"stop\">"
                     "<isDisabled>true</isDisabled></CoordinateLimitForce>",
                 "40000",
                 &warnings);
  EXPECT_TRUE(spec.muscles.empty());
  EXPECT_EQ(warnings.size(), 3u);
}

}  // namespace
}  // namespace gaitmill
