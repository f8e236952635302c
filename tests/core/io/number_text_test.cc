#include "core/io/number_text.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace gaitmill {
namespace {

TEST(NumberText, ReadsTheSpellingsOfRealFiles) {
  EXPECT_EQ(parseNumber("1e-005"), 1e-5);
  EXPECT_EQ(parseNumber("+2.5"), 2.5);
  EXPECT_EQ(parseNumber("-.5"), -0.5);
  EXPECT_EQ(parseNumber("5."), 5.0);
  EXPECT_EQ(parseNumber("-Infinity"), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(parseNumber("Inf"), std::numeric_limits<double>::infinity());
  for (const char* missing : {"nan", "NaN", "NAN", "-nan", "1.#QNAN", "-1.#IND", "1.#IND00"}) {
    ASSERT_TRUE(parseNumber(missing).has_value()) << missing;
    EXPECT_TRUE(std::isnan(*parseNumber(missing))) << missing;
  }
  EXPECT_EQ(parseNumber("1e-400"), 0.0) << "underflow";
}

TEST(NumberText, RefusesWhatIsNoNumber) {
  for (const char* token :
       {"", "-", "+", "+-1", "1,5", "1.2.3", "0x10", "1e", "12a", "1e999", "nanx"}) {
    EXPECT_FALSE(parseNumber(token).has_value()) << token;
  }
}

TEST(NumberText, EveryDoubleReadsBack) {
  std::mt19937_64 generator(11);
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t bits = generator();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value)) {
      EXPECT_EQ(parseNumber(formatNumber(value)), value);
    }
  }
  EXPECT_EQ(formatNumber(0.1), "0.1");
  EXPECT_EQ(formatNumber(-std::numeric_limits<double>::infinity()), "-Inf");
}

TEST(NumberText, BooleansInAnySpelling) {
  EXPECT_EQ(parseBoolean("TRUE"), true);
  EXPECT_EQ(parseBoolean("no"), false);
  EXPECT_FALSE(parseBoolean("maybe").has_value());
}

}  // namespace
}  // namespace gaitmill
