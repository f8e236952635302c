#include "service/api_key.h"

#include <openssl/crypto.h>
#include <openssl/rand.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <string_view>

#include "core/base/error.h"
#include "service/storage/sha256.h"

namespace gaitmill {

namespace {

constexpr std::string_view kAlphabet = "0123456789abcdefghjkmnpqrstvwxyz";
constexpr std::string_view kIdPrefix = "key_";
constexpr std::string_view kTokenPrefix = "gm_";
constexpr std::size_t kIdLetters = 26;
constexpr std::size_t kSecretBits = 256;
constexpr std::size_t kSecretLetters = 52;  // of five bits each

// The bits in order, five to a letter; the last letter carries one.
std::string encodeBase32(const std::array<unsigned char, kSecretBits / 8>& bytes) {
  std::string letters;
  unsigned int window = 0;
  unsigned int bits = 0;
  for (const unsigned char byte : bytes) {
    window = (window << 8U | byte) & 0xfffU;
    for (bits += 8; bits >= 5; bits -= 5) {
      letters += kAlphabet[(window >> (bits - 5)) % 32U];
    }
  }
  letters += kAlphabet[(window << (5 - bits)) % 32U];
  return letters;
}

std::string drawSecret() {
  std::array<unsigned char, kSecretBits / 8> bytes{};
  check(RAND_bytes(bytes.data(), static_cast<int>(bytes.size())) == 1, "no random bytes");
  return encodeBase32(bytes);
}

bool isBase32(std::string_view text) {
  return text.find_first_not_of(kAlphabet) == std::string_view::npos;
}

bool startsWithoutCase(std::string_view text, std::string_view lower_case_start) {
  return text.size() >= lower_case_start.size() &&
         std::equal(
             lower_case_start.begin(), lower_case_start.end(), text.begin(), [](char a, char b) {
               return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b)));
             });
}

}  // namespace

NewSecret makeSecret() {
  const std::string letters = drawSecret();
  return {letters, calcSha256(letters)};
}

std::string makeToken(const std::string& key_id, const std::string& secret) {
  return std::string(kTokenPrefix) + key_id.substr(kIdPrefix.size()) + "_" + secret;
}

std::optional<PresentedKey> parseAuthorization(const std::string& header) {
  constexpr std::string_view kScheme = "bearer ";
  if (!startsWithoutCase(header, kScheme)) {
    return std::nullopt;
  }
  const std::string_view token = std::string_view(header).substr(kScheme.size());
  const std::size_t id_begins = kTokenPrefix.size();
  const std::size_t secret_begins = id_begins + kIdLetters + 1;
  if (token.size() != secret_begins + kSecretLetters ||
      token.substr(0, id_begins) != kTokenPrefix || token[secret_begins - 1] != '_') {
    return std::nullopt;
  }
  const std::string_view id = token.substr(id_begins, kIdLetters);
  const std::string_view secret = token.substr(secret_begins);
  if (!isBase32(id) || !isBase32(secret)) {
    return std::nullopt;
  }
  return PresentedKey{std::string(kIdPrefix) + std::string(id), std::string(secret)};
}

bool matchesSecret(const std::string& secret, const std::string& secret_sha256) {
  const std::string hash = calcSha256(secret);
  return hash.size() == secret_sha256.size() &&
         CRYPTO_memcmp(hash.data(), secret_sha256.data(), hash.size()) == 0;
}

}  // namespace gaitmill
