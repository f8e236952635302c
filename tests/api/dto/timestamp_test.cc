#include "api/dto/timestamp.h"

#include <gtest/gtest.h>

namespace gaitmill::api {
namespace {

TEST(FormatTimestamp, IsUtcWithMilliseconds) {
  EXPECT_EQ(formatTimestamp(0), "1970-01-01T00:00:00.000Z");
  EXPECT_EQ(formatTimestamp(1'700'000'000'007), "2023-11-14T22:13:20.007Z");
}

TEST(ParseTimestamp, ReadsEveryOffsetAndFraction) {
  EXPECT_EQ(parseTimestamp("2023-11-14T22:13:20Z"), 1'700'000'000'000);
  EXPECT_EQ(parseTimestamp("2023-11-14t22:13:20.007z"), 1'700'000'000'007);
  EXPECT_EQ(parseTimestamp("2023-11-14T23:13:20+01:00"), 1'700'000'000'000);
  EXPECT_EQ(parseTimestamp("2023-11-14T16:43:20.5-05:30"), 1'700'000'000'500);
  EXPECT_EQ(parseTimestamp("2023-11-14 22:13:20.0079999Z"), 1'700'000'000'007);
  EXPECT_EQ(parseTimestamp("2024-02-29T00:00:00Z"), 1'709'164'800'000);
  // What a query makes of an unescaped '+'.
  EXPECT_EQ(parseTimestamp("2023-11-14T23:13:20 01:00"), 1'700'000'000'000);
}

TEST(ParseTimestamp, ComesBack) {
  for (const std::int64_t time : {std::int64_t{0}, std::int64_t{951'782'399'999}}) {
    EXPECT_EQ(parseTimestamp(formatTimestamp(time)), time);
  }
}

class BadTimestamp : public ::testing::TestWithParam<const char*> {};
TEST_P(BadTimestamp, IsNone) {
  EXPECT_FALSE(parseTimestamp(GetParam()).has_value());
}
INSTANTIATE_TEST_SUITE_P(Table,
                         BadTimestamp,
                         ::testing::Values("",
                                           "now",
                                           "1700000000",
                                           "2023-11-14",
                                           "2023-11-14T22:13:20",
                                           "2023-11-14T22:13Z",
                                           "2023-11-14T24:00:00Z",
                                           "2023-11-14T22:60:00Z",
                                           "2023-13-14T22:13:20Z",
                                           "2023-02-29T00:00:00Z",
                                           "2023-11-14T22:13:20.Z",
                                           "2023-11-14T22:13:20+1:00",
                                           "2023-11-14T22:13:20Z ",
                                           "1969-12-31T23:59:59Z",
                                           "1970-01-01T00:00:00+01:00",
                                           "-023-11-14T22:13:20Z"));

}  // namespace
}  // namespace gaitmill::api
