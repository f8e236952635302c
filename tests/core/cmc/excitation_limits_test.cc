#include "core/cmc/excitation_limits.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace gaitmill {
namespace {

ModelSpec makeModel() {
  ModelSpec model;
  model.muscles.resize(2);
  model.muscles[0].name = "gasmed_r";
  model.muscles[1].name = "soleus_r";
  return model;
}

CmcOptions makeOptions(const char* muscle) {
  CmcOptions options;
  options.excitation_limits.push_back({muscle, {{1.0672, 1}, {1.375, 0.02}, {1.546, 0.5}}});
  return options;
}

TEST(ExcitationLimits, NodeValueHoldsOnTheIntervalThatEndsAtIt) {
  const ExcitationLimits limits(makeModel(), makeOptions("gasmed_r"));
  EXPECT_EQ(limits.findUpper(0, 0.5), 1);
  EXPECT_EQ(limits.findUpper(0, 1.06), 1);
  EXPECT_EQ(limits.findUpper(0, 1.07), 0.02);
  EXPECT_EQ(limits.findUpper(0, 1.4), 0.5);
  EXPECT_EQ(limits.findUpper(0, 9), 0.5);
}

TEST(ExcitationLimits, TimeWithinRoundOffOfANodeIsAfterIt) {
  const ExcitationLimits limits(makeModel(), makeOptions("gasmed_r"));
  EXPECT_EQ(limits.findUpper(0, 1.375 - 5e-10), 0.5);
  EXPECT_EQ(limits.findUpper(0, 1.375 - 5e-9), 0.02);
}

TEST(ExcitationLimits, UnlistedMuscleHasTheGeneralLimit) {
  CmcOptions options = makeOptions("gasmed_r");
  options.max_excitation = 0.9;
  EXPECT_EQ(ExcitationLimits(makeModel(), options).findUpper(1, 1.2), 0.9);
}

TEST(ExcitationLimits, RefusesAMuscleThatIsNotThere) {
  try {
    ExcitationLimits(makeModel(), makeOptions("gas_med_r"));
    FAIL() << "did not throw";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kSettingsValue);
    EXPECT_NE(error.message().find("'gas_med_r'"), std::string::npos);
  }
}

TEST(ExcitationLimits, RefusesTwoListsForOneMuscle) {
  CmcOptions options = makeOptions("gasmed_r");
  options.excitation_limits.push_back(options.excitation_limits[0]);
  EXPECT_THROW(ExcitationLimits(makeModel(), options), Error);
}

}  // namespace
}  // namespace gaitmill
