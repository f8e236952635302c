#include "service/byte_cache.h"

#include <string>

#include <gtest/gtest.h>

namespace gaitmill {
namespace {

constexpr std::size_t kKiB = 1024;

TEST(ByteCache, GivesBackWhatWasPutIn) {
  ByteCache cache(100 * kKiB);
  EXPECT_EQ(cache.find("a"), nullptr);
  cache.put("a", {"image/png", "pixels"});
  ASSERT_NE(cache.find("a"), nullptr);
  EXPECT_EQ(cache.find("a")->content_type, "image/png");
  EXPECT_EQ(cache.find("a")->bytes, "pixels");
}

TEST(ByteCache, DropsTheLongestUnused) {
  ByteCache cache(4 * kKiB);
  const std::string bytes(kKiB, 'x');
  for (const char* key : {"a", "b", "c"}) {
    cache.put(key, {"", bytes});
  }
  cache.find("a");
  cache.put("d", {"", bytes});
  EXPECT_NE(cache.find("a"), nullptr);
  EXPECT_EQ(cache.find("b"), nullptr);
  EXPECT_NE(cache.find("d"), nullptr);
}

TEST(ByteCache, StaysWithinItsBytesWhateverComes) {
  ByteCache cache(10 * kKiB);
  for (int i = 0; i < 1000; ++i) {
    cache.put(std::to_string(i % 37), {"t", std::string(static_cast<std::size_t>(i * 7), 'x')});
    ASSERT_LE(cache.size(), 10 * kKiB);
  }
}

TEST(ByteCache, WhatIsTooLargeIsGivenButNotKept) {
  ByteCache cache(kKiB);
  EXPECT_EQ(cache.put("a", {"", std::string(kKiB, 'x')})->bytes.size(), kKiB);
  EXPECT_EQ(cache.find("a"), nullptr);
  EXPECT_EQ(cache.size(), 0U);
}

TEST(ByteCache, ValueOutlivesItsPlace) {
  ByteCache cache(kKiB);
  const ByteCache::Value value = cache.put("a", {"", std::string(500, 'x')});
  cache.put("b", {"", std::string(500, 'y')});
  EXPECT_EQ(cache.find("a"), nullptr);
  EXPECT_EQ(value->bytes, std::string(500, 'x'));
}

}  // namespace
}  // namespace gaitmill
