#include "core/intake/marker_geometry.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "core/intake/landmarks.h"
#include "core/intake/marker_proposals.h"
#include "core/intake/rigid_markers.h"
#include "core/io/files.h"
#include "core/io/trc_reader.h"
#include "tests/support/shared_data.h"

namespace gaitmill {
namespace {

const char* const kSharedTrials[] = {"walk/motion_capture_walk.trc",
                                     "walk/static_walk_1.trc",
                                     "walk/static_walk_2.trc",
                                     "run/paper_subject01/static_run.trc",
                                     "run/paper_subject01/motion_capture_run.trc",
                                     "run/hamner2010/subject02_static.trc",
                                     "run/hamner2010/subject02_running.trc",
                                     "run/hamner2013_subject04/run400/markers.trc"};

MarkerTrajectories readMarkers(const std::string& path) {
  return readTrc(readFile(path), path, {}).markers;
}

/// The landmarks of a set of names, one standing person, a frame repeated.
MarkerTrajectories makeStanding(const std::vector<std::string>& names, int frames) {
  MarkerTrajectories markers;
  markers.names = names;
  markers.positions.resize(frames, 3 * static_cast<Eigen::Index>(names.size()));
  for (int frame = 0; frame < frames; ++frame) {
    markers.time.push_back(0.01 * frame);
    for (std::size_t i = 0; i < names.size(); ++i) {
      markers.positions.row(frame).segment<3>(3 * static_cast<Eigen::Index>(i)) =
          calcStandingPosition(*findLandmark(names[i])).transpose();
    }
  }
  return markers;
}

const std::vector<std::string>& ownNames() {
  static const std::vector<std::string> names = {
      "C7",   "CLAV", "RACR", "LACR",  "RASI",  "LASI",  "RPSI",      "LPSI",      "RLFC",
      "LLFC", "RMFC", "LMFC", "RLMAL", "LLMAL", "RMMAL", "LMMAL",     "RCAL",      "LCAL",
      "RTOE", "LTOE", "RMT5", "LMT5",  "RLEL",  "LLEL",  "RFAradius", "LFAradius", "TOPH"};
  return names;
}

/// Gives the columns of two markers each other's names.
void exchange(const std::string& a, const std::string& b, MarkerTrajectories& markers) {
  const auto first = std::find(markers.names.begin(), markers.names.end(), a);
  const auto second = std::find(markers.names.begin(), markers.names.end(), b);
  ASSERT_TRUE(first != markers.names.end() && second != markers.names.end());
  std::swap(*first, *second);
}

MarkerMapping checkNames(const MarkerTrajectories& markers) {
  MarkerMapping mapping = mapMarkerNames(markers.names);
  checkMarkerGeometry({&markers}, mapping);
  return mapping;
}

class SharedMarkerGeometry : public SharedDataTest {};

TEST_F(SharedMarkerGeometry, AgreesWithTheNamesOfEveryTrial) {
  for (const char* file : kSharedTrials) {
    const MarkerMapping mapping = checkNames(readMarkers(shared(std::string("data/") + file)));
    EXPECT_TRUE(mapping.warnings.empty()) << file << ": " << mapping.warnings.front();
    EXPECT_TRUE(mapping.listUnmapped().empty()) << file;
  }
}

// Two labels exchanged in each trial: what was wrong is out of use, all else is kept.
TEST_F(SharedMarkerGeometry, FindsOneExchangedPair) {
  const struct {
    const char* file;
    const char* right;
    const char* left;
  } cases[] = {
      {"walk/motion_capture_walk.trc", "R.Knee", "L.Knee"},
      {"walk/static_walk_1.trc", "R.ASIS", "L.ASIS"},
      {"run/paper_subject01/static_run.trc", "RLMAL", "LLMAL"},
      {"run/paper_subject01/motion_capture_run.trc", "RACR", "LACR"},
      {"run/hamner2010/subject02_static.trc", "R.Heel", "L.Heel"},
      {"run/hamner2010/subject02_running.trc", "R.ASIS", "L.ASIS"},
      {"run/hamner2013_subject04/run400/markers.trc", "RLEL", "LLEL"},
  };
  for (const auto& one : cases) {
    SCOPED_TRACE(one.file);
    MarkerTrajectories markers = readMarkers(shared(std::string("data/") + one.file));
    exchange(one.right, one.left, markers);
    const MarkerMapping mapping = checkNames(markers);
    EXPECT_EQ(mapping.warnings.size(), 1u);
    std::vector<std::string> unmapped = mapping.listUnmapped();
    std::sort(unmapped.begin(), unmapped.end());
    std::vector<std::string> expected = {one.right, one.left};
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(unmapped, expected);
  }
}

TEST_F(SharedMarkerGeometry, FindsAllSidesExchanged) {
  for (const char* file : kSharedTrials) {
    SCOPED_TRACE(file);
    MarkerTrajectories markers = readMarkers(shared(std::string("data/") + file));
    MarkerMapping mapping = mapMarkerNames(markers.names);
    for (MarkerName& name : mapping.names) {
      name.landmark = findOpposite(name.landmark)->name;
    }
    checkMarkerGeometry({&markers}, mapping);
    ASSERT_EQ(mapping.warnings.size(), 1u);
    EXPECT_NE(mapping.warnings[0].find("left and right are exchanged in all"), std::string::npos);
    EXPECT_FALSE(listMissingLandmarks(mapping).empty());
  }
}

TEST(MarkerGeometry, HeelAboveKneeIsNoticed) {
  MarkerTrajectories markers = makeStanding(ownNames(), 3);
  exchange("RCAL", "RLFC", markers);
  const MarkerMapping mapping = checkNames(markers);
  EXPECT_EQ(mapping.findMeasured("RCAL"), nullptr);
  EXPECT_EQ(mapping.findMeasured("RLFC"), nullptr);
  EXPECT_NE(mapping.findMeasured("RLMAL"), nullptr);
  EXPECT_EQ(mapping.find("RLFC")->proposal, "RLFC");
  EXPECT_LT(mapping.find("RLFC")->proposal_confidence, kUsableConfidence);
}

TEST(MarkerGeometry, ToeBehindHeelIsNoticed) {
  MarkerTrajectories markers = makeStanding(ownNames(), 3);
  exchange("LCAL", "LTOE", markers);
  const MarkerMapping mapping = checkNames(markers);
  EXPECT_FALSE(mapping.warnings.empty());
  EXPECT_EQ(mapping.findMeasured("LCAL"), nullptr);
  EXPECT_EQ(mapping.findMeasured("LTOE"), nullptr);
}

// What somebody stated is theirs to say; the warning stays.
TEST(MarkerGeometry, WhatIsStatedIsKept) {
  MarkerTrajectories markers = makeStanding(ownNames(), 3);
  exchange("RLFC", "LLFC", markers);
  MarkerMapping mapping = mapMarkerNames(markers.names, {{"RLFC", "RLFC"}, {"LLFC", "LLFC"}});
  checkMarkerGeometry({&markers}, mapping);
  EXPECT_EQ(mapping.warnings.size(), 1u);
  EXPECT_EQ(*mapping.findMeasured("RLFC"), "RLFC");
}

// Names that say nothing: a standing person is recognised, at a confidence that is never used.
TEST(MarkerProposals, UnknownNamesAreProposedFromWhereTheyAre) {
  MarkerTrajectories markers = makeStanding(ownNames(), 1);
  std::vector<std::string> truth = markers.names;
  for (std::size_t i = 0; i < markers.names.size(); ++i) {
    markers.names[i] = "M" + std::to_string(i + 1);
  }
  MarkerMapping mapping = mapMarkerNames(markers.names);
  proposeLandmarks({&markers}, mapping);
  int right = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_TRUE(mapping.names[i].landmark.empty());
    EXPECT_LE(mapping.names[i].proposal_confidence, 0.3);
    right += mapping.names[i].proposal == truth[i] ? 1 : 0;
  }
  EXPECT_GE(right, 20) << "of " << truth.size();
  EXPECT_EQ(listMissingLandmarks(mapping).size(), 8u);
}

TEST_F(SharedMarkerGeometry, ProposesLandmarksOfAnUnnamedStaticTrial) {
  MarkerTrajectories markers = readMarkers(shared("data/run/hamner2010/subject02_static.trc"));
  const MarkerMapping truth = mapMarkerNames(markers.names);
  for (std::size_t i = 0; i < markers.names.size(); ++i) {
    markers.names[i] = "M" + std::to_string(i + 1);
  }
  MarkerMapping mapping = mapMarkerNames(markers.names);
  proposeLandmarks({&markers}, mapping);
  int proposed = 0;
  int on_body = 0;
  for (std::size_t i = 0; i < markers.names.size(); ++i) {
    const Landmark* proposal = findLandmark(mapping.names[i].proposal);
    if (proposal != nullptr) {
      ++proposed;
      on_body += proposal->body == findLandmark(truth.names[i].landmark)->body ? 1 : 0;
    }
  }
  EXPECT_GE(proposed, 25);
  EXPECT_GE(on_body, proposed * 3 / 4);
}

// A marker that nobody knows, on a segment that moves: the running trial's third thigh marker.
TEST_F(SharedMarkerGeometry, UnknownMarkersFindTheirSegment) {
  const MarkerTrajectories pose = readMarkers(shared("data/run/paper_subject01/static_run.trc"));
  const MarkerTrajectories run =
      readMarkers(shared("data/run/paper_subject01/motion_capture_run.trc"));
  MarkerTrajectories renamed_pose = pose;
  MarkerTrajectories renamed_run = run;
  const auto rename = [](const char* from, const char* to, MarkerTrajectories& markers) {
    std::replace(markers.names.begin(), markers.names.end(), std::string(from), std::string(to));
  };
  for (MarkerTrajectories* markers : {&renamed_pose, &renamed_run}) {
    rename("LTB3", "extra shin", *markers);
    rename("RMT5", "shoe logo", *markers);
  }
  const MarkerMapping mapping = mapMarkerNames(renamed_pose.names);
  const std::vector<RigidMarker> found = findRigidMarkers({&renamed_pose, &renamed_run}, mapping);
  ASSERT_EQ(found.size(), 2u);
  const bool shin_first = found[0].measured == "extra shin";
  EXPECT_EQ(found[shin_first ? 0 : 1].body, "tibia_l");
  EXPECT_EQ(found[shin_first ? 1 : 0].body, "calcn_r");
  EXPECT_LT(found[0].deviation, kRigidDeviation);
}

}  // namespace
}  // namespace gaitmill
