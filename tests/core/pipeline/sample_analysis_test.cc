// What follows from the muscle forces of the embedded trial: each table against the others, and the
// energy of the whole body over the cycle.
#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "core/pipeline/pipeline.h"
#include "tests/support/sample_input.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

using Json = nlohmann::json;

const PipelineResult& runWhole() {
  static const PipelineResult result =
      Pipeline().run(readSampleInput(), readInput("models/settings/default.json"), {});
  return result;
}

/// The same without computed muscle control.
const PipelineResult& runToStaticOptimization() {
  static const PipelineResult result =
      Pipeline().run(readSampleInput(), {"to_so.json", R"({"stages": {"last": "so"}})"}, {});
  return result;
}

const TimeSeries& table(const std::string& name) {
  return runWhole().tables.at(name);
}

const ModelSpec& model() {
  static const ModelSpec spec =
      readOsim(runWhole().files.at("adjusted_model.osim"), "adjusted_model.osim");
  return spec;
}

/// The columns of the muscles, which come first.
RowMatrix muscleColumns(const TimeSeries& one) {
  return one.values.leftCols(static_cast<Eigen::Index>(model().muscles.size()));
}

double findLargest(const RowMatrix& values) {
  return values.cwiseAbs().maxCoeff();
}

TEST(SampleAnalysis, TablesOfMusclesShareRowsAndColumns) {
  const TimeSeries& forces = table("forces");
  for (const char* name : {"active_fiber_forces",
                           "passive_fiber_forces",
                           "norm_fiber_lengths",
                           "norm_fiber_velocities",
                           "pennation_angles",
                           "fiber_active_powers",
                           "fiber_passive_powers",
                           "tendon_powers",
                           "muscle_powers"}) {
    const TimeSeries& one = table(name);
    EXPECT_EQ(one.time, forces.time) << name;
    ASSERT_EQ(one.labels.size(), model().muscles.size()) << name;
    for (std::size_t m = 0; m < one.labels.size(); ++m) {
      EXPECT_EQ(one.labels[m], model().muscles[m].name) << name;
    }
    EXPECT_TRUE(one.values.allFinite()) << name;
    EXPECT_EQ(runWhole().cycle_tables.count(name), 1U) << name;
  }
  EXPECT_EQ(table("muscle_moments").time, forces.time);
  EXPECT_EQ(table("joint_reactions").time, forces.time);
}

// Muscles of up to 6 kN and 300 W; what is left is the tolerance of the fiber's equilibrium.
TEST(SampleAnalysis, FiberAndTendonPowerMakeEachMusclesPower) {
  const RowMatrix parts = table("fiber_active_powers").values +
                          table("fiber_passive_powers").values + table("tendon_powers").values;
  EXPECT_LT(findLargest(parts - table("muscle_powers").values), tol(1e-6));
  EXPECT_GT(findLargest(table("muscle_powers").values), 100);
}

TEST(SampleAnalysis, ActiveAndPassiveFiberForceMakeTheTendonsForce) {
  const RowMatrix parts =
      table("active_fiber_forces").values + table("passive_fiber_forces").values;
  EXPECT_LT(findLargest(parts - muscleColumns(table("forces"))), tol(1e-6));
}

TEST(SampleAnalysis, NormalisedFibersAreThoseInMetres) {
  for (std::size_t m = 0; m < model().muscles.size(); ++m) {
    const auto column = static_cast<Eigen::Index>(m);
    const double optimal = model().muscles[m].optimal_fiber_length;
    const Eigen::VectorXd length = optimal * table("norm_fiber_lengths").values.col(column) -
                                   table("fiber_lengths").values.col(column);
    EXPECT_LT(length.cwiseAbs().maxCoeff(), tol(1e-12)) << model().muscles[m].name;
    const Eigen::VectorXd speed = optimal * model().muscles[m].max_contraction_velocity *
                                      table("norm_fiber_velocities").values.col(column) -
                                  table("fiber_velocities").values.col(column);
    EXPECT_LT(speed.cwiseAbs().maxCoeff(), tol(1e-10)) << model().muscles[m].name;
  }
}

// The same moments as beside those of inverse dynamics, there between rows.
TEST(SampleAnalysis, MuscleMomentsAreThoseBesideInverseDynamics) {
  const TimeSeries& moments = table("moments");
  const TimeSeries& muscle = table("muscle_moments");
  for (const char* coordinate : {"hip_flexion_r", "knee_angle_l", "ankle_angle_r"}) {
    const std::string label = std::string(coordinate) + "_muscle_moment";
    const int theirs = moments.getColumn(label);
    const int ours = muscle.getColumn(label);
    for (int row = 0; row < moments.rowCount(); row += 10) {
      const double time = moments.time[static_cast<std::size_t>(row)];
      EXPECT_NEAR(moments.values(row, theirs), muscle.interpolate(time)[ours], tol(1e-9));
    }
  }
}

TEST(SampleAnalysis, WorkOfTheCycleAddsUp) {
  const TimeSeries& work = table("muscle_work");
  ASSERT_EQ(work.rowCount(), 1);
  const Json cycle = Json::parse(runWhole().summary_json).at("cycles").at("right").at(0);
  EXPECT_EQ(work.time[0], cycle.at(0).get<double>());
  double net = 0;
  for (const MuscleSpec& muscle : model().muscles) {
    const auto part = [&](const char* name) {
      return work.values(0, work.getColumn(muscle.name + name));
    };
    EXPECT_GE(part("_fiber_positive_work"), 0) << muscle.name;
    EXPECT_LE(part("_fiber_negative_work"), 0) << muscle.name;
    EXPECT_NEAR(part("_fiber_positive_work") + part("_fiber_negative_work") +
                    part("_tendon_positive_work") + part("_tendon_negative_work"),
                part("_net_work"),
                tol(1e-6))
        << muscle.name;
    net += part("_net_work");
  }
  const Json balance = Json::parse(runWhole().summary_json).at("work");
  EXPECT_NEAR(balance.at("muscles_j").get<double>(), net, tol(1e-9));
}

// An elastic tendon gives back over the cycle what it took up.
TEST(SampleAnalysis, TendonsReturnTheirWork) {
  const TimeSeries& work = table("muscle_work");
  const auto part = [&](const std::string& label) {
    return work.values(0, work.getColumn(label));
  };
  EXPECT_GT(part("soleus_r_tendon_positive_work"), 2);  // [J] the spring of push-off
  EXPECT_NEAR(part("soleus_r_tendon_positive_work"),
              -part("soleus_r_tendon_negative_work"),
              tol(0.05) * part("soleus_r_tendon_positive_work"));
}

// d(kinetic + potential energy) = muscles + actuators + residuals + ground over the cycle. The
// energy of a walker goes up and down by tens of joules; what is missing is the known error of
// Simbody's function-based mobilizer at moving knees (2 W at most, tests/core/analysis), which the
// simulation moves by.
TEST(SampleAnalysis, PowersCloseTheBalanceOverTheCycle) {
  const Json work = Json::parse(runWhole().summary_json).at("work");
  const auto read = [&](const char* name) {
    return work.at(name).get<double>();
  };
  const double given =
      read("muscles_j") + read("actuators_j") + read("residuals_j") + read("ground_reactions_j");
  EXPECT_NEAR(read("energy_change_j") - given, read("imbalance_j"), tol(1e-9));
  EXPECT_LT(std::abs(read("imbalance_j")), tol(0.35));  // measured: 0.31
  EXPECT_LT(std::abs(read("residuals_j")), 0.5);        // the trial is dynamically consistent
  const Json interval = work.at("interval_s");
  EXPECT_NEAR(interval.at(1).get<double>() - interval.at(0).get<double>(), 1.1448, tol(1e-3));
}

TEST(SampleAnalysis, JointPowerIsMomentTimesSpeed) {
  const TimeSeries& powers = table("joint_powers");
  EXPECT_EQ(powers.columnCount(), 29);
  EXPECT_FALSE(powers.findColumn("mtp_angle_r_power").has_value());  // locked
  const TimeSeries& cycle = runWhole().cycle_tables.at("joint_powers");
  // Ankles push off before the foot leaves the ground at 64 %, knees brake.
  const int ankle = powers.getColumn("ankle_angle_r_power");
  EXPECT_GT(cycle.values.col(ankle).segment(45, 20).maxCoeff(), 100);
}

TEST(SampleAnalysis, GroundReactionsAndMarkersAreThoseOfTheInput) {
  const TimeSeries& forces = table("ground_reactions");
  EXPECT_NEAR(forces.values.col(forces.getColumn("right_fy")).maxCoeff(), 770, 50);
  const TimeSeries& markers = table("measured_markers");
  EXPECT_EQ(markers.time, table("marker_errors").time);
  EXPECT_EQ(markers.columnCount(), 3 * table("marker_errors").columnCount());
  const auto heel = markers.values.col(markers.getColumn("RCAL_y"));
  EXPECT_LT(heel.minCoeff(), 0.1);  // [m] above the ground
  EXPECT_GT(heel.maxCoeff(), 0.2);
}

TEST(SampleAnalysis, SummaryTellsSubjectEventsAndCycles) {
  const Json summary = Json::parse(runWhole().summary_json);
  EXPECT_EQ(summary.at("subject"), (Json{{"mass_kg", 70.0}, {"height_m", 1.76}}));
  const Json& events = summary.at("events");
  ASSERT_EQ(events.size(), 6U);
  EXPECT_EQ(events[0].at("kind"), "foot_strike");
  EXPECT_EQ(events[0].at("foot"), "right");
  EXPECT_EQ(events[3].at("kind"), "toe_off");
  EXPECT_EQ(summary.at("cycles").at("right").size(), 1U);
  EXPECT_EQ(summary.at("cycles").at("left").size(), 0U);
  EXPECT_EQ(summary.at("cycles").at("right")[0], summary.at("gait_cycle_s"));
}

// With inextensible tendons all path motion is the fiber's, and all force is active by default.
TEST(SampleAnalysis, StaticOptimizationGivesTheSameTablesWithRigidTendons) {
  const std::map<std::string, TimeSeries>& tables = runToStaticOptimization().tables;
  const RowMatrix forces = muscleColumns(tables.at("forces"));
  EXPECT_EQ(findLargest(tables.at("active_fiber_forces").values - forces), 0);
  EXPECT_EQ(findLargest(tables.at("passive_fiber_forces").values), 0);
  EXPECT_LT(findLargest(tables.at("tendon_powers").values), tol(1e-9));
  EXPECT_LT(
      findLargest(tables.at("fiber_active_powers").values - tables.at("muscle_powers").values),
      tol(1e-9));
  for (const char* name : {"muscle_moments", "joint_reactions", "muscle_work", "joint_powers"}) {
    EXPECT_EQ(tables.count(name), 1U) << name;
  }
  // The moments that the muscles make, and reserves, are what inverse dynamics asks for.
  const TimeSeries& muscle = tables.at("muscle_moments");
  const TimeSeries& moments = tables.at("moments");
  const TimeSeries& reserves = tables.at("reserves");
  const int ankle = muscle.getColumn("ankle_angle_r_muscle_moment");
  for (int row = 5; row + 5 < muscle.rowCount(); row += 10) {
    const double time = muscle.time[static_cast<std::size_t>(row)];
    const double asked = moments.interpolate(time)[moments.getColumn("ankle_angle_r_moment")];
    const double given = muscle.values(row, ankle) +
                         reserves.values(row, reserves.getColumn("ankle_angle_r_reserve"));
    EXPECT_NEAR(given, asked, tol(0.5)) << time;  // rows of inverse dynamics are 1 ms apart
  }
}

}  // namespace
}  // namespace gaitmill
