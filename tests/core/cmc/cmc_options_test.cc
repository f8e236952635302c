#include "core/cmc/cmc_options.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace gaitmill {
namespace {

CmcOptions makeOptions() {
  CmcOptions options;
  options.end_time = 1;
  return options;
}

ErrorCode findFault(const CmcOptions& options) {
  try {
    options.validate();
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::kInternal;
}

TEST(CmcOptions, DefaultsAreValidOverASecond) {
  EXPECT_NO_THROW(makeOptions().validate());
}

TEST(CmcOptions, RangeShorterThanTheInitialStageIsRefused) {
  CmcOptions options = makeOptions();
  options.end_time = 0.04;
  EXPECT_EQ(findFault(options), ErrorCode::kInputTimeRange);
}

TEST(CmcOptions, ValuesOutOfRangeAreRefused) {
  CmcOptions options = makeOptions();
  options.window = 0;
  EXPECT_EQ(findFault(options), ErrorCode::kSettingsValue);
  options = makeOptions();
  options.min_excitation = 0;
  EXPECT_EQ(findFault(options), ErrorCode::kSettingsValue);
  options = makeOptions();
  options.excitation_limits = {{"soleus_r", {{1, 1}, {0.5, 1}}}};
  EXPECT_EQ(findFault(options), ErrorCode::kSettingsValue);
}

}  // namespace
}  // namespace gaitmill
