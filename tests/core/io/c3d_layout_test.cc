#include "core/io/c3d_layout.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/c3d_reader.h"
#include "tests/support/c3d_writer.h"

namespace gaitmill {
namespace {

C3dWriter makeTrial(int frames) {
  C3dWriter writer;
  writer.subframes = 2;
  for (int k = 0; k < frames; ++k) {
    writer.points.push_back({1.0 + k, 2, 3, 0, 4, 5, 6, 0});
    writer.analog.push_back({10.0 * k, 1});
    writer.analog.push_back({10.0 * k + 5, 1});
  }
  writer.addPointGroup({"A", "B"});
  writer.addAnalogGroup({"SOL", "TA"}, {"V", "V"});
  return writer;
}

void expectTrial(const C3dFile& file, int frames) {
  ASSERT_EQ(file.markers.frameCount(), frames);
  ASSERT_EQ(file.markers.markerCount(), 2);
  ASSERT_EQ(file.analog.rowCount(), 2 * frames);
  const int last = frames - 1;
  EXPECT_NEAR(file.markers.position(last, 0).x(), 1e-3 * (1.0 + last), 1e-9);
  EXPECT_EQ(file.analog.values(2 * frames - 1, 0), 10.0 * last + 5);
}

TEST(C3dLayout, WrongCountsOfTheHeaderYieldToTheParameters) {
  C3dWriter writer = makeTrial(60);
  writer.header_points = 7;
  writer.header_samples = 1;
  writer.header_subframes = 9;
  const C3dFile file = readC3d(writer.write(), "a.c3d");
  expectTrial(file, 60);
  ASSERT_EQ(file.warnings.size(), 3u);
  EXPECT_EQ(file.warnings[0], "the header states 7 points, the parameters 2; 2 were taken");
}

TEST(C3dLayout, WrongParametersYieldToAHeaderThatFitsTheFile) {
  C3dWriter writer;
  writer.subframes = 2;
  for (int k = 0; k < 60; ++k) {
    writer.points.push_back({1.0 + k, 2, 3, 0, 4, 5, 6, 0});
    writer.analog.push_back({10.0 * k, 1});
    writer.analog.push_back({10.0 * k + 5, 1});
  }
  writer.addWords("POINT", "USED", {}, {9});
  writer.addPointGroup({"A", "B"});
  writer.addAnalogGroup({"SOL", "TA"}, {"V", "V"});
  expectTrial(readC3d(writer.write(), "a.c3d"), 60);
}

TEST(C3dLayout, FilesEndWhereTheirBytesEnd) {
  C3dWriter writer = makeTrial(60);
  writer.header_last_frame = 500;
  const C3dFile file = readC3d(writer.write(), "a.c3d");
  expectTrial(file, 60);  // the zeros that fill the last block are no frames
  EXPECT_EQ(file.warnings.size(), 1u);
  const std::string whole = makeTrial(60).write();
  const C3dFile cut = readC3d(whole.substr(0, whole.size() - 1024), "a.c3d");
  EXPECT_LT(cut.markers.frameCount(), 60);
  EXPECT_GT(cut.markers.frameCount(), 30);
  EXPECT_EQ(cut.warnings.size(), 1u);
}

TEST(C3dLayout, LongTrialsCountInTwoWords) {
  C3dWriter writer;
  writer.first_frame = 1;
  writer.header_last_frame = 65535;
  for (int k = 0; k < 70000; ++k) {
    writer.points.push_back({1.0 + k % 100, 2, 3, 0});
  }
  writer.addPointGroup({"A"});
  writer.addWords("POINT", "FRAMES", {}, {65535});
  const std::string saturated = writer.write();
  // Nothing says how many: as many as there are.
  EXPECT_EQ(readC3d(saturated, "a.c3d").markers.frameCount(), 70000);
  writer.addWords("TRIAL", "ACTUAL_START_FIELD", {2}, {1, 0});
  writer.addWords("TRIAL", "ACTUAL_END_FIELD", {2}, {70000 - 65536, 1});
  EXPECT_EQ(readC3d(writer.write(), "a.c3d").markers.frameCount(), 70000);
}

TEST(C3dLayout, RatesAndScalesThatMakeNoSenseAreRefused) {
  C3dWriter slow;
  slow.points = {{1, 2, 3, 0}};
  slow.rate = 0;
  C3dWriter integers;
  integers.is_real = false;
  integers.points = {{1, 2, 3, 0}};
  const std::string flat = integers.write().replace(12, 4, 4, '\0');  // the header's scale
  for (const std::string& bytes : {slow.write(), flat}) {
    try {
      readC3d(bytes, "a.c3d");
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kC3dHeader) << error.what();
      EXPECT_EQ(error.where().file, "a.c3d");
    }
  }
}

}  // namespace
}  // namespace gaitmill
