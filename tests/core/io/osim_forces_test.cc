#include "core/io/osim_forces.h"

#include <cmath>
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

std::string makeElement(const std::string& type, const std::string& properties) {
  std::string element = makeMuscleElement(properties);
  const std::string millard = "Millard2012EquilibriumMuscle";
  for (std::size_t at = 0; (at = element.find(millard, at)) != std::string::npos;) {
    element.replace(at, millard.size(), type);
  }
  return element;
}

// spec/muscle.md 10.
TEST(OsimForces, BareThelenMuscleHasTheClassDefaults) {
  const MuscleSpec muscle = readForces(makeElement("Thelen2003Muscle", "")).muscles.at(0);
  EXPECT_EQ(muscle.kind, MuscleKind::kThelen2003);
  EXPECT_EQ(muscle.thelen.tendon_strain_at_one_force, 0.04);
  EXPECT_EQ(muscle.thelen.passive_strain_at_one_force, 0.6);
  EXPECT_EQ(muscle.thelen.active_shape, 0.45);
  EXPECT_EQ(muscle.thelen.passive_shape, 5);
  EXPECT_EQ(muscle.thelen.velocity_shape, 0.25);
  EXPECT_EQ(muscle.thelen.max_eccentric_force, 1.4);
  EXPECT_EQ(muscle.thelen.linear_above_force, 0.95);
  EXPECT_EQ(muscle.max_contraction_velocity, 10);
  EXPECT_EQ(muscle.maximum_pennation, std::acos(0.1));
  EXPECT_EQ(muscle.activation_time_constant, 0.015);
  EXPECT_EQ(muscle.deactivation_time_constant, 0.050);
  EXPECT_EQ(muscle.minimum_activation, 0.01);
  EXPECT_EQ(muscle.default_activation, 0.05);
  EXPECT_EQ(muscle.default_fiber_length, 0.1);
  EXPECT_EQ(muscle.fiber_damping, 0);
  EXPECT_EQ(muscle.tendon, TendonKind::kElastic);
}

TEST(OsimForces, ThelenMuscleIsRefusedWhatItsEquationsCannotDo) {
  for (const char* property : {"<minimum_activation>0.009</minimum_activation>",
                               "<ignore_tendon_compliance>true</ignore_tendon_compliance>",
                               "<Flen>1</Flen>",
                               "<KshapeActive>0</KshapeActive>"}) {
    EXPECT_THROW(readForces(makeElement("Thelen2003Muscle", property)), Error) << property;
  }
}

TEST(OsimForces, SchutteMuscleHasItsRatesInUnitsOfItsTimeScale) {
  const MuscleSpec bare = readForces(makeElement("Schutte1993Muscle_Deprecated", "")).muscles.at(0);
  EXPECT_EQ(bare.kind, MuscleKind::kSchutte1993);
  EXPECT_EQ(bare.max_contraction_velocity, 10);
  EXPECT_DOUBLE_EQ(bare.schutte.excitation_rate, 76.67);
  EXPECT_DOUBLE_EQ(bare.schutte.activation_rate, 14.59854);
  EXPECT_EQ(bare.fiber_damping, 0.1);
  EXPECT_EQ(bare.minimum_activation, 0);
  EXPECT_FALSE(bare.schutte.active_force_length.has_value());
  const MuscleSpec stated =
      readForces(makeElement("Schutte1993Muscle_Deprecated",
                             "<time_scale>0.125</time_scale><activation1>0</activation1>"
                             "<activation2>2</activation2><damping>0.05</damping>"
                             "<tendon_force_length_curve><SimmSpline><x>0 1</x><y>0 30</y>"
                             "</SimmSpline></tendon_force_length_curve>"))
          .muscles.at(0);
  EXPECT_EQ(stated.max_contraction_velocity, 8);
  EXPECT_EQ(stated.schutte.excitation_rate, 0);
  EXPECT_EQ(stated.schutte.activation_rate, 16);
  EXPECT_EQ(stated.fiber_damping, 0.05);
  ASSERT_TRUE(stated.schutte.tendon_force_strain.has_value());
  EXPECT_EQ(stated.schutte.tendon_force_strain->y, (std::vector<double>{0, 30}));
}

ModelSpec readPath(const std::string& points, const std::string& version = "40000") {
  return readForces(
      "<Millard2012EquilibriumMuscle name=\"m\"><GeometryPath><PathPointSet><objects>"
      "<PathPoint name=\"a\"><socket_parent_frame>/bodyset/thigh</socket_parent_frame>"
      "</PathPoint>" +
          points + "</objects></PathPointSet></GeometryPath></Millard2012EquilibriumMuscle>",
      version);
}

TEST(OsimForces, ConditionalPointHasItsCoordinateAndRange) {
  const std::string body = "<socket_parent_frame>/bodyset/shank</socket_parent_frame>";
  const auto path = readPath("<ConditionalPathPoint name=\"b\">" + body +
                             "<location>1 2 3</location>"
                             "<socket_coordinate>/jointset/knee_joint/knee</socket_coordinate>"
                             "<range>-0.5 0.25</range></ConditionalPathPoint>"
                             "<ConditionalPathPoint name=\"c\">" +
                             body + "</ConditionalPathPoint>")
                        .muscles.at(0)
                        .path;
  EXPECT_EQ(path.at(0).kind, PathPointSpec::Kind::kFixed);
  EXPECT_EQ(path.at(1).kind, PathPointSpec::Kind::kConditional);
  EXPECT_EQ(path.at(1).body, "shank");
  EXPECT_EQ(path.at(1).location, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(path.at(1).coordinate, "knee");
  EXPECT_EQ(path.at(1).range_min, -0.5);
  EXPECT_EQ(path.at(1).range_max, 0.25);
  EXPECT_EQ(path.at(2).coordinate, "");
  EXPECT_EQ(path.at(2).range_max, 0);
}

TEST(OsimForces, MovingPointHasAFunctionPerAxisInBothLayouts) {
  const std::string functions =
      "<x_location><SimmSpline><x>0 1</x><y>2 3</y></SimmSpline></x_location>"
      "<y_location><MultiplierFunction><function><Constant><value>0.5</value></Constant></function>"
      "<scale>1.25</scale></MultiplierFunction></y_location>";
  const auto present = readPath(
      "<MovingPathPoint name=\"b\"><socket_parent_frame>/bodyset/shank</socket_parent_frame>"
      "<socket_x_coordinate>/jointset/knee_joint/knee</socket_x_coordinate>"
      "<socket_y_coordinate>/jointset/knee_joint/knee</socket_y_coordinate>"
      "<socket_z_coordinate>/jointset/knee_joint/knee</socket_z_coordinate>" +
      functions + "</MovingPathPoint>");
  const auto old = readPath(
      "<MovingPathPoint name=\"b\"><body>shank</body><x_coordinate>knee</x_coordinate>"
      "<y_coordinate>knee</y_coordinate><z_coordinate>knee</z_coordinate>" +
          functions + "</MovingPathPoint>",
      "30000");
  for (const ModelSpec* model : {&present, &old}) {
    const PathPointSpec& point = model->muscles.at(0).path.at(1);
    EXPECT_EQ(point.kind, PathPointSpec::Kind::kMoving);
    EXPECT_EQ(point.body, "shank");
    EXPECT_EQ(point.coordinate, "knee");
    EXPECT_EQ(point.location_functions[0].kind, FunctionSpec::Kind::kSimmSpline);
    EXPECT_EQ(point.location_functions[0].y, (std::vector<double>{2, 3}));
    EXPECT_EQ(point.location_functions[1].y, std::vector<double>{0.5});
    EXPECT_EQ(point.location_functions[1].scale, 1.25);
    EXPECT_EQ(point.location_functions[2].kind, FunctionSpec::Kind::kConstant);
    EXPECT_EQ(point.location_functions[2].y, std::vector<double>{0});
  }
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
