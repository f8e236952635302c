#include "core/io/trc_reader.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/text_cells.h"
#include "tests/support/shared_data.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

std::string makeHead(const std::string& rate, const std::string& frames, const std::string& units) {
  return "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\t"
         "OrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n" +
         rate + "\t" + rate + "\t" + frames + "\t2\t" + units + "\t" + rate + "\t1\t" + frames +
         "\nFrame#\tTime\tA\t\t\tB B\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n";
}

TEST(TrcReader, MillimetresBecomeMetresAndEmptyCellsMissing) {
  const TrcFile file = readTrc(
      makeHead("100", "2", "mm") + "1\t0\t1000\t2\t-3\t\t\t\t\n2\t0.01\t1\t2\tNaN\t4\t5\t6\n",
      "a.trc");
  const MarkerTrajectories& markers = file.markers;
  EXPECT_EQ(markers.names, (std::vector<std::string>{"A", "B B"}));
  EXPECT_EQ(markers.rate, 100);
  EXPECT_EQ(markers.position(0, 0), Eigen::Vector3d(1, 0.002, -0.003));
  EXPECT_TRUE(markers.isMissing(0, 1));
  EXPECT_TRUE(markers.isMissing(1, 0));
  EXPECT_TRUE(std::isnan(markers.position(1, 0)[0])) << "one missing component, all missing";
  EXPECT_EQ(markers.position(1, 1), Eigen::Vector3d(0.004, 0.005, 0.006));
  EXPECT_TRUE(file.warnings.empty());
}

TEST(TrcReader, ExactZerosAreMissingUnlessAskedOtherwise) {
  const std::string text = makeHead("100", "1", "m") + "1\t0\t0\t0\t0\t1\t0\t0\n";
  const TrcFile file = readTrc(text, "a.trc");
  EXPECT_TRUE(file.markers.isMissing(0, 0));
  EXPECT_FALSE(file.markers.isMissing(0, 1));
  EXPECT_EQ(file.warnings.size(), 1u);
  TrcOptions options;
  options.zeros = TrcOptions::Zeros::kMeasured;
  EXPECT_FALSE(readTrc(text, "a.trc", options).markers.isMissing(0, 0));
}

TEST(TrcReader, RoundedTimesBecomeRegularUnlessExactIsAsked) {
  const std::string text = makeHead("60", "3", "m") +
                           "1\t0.000\t1\t1\t1\t1\t1\t1\n2\t0.017\t1\t1\t1\t1\t1\t1\n"
                           "3\t0.033\t1\t1\t1\t1\t1\t1\n";
  const TrcFile regular = readTrc(text, "a.trc");
  EXPECT_EQ(regular.markers.time[1], 1.0 / 60.0);
  EXPECT_EQ(regular.markers.time[2], 2.0 / 60.0);
  TrcOptions options;
  options.times = TrcOptions::Times::kExact;
  EXPECT_EQ(readTrc(text, "a.trc", options).markers.time[1], 0.017);
}

TEST(TrcReader, TimesThatDoNotIncreaseAreRebuiltFromTheRate) {
  const TrcFile file = readTrc(
      makeHead("50", "2", "m") + "1\t0\t1\t1\t1\t1\t1\t1\n2\t0\t1\t1\t1\t1\t1\t1\n", "a.trc");
  EXPECT_EQ(file.markers.time[1], 0.02);
  EXPECT_EQ(file.warnings.size(), 1u);
}

TEST(TrcReader, TimesThatCannotBeRebuiltAreRefused) {
  for (const char* const rows : {"1\t1e308\t1\t1\t1\t1\t1\t1\n2\t0\t1\t1\t1\t1\t1\t1\n",
                                 "1\t9e15\t1\t1\t1\t1\t1\t1\n2\t9e15\t1\t1\t1\t1\t1\t1\n"}) {
    try {
      readTrc(makeHead("50", "2", "m") + rows, "a.trc");
      ADD_FAILURE() << rows;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kTrcTimeOrder) << error.what();
    }
  }
}

// Each of these lines once cost the square of its length, or 24 bytes of memory per byte.
TEST(TrcReader, EndlessHeadingsAreRefused) {
  const std::string head = "PathFileType\t4\nDataRate\tUnits\n50\tm\nFrame#\tTime";
  for (const char* const column : {"\tA", "\t*1", "\t"}) {
    std::string text = head;
    for (std::size_t i = 0; i < 10 * kMaximumCells; ++i) {
      text += column;
    }
    EXPECT_THROW(readTrc(text + "\tA\n1\t0\n", "a.trc"), Error) << column;
  }
}

TEST(TrcReader, CutLastRowIsDroppedAndWrongCountsAreWarnings) {
  const TrcFile file =
      readTrc(makeHead("50", "9", "m") + "1\t0\t1\t1\t1\t1\t1\t1\n2\t0.02\t1\t1", "a.trc");
  EXPECT_EQ(file.markers.frameCount(), 1);
  EXPECT_EQ(file.warnings.size(), 2u);
}

TEST(TrcReader, RepeatedAndUnlabelledMarkersAreDropped) {
  std::string text = makeHead("50", "1", "m") + "1\t0\t1\t2\t3\t4\t5\t6\n";
  text.replace(text.find("\tB B"), 4, "\tA");
  EXPECT_EQ(readTrc(text, "a.trc").markers.names, (std::vector<std::string>{"A"}));
  text.replace(text.find("Time\tA"), 6, "Time\t*12");
  const TrcFile file = readTrc(text, "a.trc");
  EXPECT_EQ(file.markers.names, (std::vector<std::string>{"A"}));
  EXPECT_EQ(file.markers.position(0, 0), Eigen::Vector3d(4, 5, 6)) << "columns did not shift";
}

TEST(TrcReader, SubjectPrefixIsStrippedOnRequest) {
  std::string text = makeHead("50", "1", "m") + "1\t0\t1\t2\t3\t4\t5\t6\n";
  text.replace(text.find("\tB B"), 4, "\tJo:B");
  EXPECT_EQ(readTrc(text, "a.trc").markers.names[1], "Jo:B");
  TrcOptions options;
  options.prefixes = TrcOptions::Prefixes::kStrip;
  EXPECT_EQ(readTrc(text, "a.trc", options).markers.names[1], "B");
}

class TrcReaderShared : public SharedDataTest {
 protected:
  TrcFile read(const std::string& relative) const {
    return readTrc(readFile(shared(relative)), relative);
  }
};

// data/README.md 5 to 7.
TEST_F(TrcReaderShared, EveryMarkerFileIsRead) {
  struct Expectation {
    const char* file;
    int markers;
    int frames;
    double rate;
    double first;
    double last;
    std::size_t warnings;
  };
  const Expectation expectations[] = {
      {"data/walk/motion_capture_walk.trc", 41, 238, 100, 0, 2.37, 0},
      {"data/walk/static_walk_1.trc", 64, 287, 100, 0, 2.86, 0},
      {"data/walk/static_walk_2.trc", 41, 153, 100, 0, 1.52, 0},
      {"data/run/paper_subject01/motion_capture_run.trc", 42, 510, 100, 0.23, 5.32, 0},
      {"data/run/paper_subject01/static_run.trc", 64, 397, 100, 0, 3.96, 0},
      {"data/run/hamner2010/subject02_static.trc", 49, 300, 60, 0, 299 / 60.0, 0},
      {"data/run/hamner2010/subject02_running.trc", 41, 600, 60, 0, 599 / 60.0, 1},
      {"data/run/hamner2013_subject04/run400/markers.trc", 42, 209, 100, 0.65, 2.73, 0},
      {"data/c3d/expected/std_walking2_markers.trc", 44, 126, 250, 0, 4.992, 1},
  };
  for (const Expectation& expected : expectations) {
    SCOPED_TRACE(expected.file);
    const TrcFile file = read(expected.file);
    EXPECT_EQ(file.markers.markerCount(), expected.markers);
    EXPECT_EQ(file.markers.frameCount(), expected.frames);
    EXPECT_EQ(file.markers.rate, expected.rate);
    EXPECT_NEAR(file.markers.time.front(), expected.first, tol(1e-12));
    EXPECT_NEAR(file.markers.time.back(), expected.last, tol(1e-12));
    EXPECT_EQ(file.warnings.size(), expected.warnings)
        << (file.warnings.empty() ? "" : file.warnings.front());
  }
}

TEST_F(TrcReaderShared, FirstPositionsAreTheFilesNumbers) {
  const MarkerTrajectories markers = read("data/walk/motion_capture_walk.trc").markers;
  EXPECT_EQ(markers.names.front(), "R.Shoulder");
  EXPECT_EQ(markers.names.back(), "L.Toe");
  EXPECT_LT((markers.position(0, 0) - Eigen::Vector3d(-0.652630, 1.529542, -0.094520)).norm(),
            tol(1e-15));
  EXPECT_LT((markers.position(237, 0) - Eigen::Vector3d(2.305031, 1.522685, -0.100799)).norm(),
            tol(1e-15));
}

TEST_F(TrcReaderShared, BicepsOfTheHamnerTrialIsMissingThroughout) {
  const MarkerTrajectories markers = read("data/run/hamner2010/subject02_running.trc").markers;
  const int biceps = markers.findMarker("L.Bicep").value();
  for (int frame = 0; frame < markers.frameCount(); ++frame) {
    EXPECT_TRUE(markers.isMissing(frame, biceps));
  }
}

}  // namespace
}  // namespace gaitmill
