#include "service/storage/sha256.h"

#include <gtest/gtest.h>

namespace gaitmill {
namespace {

// FIPS 180-4, examples for SHA-256.
TEST(CalcSha256, MatchesTheStandard) {
  EXPECT_EQ(calcSha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(calcSha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(Sha256, PiecesGiveTheHashOfTheWhole) {
  Sha256 hash;
  hash.update("a");
  hash.update("");
  hash.update("bc");
  EXPECT_EQ(hash.finish(), calcSha256("abc"));
  EXPECT_EQ(Sha256().finish(), calcSha256(""));
}

}  // namespace
}  // namespace gaitmill
