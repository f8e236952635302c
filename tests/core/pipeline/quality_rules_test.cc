#include "core/pipeline/quality_rules.h"

#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/pipeline/pipeline.h"

namespace gaitmill {
namespace {

TEST(QualityRules, AreNamedOnceAndBelongToAStage) {
  std::set<std::string> figures;
  for (const QualityRule& rule : qualityRules()) {
    EXPECT_TRUE(figures.insert(rule.figure).second) << rule.figure;
    EXPECT_NO_THROW(parseStage(rule.stage)) << rule.figure;
  }
}

TEST(QualityRules, EachSaysWhereItComesFromAndWhatToDo) {
  for (const QualityRule& rule : qualityRules()) {
    EXPECT_NE(std::string(rule.source), "") << rule.figure;
    EXPECT_NE(std::string(rule.source), "gaitmill") << rule.figure << " does not say why";
    EXPECT_NE(std::string(rule.meaning), "") << rule.figure;
    for (const std::string text : {rule.cause, rule.fix}) {
      ASSERT_GT(text.size(), 40U) << rule.figure;
      EXPECT_EQ(text.back(), '.') << rule.figure;
    }
  }
}

TEST(QualityRules, FailOnlyBeyondTheirLimitAndSayWhy) {
  for (const QualityRule& rule : qualityRules()) {
    EXPECT_GE(rule.fail_above, rule.limit) << rule.figure;
    const bool fails = std::isfinite(rule.fail_above) && rule.fail_above > rule.limit;
    EXPECT_EQ(std::string(rule.fail_source).empty(), !fails) << rule.figure;
  }
}

TEST(MakeQualityCheck, NamesTheCulpritInItsTexts) {
  const QualityCheck check = makeQualityCheck("marker_error_peak", 6.2, "R.Toe");
  EXPECT_EQ(check.stage, "ik");
  EXPECT_EQ(check.judge(), Verdict::kWarn);
  EXPECT_EQ(check.explain(),
            "inverse kinematics misses a marker by 6.20 cm (R.Toe); the limit is 4.00 cm");
  EXPECT_EQ(check.cause.find("R.Toe"), 0U);
  for (const std::string& text : {check.cause, check.fix}) {
    EXPECT_EQ(text.find("{worst}"), std::string::npos);
  }
}

TEST(MakeQualityCheck, AnUnknownFigureIsOurFault) {
  try {
    makeQualityCheck("marker_error_pike", 1, "");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInternal);
  }
}

// The figures of the sources, so that nobody moves a bound unnoticed.
TEST(QualityRules, HoldThePublishedFigures) {
  const auto limit = [](const char* figure) {
    return makeQualityCheck(figure, 0, "").limit;
  };
  EXPECT_EQ(limit("static_pose_rms"), 1);  // [cm] OpenSim's list of questions
  EXPECT_EQ(limit("static_pose_peak"), 2);
  EXPECT_EQ(limit("marker_error_rms"), 2);
  EXPECT_EQ(limit("marker_error_peak"), 4);
  EXPECT_EQ(limit("residual_force_peak"), 25);  // [N]
  EXPECT_EQ(limit("residual_force_rms"), 10);
  EXPECT_EQ(limit("rra_residual_force_rms"), 15);
  EXPECT_EQ(limit("residual_moment_peak"), 75);  // [N.m]
  EXPECT_EQ(limit("residual_moment_rms"), 50);
  EXPECT_EQ(limit("residual_moment_share"), 1);  // [%] Hicks et al. (2015)
  EXPECT_EQ(limit("joint_reserve"), 10);         // [%]
  EXPECT_EQ(limit("moment_rmse"), 3);            // [%] Rajagopal et al. (2016)
  EXPECT_EQ(limit("moment_peak_difference"), 11);
}

}  // namespace
}  // namespace gaitmill
