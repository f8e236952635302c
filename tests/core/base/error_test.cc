#include "core/base/error.h"

#include <cctype>
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

TEST(Error, SaysWhereInTheComputation) {
  Where where;
  where.time = 0.35;
  where.marker = "RASI";
  Error error(ErrorCode::kInputMarkers, "is seen in no frame", where);
  Where outer;
  outer.stage = "ik";
  outer.marker = "LASI";
  error.completeWhere(outer);
  EXPECT_STREQ(error.what(),
               "is seen in no frame [input.markers] (stage ik, 0.350 s, marker RASI)");
}

TEST(Error, CutsWhatWouldQuoteAWholeFile) {
  Where where;
  where.field = std::string(1 << 20, 'f');
  Error error(ErrorCode::kTrcNumber, std::string(Error::kMaximumText + 1, 'x'), where);
  error.addContext(std::string(1 << 20, 'c'));
  EXPECT_EQ(error.message().size(), Error::kMaximumText);
  EXPECT_EQ(error.message().substr(Error::kMaximumText - 4), "x...");
  EXPECT_EQ(error.where().field.size(), Error::kMaximumText);
  EXPECT_EQ(error.context()[0].size(), Error::kMaximumText);
  EXPECT_EQ(Error(ErrorCode::kTrcNumber, std::string(Error::kMaximumText, 'x')).message().size(),
            Error::kMaximumText);
}

TEST(Error, CutsBetweenCharacters) {
  std::string umlauts = "x";
  while (umlauts.size() < Error::kMaximumText + 10) {
    umlauts += "\xC3\xA4";
  }
  const std::string message = Error(ErrorCode::kTrcNumber, umlauts).message();
  EXPECT_EQ(message.substr(message.size() - 5), "\xC3\xA4...");
}

TEST(Where, IsEmptyUntilOneMemberIsKnown) {
  EXPECT_TRUE(Where{}.isEmpty());
  Where time_only;
  time_only.time = 0;
  EXPECT_FALSE(time_only.isEmpty());
  EXPECT_FALSE((Where{"", 0, 0, "field"}.isEmpty()));
}

/// Words of a to z and _, with single dots between them. (GCC 12 takes std::regex for uninitialized
/// under the address sanitizer.)
bool isDottedWords(const std::string& name) {
  bool in_word = false;
  for (const char c : name) {
    const bool digit = in_word && c >= '0' && c <= '9';  // "c3d"
    const bool letter = (c >= 'a' && c <= 'z') || c == '_' || digit;
    if (!letter && !(c == '.' && in_word)) {
      return false;
    }
    in_word = letter;
  }
  return in_word;
}

TEST(ErrorCode, NamesAreUniqueDottedLowerCaseWords) {
  std::set<std::string> names;
  for (const ErrorCode code : allErrorCodes()) {
    const std::string name(codeName(code));
    EXPECT_TRUE(isDottedWords(name)) << name;
    EXPECT_TRUE(names.insert(name).second) << name;
  }
}

TEST(ErrorCode, EveryCodeSaysInOneSentenceOfItsOwnWhatToDo) {
  std::set<std::string> sentences;
  for (const ErrorCode code : allErrorCodes()) {
    const std::string fix(codeFix(code));
    EXPECT_GE(fix.size(), 30U) << codeName(code);
    EXPECT_LE(fix.size(), 120U) << codeName(code);
    EXPECT_TRUE(!fix.empty() && fix.back() == '.' && std::isupper(fix.front()) != 0) << fix;
    EXPECT_TRUE(sentences.insert(fix).second) << fix;
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

TEST(FindNearestName, DoesNotMeasureWhatIsNoName) {
  EXPECT_EQ(findNearestName(std::string(100000000, 'm'), {"mass", std::string(100000000, 'm')}),
            "");
}

}  // namespace
}  // namespace gaitmill
