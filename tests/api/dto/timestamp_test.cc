#include "api/dto/timestamp.h"

#include <gtest/gtest.h>

namespace gaitmill::api {
namespace {

TEST(FormatTimestamp, IsUtcWithMilliseconds) {
  EXPECT_EQ(formatTimestamp(0), "1970-01-01T00:00:00.000Z");
  EXPECT_EQ(formatTimestamp(1'700'000'000'007), "2023-11-14T22:13:20.007Z");
}

}  // namespace
}  // namespace gaitmill::api
