#include "service/render_command.h"

#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "core/io/files.h"
#include "tests/service/expect_error.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr const char* kModel = "models/rajagopal2016/rajagopal2016.osim";
constexpr const char* kMotion =
    "motion\nversion=1\nnRows=2\nnColumns=3\ninDegrees=yes\nendheader\n"
    "time\tknee_angle_r\tpelvis_ty\n0.5\t0\t0.9\n1.5\t90\t1.0\n";

class RenderCommandTest : public ::testing::Test {
 protected:
  RenderCommandTest() {
    folder_.write("walk.mot", kMotion);
    options_.model = kModel;
    options_.motion = folder_ / "walk.mot";
    options_.out = folder_ / "out/pose.png";
  }
  void render() {
    renderFiles(
        options_,
        [this](const DrawTask& task, const DrawData& data) {
          task_ = task;
          data_ = data;
          return Picture{"image/png", "pixels"};
        },
        report_);
  }

  TemporaryFolder folder_;
  RenderOptions options_;
  DrawTask task_;
  DrawData data_;
  std::ostringstream report_;
};

TEST_F(RenderCommandTest, DrawsAPoseOfAMotionInDegrees) {
  options_.parameters = {{"time", "1.5"}, {"width", "400"}, {"view", "frontal"}};
  render();
  EXPECT_EQ(readFile(options_.out), "pixels");
  EXPECT_NE(report_.str().find("pose.png: 6 bytes of image/png"), std::string::npos);
  EXPECT_EQ(task_.kind, DrawTask::Kind::kPose);
  EXPECT_EQ(task_.start, 1.5);
  EXPECT_EQ(task_.options.width, 400);
  const TimeSeries& motion = data_.picture.kinematics;
  EXPECT_NEAR(motion.values(1, motion.getColumn("knee_angle_r")), 1.5707963267948966, tol(1e-12));
  EXPECT_EQ(motion.values(1, motion.getColumn("pelvis_ty")), 1.0);
}

TEST_F(RenderCommandTest, NameAndPosesSayWhatKindOfImageItIs) {
  options_.parameters = {{"poses", "3"}};
  render();
  EXPECT_EQ(task_.kind, DrawTask::Kind::kStrip);
  EXPECT_EQ(task_.poses, 3);
  options_.parameters = {{"rate", "10"}};
  options_.out = folder_ / "walk.webp";
  render();
  EXPECT_EQ(task_.kind, DrawTask::Kind::kAnimation);
  EXPECT_EQ(task_.start, 0.5);
  EXPECT_EQ(task_.end, 1.5);
}

// The files of the last stage that ran, and the cycle of the summary.
TEST_F(RenderCommandTest, FindsWhatARunHasLeft) {
  const std::string run = folder_ / "run";
  writeFile(run + "/adjusted_model.osim", readFile(kModel));
  writeFile(run + "/ik.mot", kMotion);
  writeFile(run + "/so_activations.sto",
            "a\nversion=1\nendheader\ntime\tsoleus_r\n0.5\t0.25\n1.5\t0.75\n");
  writeFile(run + "/tables/ground_reactions.sto",
            "a\nversion=1\nendheader\ntime\tright_fy\n0.5\t700\n1.5\tNaN\n");
  writeFile(run + "/summary.json", R"({"gait_cycle_s": [0.5, 1.0]})");
  options_.model.clear();
  options_.motion.clear();
  options_.results = run;
  options_.parameters = {{"percent", "50"}};
  render();
  EXPECT_EQ(task_.start, 0.75);
  EXPECT_EQ(data_.picture.muscle_values.labels, std::vector<std::string>{"soleus_r"});
  EXPECT_EQ(data_.picture.ground_reactions.values(0, 0), 700);
  EXPECT_EQ(data_.picture.markers.columnCount(), 0);
  ASSERT_TRUE(data_.picture.cycle);
  EXPECT_EQ(data_.picture.cycle->end, 1.0);
  options_.parameters = {{"color", "none"}};
  render();
  EXPECT_EQ(data_.picture.muscle_values.columnCount(), 0);
}

TEST_F(RenderCommandTest, SaysWhatIsWrong) {
  options_.out = folder_ / "pose.jpg";
  EXPECT_ERROR(render(), ErrorCode::kRequestField);
  options_.out = folder_ / "pose.png";
  options_.parameters = {{"rate", "10"}};
  EXPECT_ERROR(render(), ErrorCode::kRequestField);
  options_.parameters = {{"percent", "10"}};
  EXPECT_ERROR(render(), ErrorCode::kRequestField);
  options_.parameters = {{"view", "above"}};
  EXPECT_ERROR(render(), ErrorCode::kRequestField);
  options_.parameters.clear();
  options_.motion.clear();
  EXPECT_ERROR(render(), ErrorCode::kInputMissing);
}

}  // namespace
}  // namespace gaitmill
