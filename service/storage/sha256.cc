#include "service/storage/sha256.h"

#include <openssl/evp.h>

#include <array>

#include "core/base/error.h"

namespace gaitmill {

std::string calcSha256(const std::string& bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  const int ok =
      EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr);
  check(ok == 1 && size == 32, "SHA-256 is not available");
  static constexpr std::array<char, 17> kDigits = {"0123456789abcdef"};
  std::string hex;
  for (unsigned int i = 0; i < size; ++i) {
    hex += kDigits[digest[i] / 16U];
    hex += kDigits[digest[i] % 16U];
  }
  return hex;
}

}  // namespace gaitmill
