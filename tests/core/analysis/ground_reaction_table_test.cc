#include "core/analysis/ground_reaction_table.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

/// Five samples at 2 kHz of constant loads: force F at p with torque T each.
struct Load {
  Eigen::Vector3d F, p, T;
};
GroundReaction makeReaction(const std::vector<Load>& loads) {
  GroundReaction reaction;
  reaction.time = {0, 0.0005, 0.001, 0.0015, 0.002};
  for (const Load& load : loads) {
    ExternalForce force;
    force.force = load.F.replicate(1, 5);
    force.point = load.p.replicate(1, 5);
    force.torque = load.T.replicate(1, 5);
    reaction.forces.push_back(force);
  }
  return reaction;
}

double read(const TimeSeries& table, const char* label, int row = 0) {
  return table.values(row, table.getColumn(label));
}

TEST(GroundReactionTable, GivesForceCentreOfPressureAndFreeMomentBack) {
  const GroundReaction reaction = makeReaction(
      {{{30, 700, -20}, {0.4, 0, 0.1}, {0, 5, 0}}, {{-10, 300, 8}, {0.9, 0, -0.1}, {0, -2, 0}}});
  const TimeSeries table =
      makeGroundReactionTable(reaction, {Foot::kRight, Foot::kLeft}, 0, 1, 0.001);
  EXPECT_EQ(read(table, "right_fy"), 700);
  EXPECT_EQ(read(table, "left_fx"), -10);
  EXPECT_NEAR(read(table, "right_px"), 0.4, tol(1e-15));
  EXPECT_NEAR(read(table, "right_py"), 0, tol(1e-15));
  EXPECT_NEAR(read(table, "right_pz"), 0.1, tol(1e-15));
  EXPECT_NEAR(read(table, "right_my"), 5, tol(1e-12));
  EXPECT_NEAR(read(table, "left_my"), -2, tol(1e-12));
  EXPECT_EQ(table.units[static_cast<std::size_t>(table.getColumn("right_my"))], "N.m");
}

// Filtered forces come as force and moment about the origin; the table must not notice.
TEST(GroundReactionTable, DoesNotDependOnWhereTheFileAppliesTheForce) {
  const Eigen::Vector3d F(30, 700, -20);
  const Eigen::Vector3d p(0.4, 0, 0.1);
  const Eigen::Vector3d T(0, 5, 0);
  const GroundReaction reaction = makeReaction({{F, {0, 0, 0}, p.cross(F) + T}});
  const TimeSeries table = makeGroundReactionTable(reaction, {Foot::kRight}, 0, 1, 0.001);
  EXPECT_NEAR(read(table, "right_px"), 0.4, tol(1e-15));
  EXPECT_NEAR(read(table, "right_pz"), 0.1, tol(1e-15));
  EXPECT_NEAR(read(table, "right_my"), 5, tol(1e-12));
}

TEST(GroundReactionTable, TwoPlatesUnderOneFootAddUp) {
  const GroundReaction reaction = makeReaction(
      {{{0, 300, 0}, {0.2, 0.5, 0}, {0, 1, 0}}, {{0, 100, 0}, {0.6, 0.5, 0}, {0, 2, 0}}});
  const TimeSeries table =
      makeGroundReactionTable(reaction, {Foot::kRight, Foot::kRight}, 0, 1, 0.001);
  EXPECT_NEAR(read(table, "right_fy"), 400, tol(1e-12));
  EXPECT_NEAR(read(table, "right_px"), 0.3, tol(1e-15));
  EXPECT_NEAR(read(table, "right_py"), 0.5, tol(1e-15));
  EXPECT_NEAR(read(table, "right_my"), 3, tol(1e-12));
  EXPECT_EQ(read(table, "left_fy"), 0);
}

TEST(GroundReactionTable, AnUnloadedFootHasNoCentreOfPressure) {
  const GroundReaction reaction = makeReaction({{{1, 19, 0}, {0.2, 0, 0}, {0, 1, 0}}});
  const TimeSeries table = makeGroundReactionTable(reaction, {Foot::kLeft}, 0, 1, 0.001);
  EXPECT_EQ(read(table, "left_fy"), 19);
  EXPECT_TRUE(std::isnan(read(table, "left_px")));
  EXPECT_EQ(read(table, "left_my"), 0);
}

TEST(GroundReactionTable, KeepsEveryMillisecondOfTheInterval) {
  const GroundReaction reaction = makeReaction({{{0, 100, 0}, {0, 0, 0}, {0, 0, 0}}});
  const TimeSeries all = makeGroundReactionTable(reaction, {Foot::kLeft}, 0, 1, 0.001);
  EXPECT_EQ(all.time, (std::vector<double>{0, 0.001, 0.002}));
  const TimeSeries part = makeGroundReactionTable(reaction, {Foot::kLeft}, 0.0005, 0.0015, 0.001);
  EXPECT_EQ(part.time, (std::vector<double>{0.0005, 0.0015}));
}

}  // namespace
}  // namespace gaitmill
