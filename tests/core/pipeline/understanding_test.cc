#include "core/pipeline/understanding.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/grf_reader.h"
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

ForceReading readColumns(const TableFile& table) {
  return {readForceColumns(table), findFamilyFeet(table.table.labels), table};
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

struct Understood {
  Gait gait;
  std::vector<std::string> warnings;
};

Understood understand(Columns columns, const MarkerTrajectories& markers) {
  Understood understood;
  understood.gait =
      understandForces(readColumns(readSampleForces(columns)), markers, understood.warnings);
  return understood;
}

TEST(UnderstandForces, ColumnsNameTheFeet) {
  const Understood read = understand(Columns::kFeet, {});
  ASSERT_GE(read.gait.contacts.size(), 3U);
  for (const FootContact& contact : read.gait.contacts) {
    EXPECT_EQ(contact.foot, contact.plate.back() == 'r' ? Foot::kRight : Foot::kLeft);
  }
  EXPECT_TRUE(read.warnings.empty());
  ASSERT_FALSE(read.gait.events.empty());
}

TEST(UnderstandForces, MarkersTellTheFeetOfNumberedPlates) {
  const Gait named = understand(Columns::kFeet, readSampleMarkers()).gait;
  const Gait numbered = understand(Columns::kPlates, readSampleMarkers()).gait;
  ASSERT_EQ(numbered.contacts.size(), named.contacts.size());
  for (std::size_t i = 0; i < named.contacts.size(); ++i) {
    EXPECT_EQ(named.contacts[i].seen, named.contacts[i].foot) << i;
    EXPECT_EQ(numbered.contacts[i].foot, named.contacts[i].foot) << i;
    EXPECT_GT(numbered.contacts[i].confidence, 0.95) << i;
    EXPECT_EQ(numbered.contacts[i].contact.strike, named.contacts[i].contact.strike) << i;
  }
  EXPECT_EQ(numbered.events.size(), named.events.size());
  ASSERT_TRUE(numbered.window && named.window);
  EXPECT_EQ(numbered.window->range.start, named.window->range.start);
  EXPECT_EQ(numbered.kind, GaitKind::kWalking);
}

TEST(UnderstandForces, WithoutMarkersNumberedPlatesAreNobodys) {
  const Gait gait = understand(Columns::kPlates, {}).gait;
  EXPECT_FALSE(gait.contacts.empty());
  EXPECT_TRUE(gait.events.empty());
  EXPECT_GE(gait.warnings.size(), 2U);  // one for each plate, and that no force is complete
}

TEST(UnderstandForces, SaysWhereForcesAndMarkersNeverMeet) {
  MarkerTrajectories late = readSampleMarkers();
  for (double& time : late.time) {
    time += 100;
  }
  EXPECT_EQ(understand(Columns::kFeet, late).warnings.size(), 1U);
}

TEST(UnderstandForces, RefusesATableWithoutForces) {
  std::vector<std::string> warnings;
  EXPECT_THROW(understandForces(
                   readColumns(readTable("a\nendheader\ntime\tb\n0\t1\n", "a.sto")), {}, warnings),
               Error);
}

TEST(UnderstandMovement, TellsEventsAndCyclesWithoutForces) {
  const Gait gait = understandMovement(readSampleMarkers());
  EXPECT_EQ(gait.kind, GaitKind::kWalking);
  EXPECT_FALSE(gait.cycles.empty());
  EXPECT_FALSE(gait.window.has_value());
}

}  // namespace
}  // namespace gaitmill
