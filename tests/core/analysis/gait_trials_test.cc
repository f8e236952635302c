// Contacts, events, cycles and windows of the four recordings of ../shared.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/analysis/gait.h"
#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/grf_reader.h"
#include "core/io/table_reader.h"
#include "core/io/trc_reader.h"
#include "tests/support/shared_data.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

struct Recording {
  MarkerTrajectories markers;
  GaitMarkers chosen;
  GroundReaction reaction;
  std::vector<Foot> feet;  ///< that the columns name

  std::vector<Foot> unnamed() const { return std::vector<Foot>(feet.size(), Foot::kUnknown); }
  Gait describe(const GaitStatements& statements = {}) const {
    return describeGait(reaction, feet, markers, chosen, statements);
  }
};

enum class Trial { kWalk, kPaperRun, kHamner2010, kSubject04 };
constexpr Trial kTrials[] = {Trial::kWalk, Trial::kPaperRun, Trial::kHamner2010, Trial::kSubject04};

class GaitTrials : public SharedDataTest {
 protected:
  Recording open(Trial trial) const {
    switch (trial) {
      case Trial::kWalk:
        return read("walk/motion_capture_walk.trc", "walk/grf_walk.mot");
      case Trial::kPaperRun:
        return read("run/paper_subject01/motion_capture_run.trc",
                    "run/paper_subject01/grf_run.mot");
      case Trial::kHamner2010:
        return read("run/hamner2010/subject02_running.trc",
                    "run/hamner2010/subject02_running_grf.mot");
      case Trial::kSubject04:
        break;
    }
    return read("run/hamner2013_subject04/run400/markers.trc",
                "run/hamner2013_subject04/run400/grf.mot");
  }

 private:
  Recording read(const std::string& markers, const std::string& forces) const {
    Recording recording;
    recording.markers = readTrc(readFile(shared("data/" + markers)), markers).markers;
    recording.chosen = findGaitMarkers(recording.markers.names);
    const TableFile table = readTable(readFile(shared("data/" + forces)), forces);
    GrfOptions options;
    for (const std::string& family : findForceFamilies(table.table.labels)) {
      options.plates.push_back({family, "body of " + family});
    }
    recording.feet = findFamilyFeet(table.table.labels);
    recording.reaction = readGroundReaction(table, options);
    return recording;
  }
};

struct Expected {
  Foot foot;
  double start;
  double end;
};

void expectContacts(const std::vector<FootContact>& found, const std::vector<Expected>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].foot, expected[i].foot) << i;
    EXPECT_EQ(found[i].seen, expected[i].foot) << i;
    EXPECT_GT(found[i].confidence, 0.99) << i;
    // The published times are printed to a millisecond and step with the samples.
    EXPECT_NEAR(found[i].contact.strike, expected[i].start, tol(1.5e-3)) << i;
    EXPECT_NEAR(found[i].contact.toe_off, expected[i].end, tol(1.5e-3)) << i;
    EXPECT_FALSE(found[i].is_shared || found[i].is_partial || found[i].is_outside_sole) << i;
  }
}

// ../shared/data/README.md section 5: right = plates 1 and 3, left = plate 2.
TEST_F(GaitTrials, NumberedPlatesOfTheWalkFindTheirFeet) {
  Recording walk = open(Trial::kWalk);
  // The right column holds two plates: the second step goes to a third one.
  walk.reaction.forces.push_back(walk.reaction.forces[0]);
  for (std::size_t row = 0; row < walk.reaction.time.size(); ++row) {
    const auto i = static_cast<Eigen::Index>(row);
    walk.reaction.forces[walk.reaction.time[row] < 1.2 ? 2 : 0].force.col(i).setZero();
  }
  const char* names[] = {"plate_1", "plate_2", "plate_3"};
  for (std::size_t i = 0; i < 3; ++i) {
    walk.reaction.forces[i].name = names[i];
  }
  walk.feet.assign(3, Foot::kUnknown);
  const Gait gait = walk.describe();
  expectContacts(
      gait.contacts,
      {{Foot::kRight, 0.268, 1.024}, {Foot::kLeft, 0.837, 1.589}, {Foot::kRight, 1.412, 2.167}});
  const GroundReaction assigned =
      assignForces(walk.reaction, walk.feet, gait.contacts, "calcn_r", "calcn_l");
  ASSERT_EQ(assigned.forces.size(), 3U);
  EXPECT_EQ(assigned.forces[0].body, "calcn_r");
  EXPECT_EQ(assigned.forces[1].body, "calcn_l");
  EXPECT_EQ(assigned.forces[2].body, "calcn_r");
  EXPECT_EQ(assigned.forces[1].force, walk.reaction.forces[1].force);
}

TEST_F(GaitTrials, NumberedPlatesOfTheRunsFindTheirFeet) {
  for (const Trial trial : {Trial::kPaperRun, Trial::kHamner2010, Trial::kSubject04}) {
    Recording run = open(trial);
    const std::vector<FootContact> named = run.describe().contacts;
    run.feet = run.unnamed();
    const std::vector<FootContact> found = run.describe().contacts;
    ASSERT_EQ(found.size(), named.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].foot, named[i].foot);
      EXPECT_EQ(named[i].seen, named[i].foot);
      EXPECT_GT(found[i].confidence, 0.99);
      EXPECT_EQ(found[i].contact.strike, named[i].contact.strike);
    }
  }
}

TEST_F(GaitTrials, ContactsOfSubject04) {
  Recording run = open(Trial::kSubject04);
  run.feet = run.unnamed();
  expectContacts(run.describe().contacts,
                 {{Foot::kRight, 0.651, 0.912},
                  {Foot::kLeft, 1.014, 1.264},
                  {Foot::kRight, 1.343, 1.614},
                  {Foot::kLeft, 1.696, 1.958},
                  {Foot::kRight, 2.049, 2.304},
                  {Foot::kLeft, 2.389, 2.655}});
}

TEST_F(GaitTrials, Hamner2010HasFourteenRightStrides) {
  const Gait gait = open(Trial::kHamner2010).describe();
  EXPECT_EQ(std::count_if(gait.contacts.begin(),
                          gait.contacts.end(),
                          [](const FootContact& c) { return c.foot == Foot::kRight; }),
            14);
  EXPECT_TRUE(gait.warnings.empty()) << gait.warnings.front();
}

TEST_F(GaitTrials, WalkingAndRunningAreToldWithAndWithoutForces) {
  for (const Trial trial : kTrials) {
    const Recording recording = open(trial);
    const GaitKind expected = trial == Trial::kWalk ? GaitKind::kWalking : GaitKind::kRunning;
    EXPECT_EQ(recording.describe().kind, expected);
    const Gait by_markers = describeGait({}, {}, recording.markers, recording.chosen);
    EXPECT_EQ(by_markers.kind, expected);
    EXPECT_FALSE(by_markers.window.has_value());
    EXPECT_FALSE(by_markers.cycles.empty());
  }
}

// Markers alone find every strike and toe-off that the forces have, and no other inside. Strikes
// come 0 to 35 ms early, toe-offs lie within 17 ms, which is one frame of the 60 Hz recording.
TEST_F(GaitTrials, EventsByMarkersAgreeWithForces) {
  for (const Trial trial : kTrials) {
    const Gait gait = open(trial).describe();
    int by_forces = 0;
    for (const GaitEvent& event : gait.events) {
      by_forces += event.source == GaitEvent::Source::kForces ? 1 : 0;
    }
    // An event on the first or last few frames has no markers around it.
    EXPECT_GE(gait.strikes.count + gait.toe_offs.count, by_forces - 2);
    EXPECT_LT(gait.strikes.largest_difference, tol(0.036));
    EXPECT_LT(gait.strikes.mean_difference, 0);
    EXPECT_LT(gait.toe_offs.largest_difference, tol(0.0175));
    RecordProperty("strikes_mean_ms_" + std::to_string(static_cast<int>(trial)),
                   std::to_string(1000 * gait.strikes.mean_difference));
  }
}

// Forces of the walk miss the left foot before 0.45 s and behind 1.96 s: no right cycle is complete
// from strike to strike, but a cycle's length is, as the published simulation used it.
TEST_F(GaitTrials, TheWalkIsRealigned) {
  const Gait gait = open(Trial::kWalk).describe();
  ASSERT_TRUE(gait.window && gait.window->cycle);
  EXPECT_TRUE(gait.window->is_realigned);
  EXPECT_EQ(gait.window->cycle->foot, Foot::kRight);
  EXPECT_NEAR(gait.window->cycle->cycle.start, 0.268, tol(1.5e-3));
  EXPECT_NEAR(gait.window->cycle->cycle.end, 1.412, tol(1.5e-3));
  // The left toe-off of the cycle before, 1.589 s - 1.1445 s = 0.445 s, and its next strike.
  EXPECT_GT(gait.window->range.start, 0.445);
  EXPECT_LT(gait.window->range.end, 1.96);
  EXPECT_NEAR(
      gait.window->range.end - gait.window->range.start, 1.144 + kLeadIn + kLeadOut, tol(2e-3));
}

// 10 s on the treadmill are one stride by default, not fourteen.
TEST_F(GaitTrials, RunsAreSimulatedOverOneRightCycle) {
  for (const Trial trial : {Trial::kPaperRun, Trial::kHamner2010, Trial::kSubject04}) {
    const Gait gait = open(trial).describe();
    ASSERT_TRUE(gait.window && gait.window->cycle);
    EXPECT_FALSE(gait.window->is_realigned);
    EXPECT_TRUE(gait.window->cycle->has_complete_forces);
    EXPECT_EQ(gait.window->cycle->foot, Foot::kRight);
    const GaitCycle& cycle = gait.window->cycle->cycle;
    EXPECT_NEAR(cycle.end - cycle.start, 0.7, tol(0.02));
    EXPECT_NEAR(gait.window->range.start, cycle.start - kLeadIn, tol(1e-9));
    EXPECT_NEAR(gait.window->range.end, cycle.end + kLeadOut, tol(1e-9));
    ASSERT_EQ(gait.coverage.complete.size(), 1U);
    EXPECT_TRUE(gait.coverage.missing.empty());
  }
}

TEST_F(GaitTrials, ACycleIsChosenByItsNumber) {
  const Recording run = open(Trial::kHamner2010);
  GaitStatements statements;
  statements.cycle = CycleChoice{Foot::kLeft, 3};
  const Gait gait = run.describe(statements);
  ASSERT_TRUE(gait.window && gait.window->cycle);
  EXPECT_EQ(gait.window->cycle->number, 3);
  EXPECT_EQ(gait.window->cycle->foot, Foot::kLeft);
  statements.cycle->number = 40;
  try {
    run.describe(statements);
    FAIL() << "there are no 40 cycles";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kSettingsValue);
    EXPECT_EQ(error.where().field, "trial.cycle");
  }
}

/// Both feet on one plate: wrenches add, and the centre of pressure is that of the sum.
GroundReaction sumForces(const GroundReaction& reaction) {
  GroundReaction sum;
  sum.time = reaction.time;
  ExternalForce force = reaction.forces[0];
  force.name = "plate";
  const ExternalForce& other = reaction.forces[1];
  for (Eigen::Index i = 0; i < force.force.cols(); ++i) {
    Eigen::Vector3d F = force.force.col(i);
    const Eigen::Vector3d p = force.point.col(i);
    const Eigen::Vector3d F_other = other.force.col(i);
    const Eigen::Vector3d p_other = other.point.col(i);
    const Eigen::Vector3d M =
        p.cross(F) + force.torque.col(i) + p_other.cross(F_other) + other.torque.col(i);
    F += F_other;
    force.force.col(i) = F;
    if (F.y() > 0) {
      const Eigen::Vector3d center(M.z() / F.y(), 0, -M.x() / F.y());
      force.point.col(i) = center;
      force.torque.col(i) = Eigen::Vector3d(0, (M - center.cross(F)).y(), 0);
    }
  }
  sum.forces = {force};
  return sum;
}

// Double supports of the walk are shared, single supports are told apart.
TEST_F(GaitTrials, TwoFeetOnOnePlateAreMarkedAsShared) {
  Recording walk = open(Trial::kWalk);
  walk.reaction = sumForces(walk.reaction);
  walk.feet = {Foot::kUnknown};
  const Gait gait = walk.describe();
  ASSERT_EQ(gait.contacts.size(), 5U);
  const Foot feet[] = {Foot::kRight, Foot::kUnknown, Foot::kLeft, Foot::kUnknown, Foot::kRight};
  const double starts[] = {0.268, 0.837, 1.024, 1.412, 1.589};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(gait.contacts[i].foot, feet[i]);
    EXPECT_EQ(gait.contacts[i].is_shared, i % 2 == 1);
    EXPECT_NEAR(gait.contacts[i].contact.strike, starts[i], tol(0.025));
  }
  for (const TimeRange& range : gait.coverage.complete) {
    EXPECT_TRUE(range.end < 0.837 || range.start > 1.024);
    EXPECT_TRUE(range.end < 1.412 || range.start > 1.589);
  }
  ASSERT_TRUE(gait.window);
  EXPECT_FALSE(gait.window->cycle.has_value());
  EXPECT_NE(gait.window->warning.find("no gait cycle"), std::string::npos);
}

// A runner is never on the ground with both feet: one belt is as good as two.
TEST_F(GaitTrials, OneBeltOfARunServesBothFeetInTurn) {
  const Recording two = open(Trial::kPaperRun);
  Recording one = two;
  one.reaction = sumForces(two.reaction);
  one.feet = {Foot::kUnknown};
  const Gait gait = one.describe();
  EXPECT_EQ(gait.contacts.size(), two.describe().contacts.size());
  const GroundReaction assigned =
      assignForces(one.reaction, one.feet, gait.contacts, "calcn_r", "calcn_l");
  ASSERT_EQ(assigned.forces.size(), 2U);
  // Apart from the short blips below the contact rules, each foot gets its own force back.
  for (std::size_t foot = 0; foot < 2; ++foot) {
    EXPECT_EQ(assigned.forces[foot].body, foot == 0 ? "calcn_r" : "calcn_l");
    const Eigen::Matrix3Xd difference =
        assigned.forces[foot].force - two.reaction.forces[foot].force;
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), tol(1e-9));
  }
}

TEST_F(GaitTrials, AMissingPlateIsFound) {
  Recording walk = open(Trial::kWalk);
  walk.reaction.forces.resize(1);
  walk.feet = {Foot::kUnknown};
  const Gait gait = walk.describe();
  const auto missing = std::find_if(
      gait.coverage.missing.begin(), gait.coverage.missing.end(), [](const MissingForce& one) {
        return one.range.start > 0.7 && one.range.start < 0.9;
      });
  ASSERT_NE(missing, gait.coverage.missing.end());
  EXPECT_EQ(missing->foot, Foot::kLeft);
  EXPECT_NEAR(missing->range.start, 0.837, tol(0.035));
  EXPECT_NEAR(missing->range.end, 1.589, tol(0.02));
  for (const TimeRange& range : gait.coverage.complete) {
    EXPECT_TRUE(range.end < 0.837 || range.start > 1.589);
  }
}

// The plate ends under the foot: the last third of the stance is not measured.
TEST_F(GaitTrials, AFootPartlyBesideThePlateIsFound) {
  Recording walk = open(Trial::kWalk);
  for (std::size_t row = 0; row < walk.reaction.time.size(); ++row) {
    if (walk.reaction.time[row] > 1.35 && walk.reaction.time[row] < 1.7) {
      walk.reaction.forces[1].force.col(static_cast<Eigen::Index>(row)).setZero();
    }
  }
  const Gait gait = walk.describe();
  ASSERT_EQ(gait.contacts.size(), 3U);
  EXPECT_TRUE(gait.contacts[1].is_partial);
  for (const TimeRange& range : gait.coverage.complete) {
    EXPECT_TRUE(range.end < 0.837 || range.start > 1.589);
  }
}

TEST_F(GaitTrials, WrongFootIsSaidWithTheEvidence) {
  for (const Trial trial : kTrials) {
    Recording recording = open(trial);
    const Gait right = recording.describe();
    std::swap(recording.feet[0], recording.feet[1]);
    const Gait wrong = recording.describe();
    const auto said = [](const Gait& gait) {
      return std::count_if(gait.warnings.begin(), gait.warnings.end(), [](const std::string& text) {
        return text.find("wrong foot") != std::string::npos &&
               text.find("centre of pressure") != std::string::npos;
      });
    };
    EXPECT_EQ(said(right), 0);
    EXPECT_EQ(said(wrong), 2);  // one sentence per plate
    for (const FootContact& contact : wrong.contacts) {
      EXPECT_TRUE(contact.isContradicted());
      EXPECT_LT(contact.confidence, 0.01);
    }
  }
}

TEST_F(GaitTrials, AStatementWinsOverTheEvidence) {
  Recording walk = open(Trial::kWalk);
  walk.feet = walk.unnamed();
  GaitStatements statements;
  statements.contacts = {{walk.reaction.forces[1].name, 1.2, Foot::kRight},
                         {walk.reaction.forces[0].name, 2.0, Foot::kUnknown}};
  const Gait gait = walk.describe(statements);
  ASSERT_EQ(gait.contacts.size(), 3U);
  EXPECT_EQ(gait.contacts[1].foot, Foot::kRight);
  EXPECT_TRUE(gait.contacts[1].is_stated);
  EXPECT_TRUE(gait.contacts[2].is_foreign);
  const GroundReaction assigned =
      assignForces(walk.reaction, walk.feet, gait.contacts, "calcn_r", "calcn_l");
  ASSERT_EQ(assigned.forces.size(), 2U);
  EXPECT_EQ(assigned.forces[1].body, "calcn_r");
  // What nobody stands on pushes nobody.
  const Eigen::Index behind = 4000;  // 2.0 s
  EXPECT_EQ(assigned.forces[0].force.col(behind), Eigen::Vector3d(0, 0, 0));
  EXPECT_GT(walk.reaction.forces[0].force(1, behind), 100);
}

// The settings of jobs whose columns name the feet must not move a bit.
TEST_F(GaitTrials, ForcesThatNameTheirFootStayAsTheyAre) {
  for (const Trial trial : kTrials) {
    const Recording recording = open(trial);
    const Gait gait = recording.describe();
    const GroundReaction assigned =
        assignForces(recording.reaction, recording.feet, gait.contacts, "calcn_r", "calcn_l");
    ASSERT_EQ(assigned.forces.size(), recording.reaction.forces.size());
    for (std::size_t i = 0; i < assigned.forces.size(); ++i) {
      EXPECT_EQ(assigned.forces[i].body, recording.reaction.forces[i].body);
      EXPECT_EQ(assigned.forces[i].force, recording.reaction.forces[i].force);
      EXPECT_EQ(assigned.forces[i].torque, recording.reaction.forces[i].torque);
    }
  }
}

}  // namespace
}  // namespace gaitmill
