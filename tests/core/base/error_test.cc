#include "core/base/error.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

#include "core/base/index.h"
#include "core/base/progress.h"

namespace gaitmill {
namespace {

TEST(Error, SaysPlaceFieldMessageCodeAndContext) {
  Error error(ErrorCode::kTrcColumnCount,
              "row has 124 values, 41 markers need 125",
              {"walk1.trc", 214, 1, ""});
  error.addContext("reading markers").addContext("trial 7f3a");
  EXPECT_STREQ(error.what(),
               "walk1.trc:214:1: row has 124 values, 41 markers need 125 [trc.column_count] "
               "(reading markers) (trial 7f3a)");
}

TEST(Error, KeepsTheFileNameItWasGivenFirst) {
  Error error(ErrorCode::kTrcNumber, "not a number", {"", 3, 7, ""});
  error.setFile("a.trc").setFile("b.trc");
  EXPECT_EQ(error.where().file, "a.trc");
}

TEST(ErrorCode, NamesAreUnique) {
  std::set<std::string> names;
  for (const ErrorCode code : allErrorCodes()) {
    EXPECT_TRUE(names.insert(std::string(codeName(code))).second) << codeName(code);
  }
}

TEST(FindNearestName, FindsMisspellingsOnly) {
  EXPECT_EQ(findNearestName("masss", {"height", "mass"}), "mass");
  EXPECT_EQ(findNearestName("tib_ant", {"tibant", "soleus"}), "tibant");
  EXPECT_EQ(findNearestName("xyz", {"height", "mass"}), "");
}

TEST(Progress, AskingToStopThrowsCancelled) {
  reportProgress({}, 0.5);
  reportProgress([](double) { return true; }, 0.5);
  try {
    reportProgress([](double) { return false; }, 0.5);
    FAIL() << "did not throw";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCancelled);
  }
}

TEST(Index, DefaultIsInvalidAndGroundIsNotABody) {
  EXPECT_FALSE(BodyIndex().isValid());
  EXPECT_TRUE(BodyIndex(0).isValid());
  EXPECT_EQ(kGround, BodyIndex(-1));
}

}  // namespace
}  // namespace gaitmill
