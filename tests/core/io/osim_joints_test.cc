#include "core/io/osim_joints.h"

#include <string>

#include <gtest/gtest.h>

#include "core/io/osim_reader.h"
#include "tests/core/io/osim_samples.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

JointSpec readKnee(const OsimPieces& pieces) {
  return readOsim(makeOsim(pieces), "leg.osim").joints.at(1);
}

std::string makeAxis(const std::string& slot, const std::string& rest) {
  return "<TransformAxis name=\"" + slot + "\">" + rest + "</TransformAxis>";
}

// spec/model.md 4.1: generalized coordinates are numbered by first appearance on the axes.
TEST(OsimJoints, CoordinatesFollowTheAxesNotTheDocument) {
  const std::string line = "<LinearFunction name=\"function\"/>";
  OsimPieces pieces;
  pieces.knee_coordinates =
      "<Coordinate name=\"slide\"/><Coordinate name=\"turn\"/><Coordinate name=\"tilt\"/>";
  pieces.knee_transform =
      makeAxis("translation1", "<coordinates>slide</coordinates>" + line) +
      makeAxis("rotation2", "<coordinates>turn</coordinates><axis>0 1 0</axis>" + line) +
      makeAxis("rotation1", "<coordinates>tilt</coordinates><axis>1 0 0</axis>" + line);
  const JointSpec knee = readKnee(pieces);
  ASSERT_EQ(knee.coordinates.size(), 3u);
  EXPECT_EQ(knee.coordinates[0].name, "tilt");
  EXPECT_EQ(knee.coordinates[1].name, "turn");
  EXPECT_EQ(knee.coordinates[2].name, "slide");
}

TEST(OsimJoints, AbsentAxesAreXYZAndDoNothing) {
  const JointSpec knee = readKnee({});
  EXPECT_EQ(knee.axes[4].axis, Eigen::Vector3d::UnitY());
  EXPECT_EQ(knee.axes[5].axis, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(knee.axes[4].function.kind, FunctionSpec::Kind::kConstant);
  EXPECT_EQ(knee.axes[4].function.y.at(0), 0);
}

// Verified against OpenSim in the specification.
TEST(OsimJoints, CoordinateWithoutFunctionDoesNothing) {
  OsimPieces pieces;
  pieces.knee_transform += makeAxis("translation1", "<coordinates>knee</coordinates>");
  const JointSpec knee = readKnee(pieces);
  EXPECT_EQ(knee.axes[3].coordinate, "knee");
  EXPECT_EQ(knee.axes[3].function.kind, FunctionSpec::Kind::kConstant);
}

TEST(OsimJoints, AxesAreNormalised) {
  OsimPieces pieces;
  pieces.knee_transform = makeAxis("rotation1",
                                   "<coordinates>knee</coordinates><axis>3 0 -4</axis>"
                                   "<LinearFunction name=\"function\"/>");
  EXPECT_LT((readKnee(pieces).axes[0].axis - Eigen::Vector3d(0.6, 0, -0.8)).norm(), tol(1e-16));
}

TEST(OsimJoints, MultipliersOfMultipliersMultiply) {
  OsimPieces pieces;
  pieces.knee_transform +=
      makeAxis("translation2",
               "<coordinates>knee</coordinates><MultiplierFunction name=\"function\"><function>"
               "<MultiplierFunction><function><PolynomialFunction><coefficients>1 2 3"
               "</coefficients></PolynomialFunction></function><scale>2</scale>"
               "</MultiplierFunction></function><scale>0.75</scale></MultiplierFunction>");
  const FunctionSpec function = readKnee(pieces).axes[4].function;
  EXPECT_EQ(function.kind, FunctionSpec::Kind::kPolynomial);
  EXPECT_EQ(function.scale, 1.5);
  EXPECT_EQ(function.y, (std::vector<double>{1, 2, 3}));
}

TEST(OsimJoints, OldJointStandsInItsChildAndMayBeReversed) {
  const std::string document =
      "<OpenSimDocument Version=\"30000\"><Model name=\"m\"><BodySet><objects>"
      "<Body name=\"ground\"><mass>0</mass><Joint/></Body>"
      "<Body name=\"leg\"><mass>1</mass><inertia_xx>2</inertia_xx><Joint><PinJoint name=\"hip\">"
      "<parent_body>ground</parent_body><location_in_parent>1 2 3</location_in_parent>"
      "<orientation>0 0 0.123456789012</orientation><CoordinateSet><objects>"
      "<Coordinate name=\"q\"/></objects></CoordinateSet></PinJoint></Joint></Body>"
      "</objects></BodySet></Model></OpenSimDocument>";
  const ModelSpec spec = readOsim(document, "m.osim");
  ASSERT_EQ(spec.bodies.size(), 1u) << "ground is no body";
  EXPECT_EQ(spec.bodies[0].inertia, (std::array<double, 6>{2, 1, 1, 0, 0, 0}));
  EXPECT_EQ(spec.joints.at(0).parent.body, "ground");
  EXPECT_EQ(spec.joints.at(0).parent.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(spec.joints.at(0).child.body, "leg");
  EXPECT_EQ(spec.joints.at(0).child.orientation[2], 0.123456789012) << "full precision is kept";
}

}  // namespace
}  // namespace gaitmill
