#include "service/run_command.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/service/fake_pipeline.h"
#include "tests/support/temporary_folder.h"

namespace gaitmill {
namespace {

class RunCommandTest : public ::testing::Test {
 protected:
  RunCommandTest() {
    folder_.write("walk.trc", "the bytes");
    folder_.write("models/settings/default.json", R"({"warn": "a marker is missing"})");
    options_.markers = folder_ / "walk.trc";
    options_.models = folder_ / "models";
    options_.out = folder_ / "out/deep";
    options_.mass = 75;
    options_.height = 1.7;
  }
  void run() { runOnFiles(options_, makeFakePipeline(), out_, progress_); }
  std::string read(const std::string& name) {
    std::ifstream file(options_.out + "/" + name);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    return bytes.str();
  }

  TemporaryFolder folder_;
  RunOptions options_;
  std::ostringstream out_;
  std::ostringstream progress_;
};

TEST_F(RunCommandTest, WritesFilesAndSaysWhatHappens) {
  run();
  EXPECT_EQ(read("scaled_model.osim"), "the bytes");
  EXPECT_EQ(progress_.str(),
            "warning: a marker is missing\nscale ...\nik ...\nrra ...\nid ...\nso ...\ncmc ...\n");
  EXPECT_NE(out_.str().find("moments.ankle_angle_r.rmse_nm"), std::string::npos);
}

TEST_F(RunCommandTest, LeavesReportPlotsAndImages) {
  run();
  EXPECT_NE(read("plots/moments.vl.json").find("$schema"), std::string::npos);
  EXPECT_NE(read("images/right_toe_off.png").find("picture of 3 rows at 1.00"), std::string::npos);
  const std::string report = read("report.html");
  EXPECT_NE(report.find("The moments"), std::string::npos);
  EXPECT_NE(report.find("Right heel strike, 0.00 s"), std::string::npos);
  EXPECT_NE(report.find("markers "), std::string::npos) << "its input with its hash";
}

TEST_F(RunCommandTest, LeavesEveryTableUnderItsName) {
  const PipelineFunctions functions = makeFakePipeline();
  run();
  TimeSeries moments = makeFakeTable("moments");
  moments.values(0, 0) = 1.25;
  EXPECT_EQ(read("tables/moments.sto"), functions.encode_sto(moments, api::AngleUnit::kRadians));
  EXPECT_NE(read("tables/kinematics.sto"), "");
}

TEST_F(RunCommandTest, RendererThatFailsCostsTheImagesOnly) {
  PipelineFunctions functions = makeFakePipeline();
  functions.make_drawing = [](const std::string&) {
    return [](const DrawTask&, const DrawData&) -> Picture {
      throw Error(ErrorCode::kRender, "no renderer");
    };
  };
  runOnFiles(options_, functions, out_, progress_);
  EXPECT_NE(progress_.str().find("warning: the report has no images: no renderer"),
            std::string::npos);
  EXPECT_NE(read("report.html"), "");
}

TEST_F(RunCommandTest, TakesASettingsFileAndAFirstStage) {
  folder_.write("mine.json", R"({"fail_at": "so"})");
  options_.settings = folder_ / "mine.json";
  EXPECT_THROW(run(), Error);
  EXPECT_FALSE(std::filesystem::exists(options_.out)) << "a failed run writes nothing";
}

TEST_F(RunCommandTest, UnknownSettingsAreNamed) {
  options_.settings = "defalt";
  EXPECT_THROW(run(), Error);
}

TEST(FormatSummary, IsATableOfStagesThenFigures) {
  EXPECT_EQ(formatSummary(R"({"stages": {"ik": {"seconds": 1.5, "frames": 300},
                "cmc": {"seconds": 2, "simulated_seconds": 1.35}},
                "quality": {"tracking": {"cmc": {"max_deg": 0.51}}}})"),
            "stage       seconds  extent\n"
            "ik            1.500  300 frames\n"
            "cmc           2.000  1.35 s simulated\n"
            "\n"
            "tracking.cmc.max_deg                                                   0.51\n");
}

}  // namespace
}  // namespace gaitmill
