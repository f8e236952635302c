#include "core/intake/marker_faults.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/io/c3d_reader.h"
#include "core/io/files.h"
#include "core/io/trc_reader.h"
#include "tests/support/shared_data.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

using Kind = MarkerFault::Kind;
using Action = MarkerFault::Action;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Two rigid segments of four and three markers that swing against each other while they travel,
/// and one marker of its own, 2 s at 100 Hz.
MarkerTrajectories makeMotion() {
  MarkerTrajectories markers;
  markers.names = {"T1", "T2", "T3", "T4", "S1", "S2", "S3", "ALONE"};
  markers.rate = 100;
  const std::vector<Eigen::Vector3d> thigh = {
      {0.05, -0.1, 0.06}, {-0.04, -0.18, 0.08}, {0.07, -0.3, 0.02}, {0.0, -0.4, 0.05}};
  const std::vector<Eigen::Vector3d> shank = {
      {0.05, -0.05, 0.04}, {-0.03, -0.2, 0.06}, {0.04, -0.35, -0.02}};
  markers.positions.resize(200, 24);
  for (int k = 0; k < 200; ++k) {
    const double t = 0.01 * k;
    markers.time.push_back(t);
    const Eigen::Vector3d hip(1.3 * t, 0.9 + 0.03 * std::sin(4 * kPi * t), 0.1);
    const Eigen::Matrix3d R_thigh =
        (Eigen::AngleAxisd(0.5 * std::sin(2 * kPi * t), Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(0.1 * std::cos(2 * kPi * t), Eigen::Vector3d::UnitY()))
            .toRotationMatrix();
    const Eigen::Matrix3d R_shank =
        R_thigh * Eigen::AngleAxisd(-0.5 + 0.5 * std::cos(2 * kPi * t), Eigen::Vector3d::UnitZ())
                      .toRotationMatrix();
    int column = 0;
    const auto add = [&](const Eigen::Vector3d& p) {
      markers.positions.row(k).segment<3>(column) = p.transpose();
      column += 3;
    };
    for (const Eigen::Vector3d& p : thigh) {
      add(hip + R_thigh * p);
    }
    const Eigen::Vector3d knee = hip + R_thigh * Eigen::Vector3d(0, -0.42, 0);
    for (const Eigen::Vector3d& p : shank) {
      add(knee + R_shank * p);
    }
    add(hip + Eigen::Vector3d(0.3 * std::sin(2 * kPi * t), 0.4, 0.3 + 0.1 * std::cos(3 * t)));
  }
  return markers;
}

void put(MarkerTrajectories& markers, int frame, int marker, const Eigen::Vector3d& p) {
  markers.positions.row(frame).segment<3>(3 * marker) = p.transpose();
}

void hide(MarkerTrajectories& markers, int marker, int first, int last) {
  for (int frame = first; frame <= last; ++frame) {
    put(markers, frame, marker, Eigen::Vector3d::Constant(kNaN));
  }
}

void swapNames(MarkerTrajectories& markers, int i, int j, int first, int last) {
  for (int frame = first; frame <= last; ++frame) {
    const Eigen::Vector3d p = markers.position(frame, i);
    put(markers, frame, i, markers.position(frame, j));
    put(markers, frame, j, p);
  }
}

/// Largest distance between two recordings over frames that both have [m].
double findDifference(const MarkerTrajectories& a, const MarkerTrajectories& b) {
  const RowMatrix off = a.positions - b.positions;
  double largest = 0;
  for (Eigen::Index i = 0; i < off.size(); ++i) {
    const double value = std::abs(off.data()[i]);
    largest = std::isfinite(value) ? std::max(largest, value) : largest;
  }
  return largest;
}

std::string describeAll(const MarkerRepair& repair) {
  std::string text;
  for (const MarkerFault& fault : repair.faults) {
    text += describeFault(fault) + "\n";
  }
  return text;
}

void expectFault(
    const MarkerFault& fault, Kind kind, const std::string& marker, int first, int last) {
  EXPECT_EQ(faultName(fault.kind), std::string(faultName(kind)));
  EXPECT_EQ(fault.marker, marker);
  EXPECT_EQ(fault.first_frame, first);
  EXPECT_EQ(fault.last_frame, last);
}

TEST(MarkerFaults, ACleanMotionHasNoneAndKeepsItsBits) {
  const MarkerTrajectories original = makeMotion();
  MarkerTrajectories markers = original;
  const MarkerRepair repair = repairMarkers({}, markers);
  EXPECT_EQ(describeAll(repair), "");
  EXPECT_TRUE(markers.positions == original.positions);
  EXPECT_EQ(repair.weights, std::vector<double>(8, 1.0));
}

TEST(MarkerFaults, AGapInAClusterIsFilledByItsRigidMotion) {
  const MarkerTrajectories original = makeMotion();
  MarkerTrajectories markers = original;
  hide(markers, 1, 60, 69);  // 0.1 s
  const MarkerRepair repair = repairMarkers({}, markers);
  ASSERT_EQ(repair.faults.size(), 1u) << describeAll(repair);
  expectFault(repair.faults[0], Kind::kGap, "T2", 60, 69);
  EXPECT_EQ(repair.faults[0].action, Action::kFilled);
  EXPECT_NEAR(repair.faults[0].start, 0.60, tol(1e-12));
  EXPECT_NEAR(repair.faults[0].end, 0.69, tol(1e-12));
  // Exact up to round-off: the cluster is rigid.
  EXPECT_LT(findDifference(markers, original), tol(1e-9));
  EXPECT_TRUE(markers.positions.allFinite());
}

TEST(MarkerFaults, AGapOfAMarkerAloneIsFilledBySpline) {
  const MarkerTrajectories original = makeMotion();
  MarkerTrajectories markers = original;
  hide(markers, 7, 50, 54);
  const MarkerRepair repair = repairMarkers({}, markers);
  ASSERT_EQ(repair.faults.size(), 1u) << describeAll(repair);
  EXPECT_TRUE(markers.positions.allFinite());
  // Cubic over h = 60 ms of x = 0.3 sin(2 pi t): 5/384 h^4 0.3 (2 pi)^4 = 0.08 mm.
  EXPECT_LT(findDifference(markers, original), tol(2e-4));
}

TEST(MarkerFaults, LongGapsEndsAndForbiddenFillingStay) {
  MarkerTrajectories markers = makeMotion();
  hide(markers, 0, 40, 50);    // 0.11 s
  hide(markers, 4, 0, 2);      // at the start
  hide(markers, 7, 197, 199);  // at the end
  const MarkerRepair repair = repairMarkers({}, markers);
  ASSERT_EQ(repair.faults.size(), 3u) << describeAll(repair);
  for (const MarkerFault& fault : repair.faults) {
    EXPECT_EQ(fault.action, Action::kReported);
  }
  EXPECT_TRUE(markers.isMissing(45, 0));
  MarkerTrajectories never = makeMotion();
  hide(never, 1, 60, 60);
  MarkerFaultOptions options;
  options.max_gap = 0;
  EXPECT_EQ(repairMarkers(options, never).faults[0].action, Action::kReported);
  EXPECT_TRUE(never.isMissing(60, 1));
}

TEST(MarkerFaults, SwappedLabelsAreExchangedBack) {
  const MarkerTrajectories original = makeMotion();
  const std::vector<std::pair<int, int>> pairs = {{0, 4}, {0, 3}, {4, 6}, {2, 7}};
  for (const auto& [i, j] : pairs) {
    MarkerTrajectories markers = original;
    swapNames(markers, i, j, 80, 110);
    const MarkerRepair repair = repairMarkers({}, markers);
    ASSERT_EQ(repair.faults.size(), 1u) << describeAll(repair);
    expectFault(
        repair.faults[0], Kind::kSwap, original.names[static_cast<std::size_t>(i)], 80, 110);
    EXPECT_EQ(repair.faults[0].other, original.names[static_cast<std::size_t>(j)]);
    EXPECT_EQ(repair.faults[0].action, Action::kCorrected);
    EXPECT_TRUE(markers.positions == original.positions);
  }
}

TEST(MarkerFaults, ASwapUntilTheEndIsTheMinorPart) {
  const MarkerTrajectories original = makeMotion();
  for (const std::pair<int, int>& part : {std::pair(150, 199), std::pair(0, 49)}) {
    MarkerTrajectories markers = original;
    swapNames(markers, 1, 5, part.first, part.second);
    const MarkerRepair repair = repairMarkers({}, markers);
    ASSERT_EQ(repair.faults.size(), 1u) << describeAll(repair);
    expectFault(repair.faults[0], Kind::kSwap, "T2", part.first, part.second);
    EXPECT_TRUE(markers.positions == original.positions);
  }
}

// Two lone markers that change names half way: nothing says which half is right.
TEST(MarkerFaults, AnAmbiguousSwapIsReportedAndWeighsLess) {
  MarkerTrajectories markers;
  markers.names = {"A", "B"};
  markers.rate = 100;
  markers.positions.resize(100, 6);
  for (int k = 0; k < 100; ++k) {
    const double t = 0.01 * k;
    markers.time.push_back(t);
    markers.positions.row(k) << t, 1, std::sin(7 * t), t, 1.3 + 0.1 * std::cos(5 * t), 0;
  }
  swapNames(markers, 0, 1, 50, 99);
  const MarkerTrajectories original = markers;
  const MarkerRepair repair = repairMarkers({}, markers);
  ASSERT_EQ(repair.faults.size(), 1u) << describeAll(repair);
  expectFault(repair.faults[0], Kind::kSwap, "A", 50, 99);
  EXPECT_EQ(repair.faults[0].action, Action::kWeighed);
  EXPECT_TRUE(markers.positions == original.positions);
  EXPECT_LT(repair.weights[0], 0.01);
  EXPECT_LT(repair.weights[1], 0.01);
}

TEST(MarkerFaults, SpikesAreRemovedAndFilled) {
  const MarkerTrajectories original = makeMotion();
  for (const int marker : {1, 7}) {
    for (const int count : {1, 3}) {
      MarkerTrajectories markers = original;
      for (int frame = 70; frame < 70 + count; ++frame) {
        put(markers, frame, marker, original.position(frame, marker) + Eigen::Vector3d(0, 0.08, 0));
      }
      const MarkerRepair repair = repairMarkers({}, markers);
      ASSERT_EQ(repair.faults.size(), 1u) << describeAll(repair);
      expectFault(repair.faults[0],
                  Kind::kSpike,
                  original.names[static_cast<std::size_t>(marker)],
                  70,
                  69 + count);
      EXPECT_EQ(repair.faults[0].action, Action::kFilled);
      EXPECT_NEAR(repair.faults[0].size, 0.08, tol(2e-3));
      EXPECT_LT(findDifference(markers, original), tol(2e-4));
    }
  }
}

TEST(MarkerFaults, ADriftLowersTheWeightOfItsMarkerOnly) {
  MarkerTrajectories markers = makeMotion();
  for (int frame = 0; frame < 200; ++frame) {
    // Along the segment, away from its other markers.
    const Eigen::Vector3d away =
        (markers.position(frame, 3) - markers.position(frame, 0)).normalized();
    put(markers, frame, 3, markers.position(frame, 3) + 0.03 * frame / 199.0 * away);
  }
  const MarkerRepair repair = repairMarkers({}, markers);
  ASSERT_EQ(repair.faults.size(), 1u) << describeAll(repair);
  expectFault(repair.faults[0], Kind::kDrift, "T4", 0, 199);
  EXPECT_NEAR(repair.faults[0].size, 0.03, tol(1e-3));
  // 10^2 / (10^2 + 30^2 / 3)
  EXPECT_NEAR(repair.weights[3], 0.25, tol(0.01));
  for (const std::size_t other : {0u, 1u, 2u, 4u, 5u, 6u, 7u}) {
    EXPECT_EQ(repair.weights[other], 1.0);
  }
}

TEST(MarkerFaults, RecordingsOfNothingAreHarmless) {
  MarkerTrajectories none;
  EXPECT_TRUE(repairMarkers({}, none).faults.empty());
  MarkerTrajectories hidden = makeMotion();
  hide(hidden, 2, 0, 199);
  const MarkerRepair repair = repairMarkers({}, hidden);
  ASSERT_EQ(repair.faults.size(), 1u) << describeAll(repair);
  expectFault(repair.faults[0], Kind::kGap, "T3", 0, 199);
}

class MarkerFaultsShared : public SharedDataTest {
 protected:
  MarkerTrajectories read(const std::string& name) const {
    const std::string bytes = readFile(shared("data/" + name));
    return isC3d(bytes) ? readC3d(bytes, name).markers : readTrc(bytes, name).markers;
  }
};

const std::vector<std::string> kCleanTrials = {"walk/motion_capture_walk.trc",
                                               "walk/static_walk_1.trc",
                                               "walk/static_walk_2.trc",
                                               "run/paper_subject01/motion_capture_run.trc",
                                               "run/paper_subject01/static_run.trc",
                                               "run/hamner2010/subject02_running.trc",
                                               "run/hamner2010/subject02_static.trc",
                                               "run/hamner2013_subject04/run400/markers.trc",
                                               "c3d/walking2.c3d",
                                               "c3d/JA1Gait35.c3d",
                                               "c3d/cmu_dribble_shoot_basketball.c3d",
                                               "c3d/c3d_org_sample01/Eb015pr.c3d"};

TEST_F(MarkerFaultsShared, CleanTrialsHaveNoSwaps) {
  for (const std::string& name : kCleanTrials) {
    SCOPED_TRACE(name);
    MarkerTrajectories markers = read(name);
    const MarkerRepair repair = repairMarkers({}, markers);
    for (const MarkerFault& fault : repair.faults) {
      EXPECT_NE(fault.kind, Kind::kSwap) << describeFault(fault);
    }
  }
}

// One fault at a time in the walking and in the running trial: exactly that one is found.
TEST_F(MarkerFaultsShared, InjectedFaultsAreFoundAlone) {
  struct Case {
    std::string trial;
    std::string marker;
    std::string other;  // of a swap
  };
  const std::vector<Case> cases = {{"walk/motion_capture_walk.trc", "R.TH1", "R.SH1"},
                                   {"walk/motion_capture_walk.trc", "L.Toe", "R.Toe"},
                                   {"run/paper_subject01/motion_capture_run.trc", "RTH1", "RTH2"},
                                   {"run/hamner2013_subject04/run400/markers.trc", "RCAL", "LCAL"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.trial + " " + c.marker);
    const MarkerTrajectories original = read(c.trial);
    const auto i = original.findMarker(c.marker);
    const auto j = original.findMarker(c.other);
    ASSERT_TRUE(i && j);
    MarkerTrajectories gap = original;
    hide(gap, *i, 100, 107);
    MarkerRepair repair = repairMarkers({}, gap);
    ASSERT_EQ(repair.faults.size(), 1u) << describeAll(repair);
    expectFault(repair.faults[0], Kind::kGap, c.marker, 100, 107);
    EXPECT_LT(findDifference(gap, original), tol(0.010));

    MarkerTrajectories swap = original;
    swapNames(swap, *i, *j, 90, 120);
    repair = repairMarkers({}, swap);
    ASSERT_EQ(repair.faults.size(), 1u) << describeAll(repair);
    EXPECT_EQ(repair.faults[0].kind, Kind::kSwap);
    EXPECT_EQ(repair.faults[0].first_frame, 90);
    EXPECT_EQ(repair.faults[0].last_frame, 120);
    EXPECT_TRUE(swap.positions == original.positions);

    MarkerTrajectories spike = original;
    for (int frame = 100; frame < 102; ++frame) {
      put(spike, frame, *i, original.position(frame, *i) + Eigen::Vector3d(0.05, 0.05, -0.1));
    }
    repair = repairMarkers({}, spike);
    ASSERT_EQ(repair.faults.size(), 1u) << describeAll(repair);
    expectFault(repair.faults[0], Kind::kSpike, c.marker, 100, 101);
    EXPECT_LT(findDifference(spike, original), tol(0.010));
  }
}

TEST_F(MarkerFaultsShared, AnInjectedDriftIsFoundAlone) {
  MarkerTrajectories markers = read("run/paper_subject01/motion_capture_run.trc");
  const int marker = *markers.findMarker("RTH2");
  const int along = *markers.findMarker("RTH1");
  for (int frame = 0; frame < markers.frameCount(); ++frame) {
    const Eigen::Vector3d away =
        (markers.position(frame, marker) - markers.position(frame, along)).normalized();
    put(markers,
        frame,
        marker,
        markers.position(frame, marker) + 0.04 * frame / markers.frameCount() * away);
  }
  const MarkerRepair repair = repairMarkers({}, markers);
  ASSERT_EQ(repair.faults.size(), 1u) << describeAll(repair);
  EXPECT_EQ(repair.faults[0].kind, Kind::kDrift);
  EXPECT_EQ(repair.faults[0].marker, "RTH2");
  EXPECT_NEAR(repair.faults[0].size, 0.04, tol(0.01));
}

}  // namespace
}  // namespace gaitmill
