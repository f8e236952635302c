#include "core/pipeline/job_checks.h"

#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

class JobChecksTest : public ::testing::Test {
 protected:
  JobChecksTest() { job_.input = &input_; }

  const QualityCheck* find(const std::string& figure) const {
    for (const QualityCheck& check : quality_.checks) {
      if (check.figure == figure) {
        return &check;
      }
    }
    return nullptr;
  }
  const QualityCheck& get(const std::string& figure) const {
    const QualityCheck* const found = find(figure);
    static const QualityCheck nothing;
    EXPECT_NE(found, nullptr) << figure;
    return found == nullptr ? nothing : *found;
  }

  TrialInput input_;
  Job job_;
  JobQuality quality_;
  std::vector<ActuatorStatistics> residuals_ = {
      {"FX", 20, 4}, {"FY", 60, 9}, {"FZ", 5, 2}, {"MX", 12, 6}, {"MY", 30, 8}, {"MZ", 24, 11}};
};

TEST_F(JobChecksTest, ForceLimitIsTheLargerOf25NewtonAndFivePercentOfTheReaction) {
  EXPECT_EQ(findForceLimit(std::numeric_limits<double>::quiet_NaN()), 25);
  EXPECT_EQ(findForceLimit(400), 25);
  EXPECT_EQ(findForceLimit(2000), 100);
  quality_.peak_reaction = 1000;
  checkResiduals("", residuals_, quality_);
  const QualityCheck& peak = get("residual_force_peak");
  EXPECT_EQ(peak.worst, "FY");
  EXPECT_EQ(peak.limit, 50);
  EXPECT_EQ(peak.fail_above, 100);
  EXPECT_EQ(peak.judge(), Verdict::kWarn);
  EXPECT_EQ(get("residual_force_rms").value, 9);
  EXPECT_EQ(get("residual_moment_peak").worst, "MY");
  EXPECT_EQ(get("residual_moment_rms").worst, "MZ");
}

TEST_F(JobChecksTest, ResidualsOfWhichOneIsMissingAreNotJudged) {
  residuals_.erase(residuals_.begin());
  checkResiduals("", residuals_, quality_);
  EXPECT_EQ(find("residual_force_peak"), nullptr);
  EXPECT_NE(find("residual_moment_peak"), nullptr);
}

TEST_F(JobChecksTest, ResidualMomentIsHeldAgainstHeightTimesReaction) {
  job_.cmc.emplace();
  job_.cmc->counters.windows = 1;
  quality_.cmc_tracking = TrackingError{1, 1, 1, 1, 1, "", ""};
  quality_.residuals = residuals_;
  quality_.peak_reaction = 1000;
  quality_.mass_center_height = 1;
  checkCmc(job_, quality_);
  const QualityCheck& share = get("residual_moment_share");
  EXPECT_NEAR(share.value, 3.0, tol(1e-12));  // 30 N m of 1 m x 1000 N
  EXPECT_EQ(share.judge(), Verdict::kWarn) << "it never condemns a result alone";
}

TEST_F(JobChecksTest, ScaleFactorsAreJudgedAlikeUpAndDown) {
  job_.scale.emplace();
  job_.scale->factors = {{"femur_r", {1.0 / 1.5, 1, 1}}, {"femur_l", {1.0 / 1.5, 1, 1.03}}};
  checkScale(job_, quality_);
  EXPECT_NEAR(get("scale_factor_deviation").value, 50, tol(1e-9));
  EXPECT_EQ(get("scale_factor_deviation").worst, "femur_r x");
  EXPECT_NEAR(get("scale_side_difference").value, 3, tol(1e-9));
  EXPECT_EQ(get("scale_side_difference").worst, "femur_r z");
  EXPECT_EQ(find("static_pose_rms"), nullptr) << "no marker was placed";
  EXPECT_EQ(find("model_mass_difference"), nullptr) << "no mass was given";
}

TEST_F(JobChecksTest, TheWorstStaticPoseCounts) {
  job_.scale.emplace();
  job_.scale->factors = {{"pelvis", {1, 1, 1}}};
  job_.scale->placements.resize(2);
  job_.scale->placements[0].rms = 0.012;
  job_.scale->placements[0].max_error = 0.015;
  job_.scale->placements[1].rms = 0.008;
  job_.scale->placements[1].max_error = 0.024;
  job_.scale->placements[1].worst_marker = "RPSI";
  checkScale(job_, quality_);
  EXPECT_NEAR(get("static_pose_rms").value, 1.2, tol(1e-12));
  EXPECT_NEAR(get("static_pose_peak").value, 2.4, tol(1e-12));
  EXPECT_EQ(get("static_pose_peak").worst, "RPSI");
}

TEST_F(JobChecksTest, ResidualsOfInverseDynamicsWarnButNeverFail) {
  job_.id.emplace();
  checkId(job_, quality_);
  EXPECT_TRUE(quality_.checks.empty()) << "nothing was measured about the whole body";
  job_.id->residual_wrench = makeTimeSeries("residual_wrench",
                                            {"residual_force_x",
                                             "residual_force_y",
                                             "residual_force_z",
                                             "residual_moment_x",
                                             "residual_moment_y",
                                             "residual_moment_z"},
                                            {0, 1});
  job_.id->residual_wrench.values << 1, -300, 2, 10, 20, -30, 0, 20, 1, 5, 6, 7;
  checkId(job_, quality_);
  EXPECT_EQ(get("id_residual_force_peak").value, 300);
  EXPECT_EQ(get("id_residual_force_peak").worst, "residual_force_y");
  EXPECT_EQ(get("id_residual_force_peak").judge(), Verdict::kWarn);
  EXPECT_EQ(get("id_residual_moment_peak").value, 30);
  EXPECT_EQ(get("id_residual_moment_peak").judge(), Verdict::kPass);
}

TEST_F(JobChecksTest, TimesOfActivityAreJudgedOnTheMeanOfTheChannels) {
  job_.cmc.emplace();
  quality_.cmc_tracking = TrackingError{1, 1, 1, 1, 1, "", ""};
  quality_.emg.resize(3);
  quality_.emg[0].overlap = 0.9;
  quality_.emg[1].channel = "GMAX";
  quality_.emg[1].overlap = 0.0;
  quality_.emg[2].overlap = std::numeric_limits<double>::quiet_NaN();
  checkCmc(job_, quality_);
  EXPECT_NEAR(get("emg_timing").value, 55, tol(1e-12));
  EXPECT_EQ(get("emg_timing").worst, "GMAX");
  EXPECT_EQ(get("emg_timing").judge(), Verdict::kWarn);
}

TEST_F(JobChecksTest, WorkIsHeldAgainstAllWorkWhateverItsSign) {
  job_.cmc.emplace();
  quality_.cmc_tracking = TrackingError{1, 1, 1, 1, 1, "", ""};
  job_.analysis.emplace();
  WorkBalance& work = job_.analysis->balance;
  work.muscles = 60;
  work.actuators = -10;
  work.residuals = -8;
  work.ground = -22;
  work.energy_change = 21;  // 1 J more than all of them together
  checkCmc(job_, quality_);
  EXPECT_NEAR(get("residual_work").value, 8, tol(1e-12));
  EXPECT_EQ(get("residual_work").judge(), Verdict::kWarn);
  EXPECT_NEAR(get("work_imbalance").value, 1, tol(1e-12));
}

class RraChecksTest : public JobChecksTest {
 protected:
  RraChecksTest() {
    job_.rra.emplace();
    job_.rra->passes.resize(2);
    for (RraPassResult& pass : job_.rra->passes) {
      pass.adjustment.mass_before = 50;
      pass.adjustment.mass_change = 0.75;
      pass.adjustment.shift_x = -0.015;
      pass.adjustment.shift_z = 0.02;
    }
    quality_.rra_tracking = TrackingError{1, 1, 1, 1, 1, "", ""};
    quality_.rra_residuals = residuals_;
  }
};

TEST_F(RraChecksTest, MassAndShiftAddUpOverThePasses) {
  checkRra(job_, quality_);
  EXPECT_NEAR(get("rra_mass_change").value, 3, tol(1e-12));
  EXPECT_EQ(get("rra_mass_change").judge(), Verdict::kWarn);
  EXPECT_NEAR(get("rra_center_shift").value, 5, tol(1e-12));
  EXPECT_EQ(get("rra_center_shift").worst, "torso");
}

TEST_F(RraChecksTest, NamesWithoutAStageBelongToTheLastSimulation) {
  checkRra(job_, quality_);
  EXPECT_EQ(get("residual_force_peak").stage, "rra");
  quality_.checks.clear();
  job_.cmc.emplace();
  checkRra(job_, quality_);
  EXPECT_EQ(find("residual_force_peak"), nullptr);
  EXPECT_EQ(get("rra_residual_force_peak").stage, "rra");
}

TEST_F(JobChecksTest, ReservesOfStaticOptimizationFailOnlyWhereTheyAreTheLastWord) {
  job_.so.emplace();
  quality_.so_joint_reserves = {{"ankle_l", "ankle_angle_l_reserve", 66, 258}};
  checkSo(job_, quality_);
  EXPECT_EQ(get("so_joint_reserve").judge(), Verdict::kFail);
  quality_.checks.clear();
  job_.cmc.emplace();
  checkSo(job_, quality_);
  EXPECT_EQ(get("so_joint_reserve").judge(), Verdict::kWarn);
}

}  // namespace
}  // namespace gaitmill
