#include "core/pipeline/understanding.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/trc_reader.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

MarkerTrajectories readSampleMarkers() {
  return readTrc(readFile("models/sample/markers.trc"), "markers.trc").markers;
}

void replaceAll(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
}

/// The sample's forces, or with columns that name plates 1 (right) and 2 (left) instead of feet.
enum class Columns { kFeet, kPlates };
TableFile readSampleForces(Columns columns) {
  std::string bytes = readFile("models/sample/grf.mot");
  if (columns == Columns::kPlates) {
    for (const std::string kind : {"force", "torque"}) {
      replaceAll(bytes, "ground_" + kind + "_r_", "ground_" + kind + "_1_");
      replaceAll(bytes, "ground_" + kind + "_l_", "ground_" + kind + "_2_");
    }
  }
  return readTable(bytes, "grf.mot");
}

TEST(MatchMarkers, PutsTheSetOfTheRecordingFirst) {
  const std::vector<MarkerMatch> matches =
      matchMarkers(readSampleMarkers().names, readShippedMarkerSets("models"));
  ASSERT_EQ(matches.size(), 3U);
  EXPECT_EQ(matches[0].marker_set, "rajagopal2016");
  EXPECT_TRUE(matches[0].missing.empty());
  EXPECT_GT(matches[0].found.size(), 30U);
  // The walking subject of the paper wore other markers, by other names.
  EXPECT_EQ(matches.back().marker_set, "paper_walk");
  EXPECT_FALSE(matches.back().missing.empty());
}

TEST(MatchMarkers, NamesWhatIsMissing) {
  std::vector<std::string> names = readSampleMarkers().names;
  names.erase(std::find(names.begin(), names.end(), "RASI"));
  const std::vector<MarkerMatch> matches = matchMarkers(names, readShippedMarkerSets("models"));
  EXPECT_EQ(matches[0].missing, std::vector<std::string>{"RASI"});
}

TEST(UnderstandForces, ColumnsNameTheFeet) {
  const ForceUnderstanding read = understandForces(readSampleForces(Columns::kFeet), {});
  ASSERT_GE(read.contacts.size(), 3U);
  for (const FootContact& contact : read.contacts) {
    EXPECT_EQ(contact.foot, contact.plate.back() == 'r' ? Foot::kRight : Foot::kLeft);
  }
  EXPECT_TRUE(read.warnings.empty());
  ASSERT_FALSE(read.events.empty());
}

TEST(UnderstandForces, MarkersTellTheFeetOfNumberedPlates) {
  const ForceUnderstanding named = understandForces(readSampleForces(Columns::kFeet), {});
  const ForceUnderstanding numbered =
      understandForces(readSampleForces(Columns::kPlates), readSampleMarkers());
  ASSERT_EQ(numbered.contacts.size(), named.contacts.size());
  for (std::size_t i = 0; i < named.contacts.size(); ++i) {
    EXPECT_EQ(numbered.contacts[i].foot, named.contacts[i].foot) << i;
    EXPECT_EQ(numbered.contacts[i].contact.strike, named.contacts[i].contact.strike) << i;
  }
  EXPECT_EQ(numbered.events.size(), named.events.size());
  EXPECT_TRUE(numbered.warnings.empty());
}

TEST(UnderstandForces, WithoutMarkersNumberedPlatesAreNobodys) {
  const ForceUnderstanding read = understandForces(readSampleForces(Columns::kPlates), {});
  EXPECT_FALSE(read.contacts.empty());
  EXPECT_TRUE(read.events.empty());
  EXPECT_EQ(read.warnings.size(), 2U);
}

TEST(UnderstandForces, SaysWhereForcesAndMarkersNeverMeet) {
  MarkerTrajectories late = readSampleMarkers();
  for (double& time : late.time) {
    time += 100;
  }
  EXPECT_EQ(understandForces(readSampleForces(Columns::kFeet), late).warnings.size(), 1U);
}

TEST(UnderstandForces, RefusesATableWithoutForces) {
  EXPECT_THROW(understandForces(readTable("a\nendheader\ntime\tb\n0\t1\n", "a.sto"), {}), Error);
}

}  // namespace
}  // namespace gaitmill
