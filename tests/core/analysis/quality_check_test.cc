#include "core/analysis/quality_check.h"

#include <gtest/gtest.h>

namespace gaitmill {
namespace {

QualityCheck makeCheck(double value) {
  QualityCheck check;
  check.figure = "residual_force_peak";
  check.meaning = "the residual force at the pelvis peaks at";
  check.unit = "N";
  check.worst = "FX";
  check.value = value;
  check.limit = 25;
  check.fail_above = 50;
  return check;
}

TEST(QualityCheck, PassesUpToItsLimitAndFailsBeyondTheOther) {
  EXPECT_EQ(makeCheck(25).judge(), Verdict::kPass);
  EXPECT_EQ(makeCheck(25.1).judge(), Verdict::kWarn);
  EXPECT_EQ(makeCheck(50).judge(), Verdict::kWarn);
  EXPECT_EQ(makeCheck(50.1).judge(), Verdict::kFail);
}

TEST(QualityCheck, WhatIsNotANumberWarns) {
  EXPECT_EQ(QualityCheck{}.judge(), Verdict::kWarn);
}

TEST(QualityCheck, ExplainsItselfInASentence) {
  EXPECT_EQ(makeCheck(38.23).explain(),
            "the residual force at the pelvis peaks at 38.2 N (FX); the limit is 25.0 N");
}

TEST(JudgeAll, TakesTheWorst) {
  EXPECT_EQ(judgeAll({}), Verdict::kPass);
  EXPECT_EQ(judgeAll({makeCheck(1), makeCheck(30)}), Verdict::kWarn);
  EXPECT_EQ(judgeAll({makeCheck(60), makeCheck(30)}), Verdict::kFail);
}

}  // namespace
}  // namespace gaitmill
