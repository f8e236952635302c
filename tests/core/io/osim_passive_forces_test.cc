#include "core/io/osim_passive_forces.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/io/osim_reader.h"
#include "tests/core/io/osim_samples.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

using Kind = PassiveForceSpec::Kind;

PassiveForceSpec readForce(const std::string& element) {
  OsimPieces pieces;
  pieces.forces = element;
  return readOsim(makeOsim(pieces), "leg.osim").passive_forces.at(0);
}

// Limits of rotations are in degrees and per degree; here the knee turns.
TEST(OsimPassiveForces, LimitForcesComeInDegrees) {
  const PassiveForceSpec force = readForce(
      "<CoordinateLimitForce name=\"stop\"><coordinate>knee</coordinate>"
      "<upper_stiffness>20</upper_stiffness><upper_limit>10</upper_limit>"
      "<lower_stiffness>30</lower_stiffness><lower_limit>-120</lower_limit>"
      "<damping>0.5</damping><transition>5</transition></CoordinateLimitForce>");
  EXPECT_EQ(force.kind, Kind::kCoordinateLimit);
  EXPECT_EQ(force.coordinate, "knee");
  EXPECT_NEAR(force.upper_limit, toRadians(10), tol(1e-15));
  EXPECT_NEAR(force.lower_limit, toRadians(-120), tol(1e-15));
  EXPECT_NEAR(force.upper_stiffness, 20 * kDegreesPerRadian, tol(1e-10));
  EXPECT_NEAR(force.lower_stiffness, 30 * kDegreesPerRadian, tol(1e-10));
  EXPECT_NEAR(force.damping, 0.5 * kDegreesPerRadian, tol(1e-12));
  EXPECT_NEAR(force.transition, toRadians(5), tol(1e-15));
}

TEST(OsimPassiveForces, FormulasAreCheckedWhereTheyStand) {
  EXPECT_EQ(readForce("<ExpressionBasedCoordinateForce name=\"f\"><coordinate>hip</coordinate>"
                      "<expression> -10*q^3 </expression></ExpressionBasedCoordinateForce>")
                .expressions[0],
            "-10*q^3");
  try {
    readForce(
        "<ExpressionBasedCoordinateForce name=\"f\"><coordinate>hip</coordinate>\n"
        "<expression>-10*speed</expression></ExpressionBasedCoordinateForce>");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kModelValue);
    EXPECT_EQ(error.where().line, 2);
    EXPECT_NE(error.message().find("'speed'"), std::string::npos) << error.message();
  }
}

TEST(OsimPassiveForces, BushingsStandInFramesOfTheirOwn) {
  const PassiveForceSpec force = readForce(
      "<BushingForce name=\"disc\"><socket_frame1>f1</socket_frame1>"
      "<socket_frame2>/bodyset/shank</socket_frame2><frames>"
      "<PhysicalOffsetFrame name=\"f1\"><socket_parent>/bodyset/thigh</socket_parent>"
      "<translation>0 -0.4 0</translation><orientation>0 0.1 0</orientation>"
      "</PhysicalOffsetFrame></frames><rotational_stiffness>1 2 3</rotational_stiffness>"
      "<translational_damping>4 5 6</translational_damping></BushingForce>");
  EXPECT_EQ(force.kind, Kind::kBushing);
  EXPECT_EQ(force.frame1.body, "thigh");
  EXPECT_EQ(force.frame1.translation, Eigen::Vector3d(0, -0.4, 0));
  EXPECT_EQ(force.frame1.orientation, Eigen::Vector3d(0, 0.1, 0));
  EXPECT_EQ(force.frame2.body, "shank");
  EXPECT_EQ(force.rotational_stiffness, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(force.translational_stiffness, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(force.translational_damping, Eigen::Vector3d(4, 5, 6));
}

TEST(OsimPassiveForces, OldBushingsNameBodiesAndLocations) {
  const PassiveForceSpec force = readForce(
      "<ExpressionBasedBushingForce name=\"old\"><body_1>thigh</body_1><body_2>shank</body_2>"
      "<location_body_2>0 0.1 0</location_body_2><Mx_expression>10*theta_x</Mx_expression>"
      "<Fz_expression>5*delta_z^3</Fz_expression></ExpressionBasedBushingForce>");
  EXPECT_EQ(force.frame1.body, "thigh");
  EXPECT_EQ(force.frame2.translation, Eigen::Vector3d(0, 0.1, 0));
  EXPECT_EQ(force.expressions[0], "10*theta_x");
  EXPECT_EQ(force.expressions[1], "0");
  EXPECT_EQ(force.expressions[5], "5*delta_z^3");
}

TEST(OsimPassiveForces, ForcesThatAreOffAreLeftOut) {
  OsimPieces pieces;
  pieces.forces =
      "<SpringGeneralizedForce name=\"s\"><appliesForce>false</appliesForce>"
      "<coordinate>hip</coordinate></SpringGeneralizedForce>";
  EXPECT_TRUE(readOsim(makeOsim(pieces), "leg.osim").passive_forces.empty());
}

}  // namespace
}  // namespace gaitmill
