#include "service/api_key.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

#include "service/storage/ids.h"
#include "service/storage/sha256.h"

namespace gaitmill {
namespace {

std::string swapLetter(std::string text, std::size_t place) {
  text[place] = text[place] == '0' ? '1' : '0';
  return text;
}

std::string makeExampleToken() {
  return makeToken(makeId("key_"), makeSecret().letters);
}

TEST(ApiKey, PresentedTokenMatchesItsHashAndNoOther) {
  const std::string id = makeId("key_");
  const NewSecret secret = makeSecret();
  const auto presented = parseAuthorization("Bearer " + makeToken(id, secret.letters));
  ASSERT_TRUE(presented);
  EXPECT_EQ(presented->id, id);
  EXPECT_TRUE(matchesSecret(presented->secret, secret.sha256));
  EXPECT_FALSE(matchesSecret(presented->secret, makeSecret().sha256));
  EXPECT_FALSE(matchesSecret(presented->secret, ""));
}

TEST(ApiKey, SecretHolds256RandomBitsAndTheHashIsOfThem) {
  std::set<std::string> secrets;
  std::set<char> letters;
  for (int i = 0; i < 200; ++i) {
    const NewSecret secret = makeSecret();
    EXPECT_EQ(secret.letters.size(), 52U);
    EXPECT_EQ(secret.sha256, calcSha256(secret.letters));
    secrets.insert(secret.letters);
    letters.insert(secret.letters.begin(), secret.letters.end());
  }
  EXPECT_EQ(secrets.size(), 200U);
  EXPECT_EQ(letters.size(), 32U);
}

TEST(ApiKey, EveryLetterOfTheSecretCounts) {
  const NewSecret secret = makeSecret();
  for (std::size_t place = 0; place < secret.letters.size(); ++place) {
    EXPECT_FALSE(matchesSecret(swapLetter(secret.letters, place), secret.sha256)) << place;
  }
}

TEST(ApiKey, SchemeIsReadInAnyCase) {
  EXPECT_TRUE(parseAuthorization("bearer " + makeExampleToken()));
  EXPECT_TRUE(parseAuthorization("BEARER " + makeExampleToken()));
}

TEST(ApiKey, AnythingElseIsNoKey) {
  const std::string token = makeExampleToken();
  std::string upper = token;
  upper[40] = 'A';
  std::string joined = token;
  joined[29] = '0';
  for (const std::string& header : {std::string(),
                                    std::string("Bearer"),
                                    std::string("Bearer "),
                                    token,
                                    "Basic " + token,
                                    "Bearer  " + token,
                                    "Bearer " + token + " ",
                                    "Bearer " + token.substr(0, token.size() - 1),
                                    "Bearer gx_" + token.substr(3),
                                    "Bearer " + upper,
                                    "Bearer " + joined,
                                    std::string("Bearer ") + std::string(100'000, '0')}) {
    EXPECT_FALSE(parseAuthorization(header)) << header.substr(0, 100);
  }
}

}  // namespace
}  // namespace gaitmill
