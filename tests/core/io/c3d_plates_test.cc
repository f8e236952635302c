#include "core/io/c3d_plates.h"

#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/io/c3d_reader.h"
#include "tests/support/c3d_writer.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

// A plate of 0.4 m by 0.6 m around (1, 2, 0) m whose x axis is the laboratory's -y and whose y axis
// is its -x; its z axis points down. [mm]
const std::vector<double> kCorners = {700, 1800, 0, 700, 2200, 0, 1300, 2200, 0, 1300, 1800, 0};
const Eigen::Vector3d kCentre(1.0, 2.0, 0.0);

Eigen::Vector3d toLab(const Eigen::Vector3d& plate) {
  return {-plate.y(), -plate.x(), -plate.z()};
}

/// What a foot does, in plate axes: force on the plate's sensors, point on the surface, free
/// moment.
struct Load {
  Eigen::Vector3d force{30, -50, -700};   // [N]
  Eigen::Vector3d point{0.05, -0.12, 0};  // [m]
  double free_moment = 4.0;               // [N.m]

  /// Moment about a point at `p` of the plate's axes [N.m].
  Eigen::Vector3d momentAbout(const Eigen::Vector3d& p) const {
    return (point - p).cross(force) + Eigen::Vector3d(0, 0, free_moment);
  }
};

C3dWriter makePlateTrial(int type,
                         const std::vector<double>& origin,
                         const std::vector<double>& channels,
                         const std::vector<std::string>& units) {
  C3dWriter writer;
  writer.points = {{1, 2, 3, 0}};
  writer.analog = {channels};
  writer.addPointGroup({"A"});
  writer.addAnalogGroup(std::vector<std::string>(channels.size(), "F"), units);
  writer.addPlate(type, kCorners, origin, static_cast<int>(channels.size()));
  return writer;
}

void expectLoad(const C3dFile& file, const Load& load) {
  ASSERT_EQ(file.ground_reaction.forces.size(), 1u)
      << (file.warnings.empty() ? "" : file.warnings[0]);
  const ExternalForce& force = file.ground_reaction.forces[0];
  EXPECT_EQ(force.name, "plate_1");
  EXPECT_EQ(force.body, "");
  // Channels are floats: seven digits of 700 N and of 1e5 N.mm.
  EXPECT_LT((force.force.col(0) - toLab(load.force)).norm(), tol(2e-4));
  EXPECT_LT((force.point.col(0) - kCentre - toLab(load.point)).norm(), tol(1e-6));
  EXPECT_LT((force.torque.col(0) - toLab({0, 0, load.free_moment})).norm(), tol(1e-4));
}

const std::vector<std::string> kNewtonMillimetres = {"N", "N", "N", "Nmm", "Nmm", "Nmm"};

TEST(C3dPlates, TypeOneStatesItsCentreOfPressure) {
  const Load load;
  const C3dWriter writer = makePlateTrial(
      1, {0, 0, -40}, {30, -50, -700, 50, -120, 4000}, {"N", "N", "N", "mm", "mm", "Nmm"});
  expectLoad(readC3d(writer.write(), "a.c3d"), load);
}

// Sensors 40 mm below the surface (z points down) and 3, -2 mm beside its centre: the origin is the
// vector from them to the centre.
TEST(C3dPlates, TypeTwoMovesItsMomentToTheSurface) {
  const Load load;
  const Eigen::Vector3d origin(0.003, -0.002, -0.040);
  const Eigen::Vector3d m = 1000.0 * load.momentAbout(-origin);
  const std::vector<double> channels = {30, -50, -700, m.x(), m.y(), m.z()};
  expectLoad(readC3d(makePlateTrial(2, {3, -2, -40}, channels, kNewtonMillimetres).write(), "a"),
             load);
  // Many files state the vector the other way round.
  expectLoad(readC3d(makePlateTrial(2, {-3, 2, 40}, channels, kNewtonMillimetres).write(), "a"),
             load);
}

TEST(C3dPlates, MomentsInNewtonMetresAreTakenAsSuch) {
  const Load load;
  const Eigen::Vector3d m = load.momentAbout({0, 0, 0.040});
  const C3dWriter writer = makePlateTrial(
      2, {0, 0, -40}, {30, -50, -700, m.x(), m.y(), m.z()}, {"N", "N", "N", "Nm", "Nm", "N.m"});
  expectLoad(readC3d(writer.write(), "a.c3d"), load);
}

// Four sensors at (+-a, +-b), 50 mm below the surface: any split of the load among them that has
// the right sums must give the same wrench.
TEST(C3dPlates, TypeThreeAddsItsFourSensors) {
  const double a = 0.120;
  const double b = 0.200;
  const double depth = 0.050;
  // Forces of the sensors 1 (+a, +b), 2 (-a, +b), 3 (-a, -b), 4 (+a, -b).
  const std::vector<Eigen::Vector3d> forces = {
      {3, -10, -150}, {9, -14, -210}, {8, -16, -240}, {10, -10, -100}};
  const std::vector<Eigen::Vector3d> places = {{a, b, 0}, {-a, b, 0}, {-a, -b, 0}, {a, -b, 0}};
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 4; ++i) {
    force += forces[i];
    moment += places[i].cross(forces[i]);
  }
  moment += Eigen::Vector3d(0, 0, depth).cross(force);  // about the centre of the surface
  Load load;
  load.force = force;
  load.point = Eigen::Vector3d(-moment.y() / force.z(), moment.x() / force.z(), 0);
  load.free_moment = moment.z() - load.point.x() * force.y() + load.point.y() * force.x();
  const std::vector<double> channels = {forces[0].x() + forces[1].x(),
                                        forces[2].x() + forces[3].x(),
                                        forces[0].y() + forces[3].y(),
                                        forces[1].y() + forces[2].y(),
                                        forces[0].z(),
                                        forces[1].z(),
                                        forces[2].z(),
                                        forces[3].z()};
  const std::vector<std::string> units(8, "N");
  expectLoad(readC3d(makePlateTrial(3, {120, 200, -50}, channels, units).write(), "a.c3d"), load);
  expectLoad(readC3d(makePlateTrial(3, {120, 200, 50}, channels, units).write(), "a.c3d"), load);
}

TEST(C3dPlates, TypeFourAppliesItsMatrixColumnByColumn) {
  const Load load;
  const Eigen::Vector3d m = 1000.0 * load.momentAbout({0, 0, 0.040});
  Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Identity();
  matrix.diagonal() << 2, 2, 5, 800, 700, 400;
  matrix(2, 0) = 0.25;  // crosstalk of channel 1 into the vertical force
  matrix(3, 1) = -12;
  Eigen::Matrix<double, 6, 1> wrench;
  wrench << load.force, m;
  const Eigen::Matrix<double, 6, 1> raw = matrix.inverse() * wrench;
  C3dWriter writer = makePlateTrial(
      4, {0, 0, -40}, {raw.data(), raw.data() + 6}, std::vector<std::string>(6, "V"));
  const C3dFile without = readC3d(writer.write(), "a.c3d");
  EXPECT_TRUE(without.ground_reaction.forces.empty());
  EXPECT_NE(without.plates[0].refusal.find("CAL_MATRIX"), std::string::npos);
  writer.addReals("FORCE_PLATFORM", "CAL_MATRIX", {6, 6, 1}, {matrix.data(), matrix.data() + 36});
  expectLoad(readC3d(writer.write(), "a.c3d"), load);
}

TEST(C3dPlates, UnsupportedTypesAreRefusedAndTheRestIsRead) {
  for (const int type : {0, 5, 6, 7, 11, 12, 21}) {
    C3dWriter writer =
        makePlateTrial(type, {0, 0, -40}, {1, 2, 3, 4, 5, 6, 7, 8}, std::vector<std::string>(8));
    const C3dFile file = readC3d(writer.write(), "a.c3d");
    EXPECT_EQ(file.markers.markerCount(), 1);
    EXPECT_TRUE(file.ground_reaction.forces.empty());
    ASSERT_EQ(file.plates.size(), 1u);
    EXPECT_NE(file.plates[0].refusal.find("type is " + std::to_string(type)), std::string::npos);
    EXPECT_EQ(file.analog.columnCount(), 0) << "channels of the plate are no EMG";
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_NE(file.warnings[0].find("plate_1"), std::string::npos);
  }
}

TEST(C3dPlates, PlatesThatCannotBeAreRefusedOneByOne) {
  C3dWriter writer;
  writer.analog = {{0, 0, -100, 0, 0, 0, 0, 0, -100, 0, 0, 0}};
  writer.addAnalogGroup({}, {});
  writer.addWords("FORCE_PLATFORM", "USED", {}, {4});
  writer.addWords("FORCE_PLATFORM", "TYPE", {4}, {2, 2, 2, 2});
  std::vector<double> corners = kCorners;
  corners.insert(corners.end(), 12, 0.0);  // plate 2 lies nowhere
  corners.insert(corners.end(), kCorners.begin(), kCorners.end());
  corners.insert(corners.end(), kCorners.begin(), kCorners.end());
  writer.addReals("FORCE_PLATFORM", "CORNERS", {3, 4, 4}, corners);
  writer.addReals("FORCE_PLATFORM", "ORIGIN", {3, 4}, std::vector<double>(12, -1.0));
  writer.addWords(
      "FORCE_PLATFORM", "CHANNEL", {6, 4}, {1,  2,  3,  4,  5,  6,
                                            7,  8,  9,  10, 11, 12,    // two good ones
                                            1,  2,  3,  4,  5,  6,     // of plate 1 already
                                            13, 14, 15, 16, 17, 18});  // not in the file
  const C3dFile file = readC3d(writer.write(), "a.c3d");
  ASSERT_EQ(file.ground_reaction.forces.size(), 1u);
  EXPECT_EQ(file.plates[0].refusal, "");
  EXPECT_NE(file.plates[1].refusal.find("rectangle"), std::string::npos);
  EXPECT_NE(file.plates[2].refusal.find("another plate"), std::string::npos);
  EXPECT_NE(file.plates[3].refusal.find("not in the file"), std::string::npos);
}

TEST(C3dPlates, ForcesOnThePlateAreTurnedToTheSubject) {
  Load load;
  const Eigen::Vector3d m = 1000.0 * load.momentAbout({0, 0, 0.040});
  const C3dWriter writer =
      makePlateTrial(2, {0, 0, -40}, {-30, 50, 700, -m.x(), -m.y(), -m.z()}, kNewtonMillimetres);
  const C3dFile file = readC3d(writer.write(), "a.c3d");
  expectLoad(file, load);
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_NE(file.warnings[0].find("turned around"), std::string::npos);
}

TEST(C3dPlates, AnUnloadedPlateHasItsCentreAsPoint) {
  const C3dWriter writer =
      makePlateTrial(2, {0, 0, -40}, {0, 0, 0, 10, 20, 30}, kNewtonMillimetres);
  const ExternalForce force = readC3d(writer.write(), "a.c3d").ground_reaction.forces[0];
  EXPECT_LT((force.point.col(0) - kCentre).norm(), tol(1e-12));
  EXPECT_NEAR(force.torque(2, 0), -0.030, tol(1e-9));
}

TEST(C3dPlates, BaselineIsSubtractedOnlyWhenAsked) {
  C3dWriter writer;
  for (int i = 0; i < 4; ++i) {
    const double fz = i < 2 ? -5.0 : -105.0;
    writer.points.push_back({1, 2, 3, 0});
    writer.analog.push_back({0, 0, fz, 0, 0, 0});
  }
  writer.addPointGroup({"A"});
  writer.addAnalogGroup({}, {});
  writer.addPlate(2, kCorners, {0, 0, -40}, 6);
  writer.addWords("FORCE_PLATFORM", "ZERO", {2}, {1, 2});
  EXPECT_NEAR(readC3d(writer.write(), "a").ground_reaction.forces[0].force(2, 3), 105, tol(1e-6));
  C3dOptions options;
  options.baseline = C3dOptions::Baseline::kSubtract;
  const C3dFile file = readC3d(writer.write(), "a", options);
  EXPECT_NEAR(file.ground_reaction.forces[0].force(2, 3), 100, tol(1e-6));
  EXPECT_NEAR(file.ground_reaction.forces[0].force(2, 0), 0, tol(1e-6));
}

}  // namespace
}  // namespace gaitmill
