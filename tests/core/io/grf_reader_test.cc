#include "core/io/grf_reader.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "tests/support/shared_data.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

TEST(GrfReader, FindsEveryColumnFamily) {
  EXPECT_EQ(findForceFamilies({"ground_force_vx",
                               "ground_force_vy",
                               "ground_force_vz",
                               "1_ground_force_vx",
                               "1_ground_force_vy",
                               "1_ground_force_vz"}),
            (std::vector<std::string>{"ground_force", "1_ground_force"}));
  EXPECT_EQ(findForceFamilies({"R_ground_force_vx", "R_ground_force_vy", "R_ground_force_vz"}),
            (std::vector<std::string>{"R_ground_force"}));
  EXPECT_EQ(findForceFamilies({"ground_force_l_vz", "ground_force_l_vy", "ground_force_l_vx"}),
            (std::vector<std::string>{"ground_force_l"}));
  EXPECT_EQ(findForceFamilies({"ground_force_2_vx", "ground_force_2_vy", "ground_force_2_vz"}),
            (std::vector<std::string>{"ground_force_2"}));
  EXPECT_EQ(findForceFamilies({"f1_1", "f1_2", "f1_3", "m1_1"}), (std::vector<std::string>{"f1"}));
  EXPECT_TRUE(findForceFamilies({"force_x", "ground_force_vx", "far_1"}).empty());
}

TEST(GrfReader, UnloadedSamplesBecomeExactlyZero) {
  const TableFile table = readTable(
      "time ground_force_r_vx ground_force_r_vy ground_force_r_vz ground_force_r_px "
      "ground_force_r_py ground_force_r_pz ground_torque_r_x ground_torque_r_y ground_torque_r_z\n"
      "0 1 19.9 2 346 0 nan 0 3 0\n1 1 500 2 0.1 0 0.2 0 3 0\n",
      "grf.mot");
  const GroundReaction reaction = readGroundReaction(table);
  ASSERT_EQ(reaction.forces.size(), 1u);
  const ExternalForce& force = reaction.forces[0];
  EXPECT_EQ(force.body, "calcn_r");
  EXPECT_TRUE(force.force.col(0).isZero(0));
  EXPECT_TRUE(force.torque.col(0).isZero(0));
  EXPECT_EQ(force.force.col(1), Eigen::Vector3d(1, 500, 2));
  EXPECT_EQ(force.torque.col(1), Eigen::Vector3d(0, 3, 0));
}

/// One plate at 100 Hz, loaded from row 10 to row 59; `missing` rows have no centre of pressure.
GroundReaction makePlate(const std::vector<int>& missing) {
  GroundReaction plates;
  ExternalForce force;
  force.name = "f1";
  force.force = force.torque = Eigen::Matrix3Xd::Zero(3, 80);
  force.point = Eigen::Matrix3Xd::Constant(3, 80, std::nan(""));
  for (int row = 0; row < 80; ++row) {
    plates.time.push_back(0.01 * row);
    if (row >= 10 && row < 60) {
      force.force(1, row) = 600;
      force.point.col(row) << 0.01 * row, 0, 0.2;
    }
  }
  for (const int row : missing) {
    force.point.col(row).setConstant(std::nan(""));
  }
  plates.forces = {force};
  return plates;
}

GroundReaction select(GroundReaction plates, std::vector<std::string>& warnings) {
  return selectForces(std::move(plates), {Foot::kRight}, {}, nullptr, &warnings);
}

TEST(SelectForces, CentresOfPressureMayBeMissingOffThePlate) {
  std::vector<std::string> warnings;
  EXPECT_EQ(select(makePlate({}), warnings).forces.size(), 1U);
  EXPECT_TRUE(warnings.empty());
}

TEST(SelectForces, MissingEdgesOfAContactAreBridgedWithAWarning) {
  std::vector<std::string> warnings;
  const ExternalForce force = select(makePlate({10, 11, 59}), warnings).forces[0];
  EXPECT_EQ(force.point(0, 10), 0.01 * 12);
  EXPECT_EQ(force.point(0, 11), 0.01 * 12);
  EXPECT_EQ(force.point(0, 59), 0.01 * 58);
  EXPECT_EQ(force.force(1, 10), 600);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("centre of pressure"), std::string::npos);
}

TEST(SelectForces, MissingCentresUnderLoadAreRefusedByNameAndTime) {
  for (const std::vector<int>& missing :
       {std::vector<int>{30}, {10, 11, 12, 13}, {59, 58, 57, 56}}) {
    std::vector<std::string> warnings;
    try {
      select(makePlate(missing), warnings);
      ADD_FAILURE() << "row " << missing[0];
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kGrfValue);
      EXPECT_EQ(error.where().field, "f1");
    }
  }
}

TEST(SelectForces, KeepsUnnamedPlatesWhereContactsTellTheFeet) {
  std::vector<std::string> warnings;
  GrfOptions options;
  EXPECT_THROW(selectForces(makePlate({}), {Foot::kUnknown}, options, nullptr), Error);
  options.unnamed = UnnamedPlates::kKeep;
  const GroundReaction kept = selectForces(makePlate({}), {Foot::kUnknown}, options, nullptr);
  ASSERT_EQ(kept.forces.size(), 1U);
  EXPECT_EQ(kept.forces[0].body, "");
}

TEST(GrfReader, NumberedPlatesNeedAnAssignment) {
  const TableFile table = readTable(
      "time ground_force_1_vx ground_force_1_vy ground_force_1_vz ground_force_1_px "
      "ground_force_1_py ground_force_1_pz ground_force_1_mx ground_force_1_my ground_force_1_mz\n"
      "0 0 700 0 0.1 0 0.2 0 3 0\n",
      "grf.mot");
  EXPECT_THROW(readGroundReaction(table), Error);
  GrfOptions options;
  options.plates = {{"ground_force_1", "calcn_l"}};
  const GroundReaction reaction = readGroundReaction(table, options);
  EXPECT_EQ(reaction.forces.at(0).body, "calcn_l");
  EXPECT_EQ(reaction.forces.at(0).torque(1, 0), 3);
  options.plates = {{"ground_force_7", "calcn_l"}};
  EXPECT_THROW(readGroundReaction(table, options), Error);
}

class GrfReaderShared : public SharedDataTest {
 protected:
  GroundReaction read(const std::string& relative, const GrfOptions& options = {}) const {
    return readGroundReaction(readTable(readFile(shared(relative)), relative), options);
  }
};

using Intervals = std::vector<std::pair<double, double>>;

Intervals findContacts(const GroundReaction& reaction, std::size_t which) {
  const auto vertical = reaction.forces[which].force.row(1);
  Intervals intervals;
  bool inside = false;
  for (std::size_t i = 0; i < reaction.time.size(); ++i) {
    const bool loaded = vertical[static_cast<Eigen::Index>(i)] > 0;
    if (loaded && !inside) {
      intervals.emplace_back(reaction.time[i], reaction.time[i]);
    }
    if (loaded) {
      intervals.back().second = reaction.time[i];
    }
    inside = loaded;
  }
  return intervals;
}

void expectContacts(const Intervals& found, const Intervals& expected, double resolution) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i].first, expected[i].first, tol(resolution));
    EXPECT_NEAR(found[i].second, expected[i].second, tol(resolution));
  }
}

// data/README.md 5: contacts above 20 N, peak force; times printed to 1 ms, samples every 0.5 ms.
TEST_F(GrfReaderShared, WalkingContactsAndPeak) {
  const GroundReaction reaction = read("data/walk/grf_walk.mot");
  ASSERT_EQ(reaction.forces.size(), 2u);
  EXPECT_EQ(reaction.forces[0].body, "calcn_r");
  EXPECT_EQ(reaction.forces[1].body, "calcn_l");
  expectContacts(findContacts(reaction, 0), {{0.268, 1.024}, {1.412, 2.167}}, 1.1e-3);
  expectContacts(findContacts(reaction, 1), {{0.837, 1.589}}, 1.1e-3);
  const double peak = std::max(reaction.forces[0].force.row(1).maxCoeff(),
                               reaction.forces[1].force.row(1).maxCoeff());
  EXPECT_NEAR(peak, 943, tol(0.5));
}

TEST_F(GrfReaderShared, RunningContactsAndPeak) {
  const GroundReaction reaction = read("data/run/paper_subject01/grf_run.mot");
  ASSERT_EQ(reaction.forces.size(), 2u);
  EXPECT_EQ(reaction.forces[0].name, "R_ground_force");
  Intervals right = findContacts(reaction, 0);
  right.erase(right.begin());  // the trial begins within a contact
  expectContacts(right,
                 {{0.868, 1.106},
                  {1.552, 1.799},
                  {2.230, 2.480},
                  {2.916, 3.161},
                  {3.619, 3.862},
                  {4.297, 4.547},
                  {4.988, 5.233}},
                 1.1e-3);
  expectContacts(findContacts(reaction, 1),
                 {{0.512, 0.760},
                  {1.213, 1.455},
                  {1.886, 2.138},
                  {2.576, 2.825},
                  {3.273, 3.521},
                  {3.962, 4.210},
                  {4.644, 4.893}},
                 1.1e-3);
  EXPECT_NEAR(std::max(reaction.forces[0].force.row(1).maxCoeff(),
                       reaction.forces[1].force.row(1).maxCoeff()),
              1977,
              tol(0.5));
}

TEST_F(GrfReaderShared, UnprefixedColumnsAreTheRightFoot) {
  const GroundReaction reaction = read("data/run/hamner2010/subject02_running_grf.mot");
  ASSERT_EQ(reaction.forces.size(), 2u);
  EXPECT_EQ(reaction.forces[0].name, "ground_force");
  EXPECT_EQ(reaction.forces[0].body, "calcn_r");
  EXPECT_EQ(reaction.forces[1].name, "1_ground_force");
  EXPECT_EQ(reaction.forces[1].body, "calcn_l");
  EXPECT_EQ(findContacts(reaction, 0).size(), 14u);
}

TEST_F(GrfReaderShared, MixedHeaderFileHasItsContacts) {
  const GroundReaction reaction = read("data/run/hamner2013_subject04/run400/grf.mot");
  ASSERT_EQ(reaction.forces.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const Intervals expected = reaction.forces[i].body == "calcn_r"
                                   ? Intervals{{0.651, 0.912}, {1.343, 1.614}, {2.049, 2.304}}
                                   : Intervals{{1.014, 1.264}, {1.696, 1.958}, {2.389, 2.655}};
    expectContacts(findContacts(reaction, i), expected, 1.1e-3);
  }
}

}  // namespace
}  // namespace gaitmill
