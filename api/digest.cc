#include "api/digest.h"

#include <openssl/evp.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <sstream>

#include "core/base/error.h"

namespace gaitmill::api {

namespace {

constexpr std::size_t kPiece = 1U << 20U;  // [bytes] read at a time

class Hasher {
 public:
  explicit Hasher(const EVP_MD* algorithm) : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    check(context_ != nullptr && EVP_DigestInit_ex(context_.get(), algorithm, nullptr) == 1,
          "the hash cannot be set up");
  }

  void add(const std::string& bytes) {
    check(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1, "hashing failed");
  }

  void add(const ByteSource& source) {
    for (std::uint64_t offset = 0; offset < source.size();) {
      const std::string piece = source.read(offset, kPiece);
      check(!piece.empty(), "a body ends before its size");
      add(piece);
      offset += piece.size();
    }
  }

  std::string finish() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
    unsigned int size = 0;
    check(EVP_DigestFinal_ex(context_.get(), bytes.data(), &size) == 1, "hashing failed");
    return {bytes.begin(), bytes.begin() + size};
  }

 private:
  std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context_;
};

std::string toHex(const std::string& bytes) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string hex;
  for (const char byte : bytes) {
    const auto value = static_cast<unsigned char>(byte);
    hex += kDigits[value / 16U];
    hex += kDigits[value % 16U];
  }
  return hex;
}

std::string toBase64(const std::string& bytes) {
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  const int size = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                                   reinterpret_cast<const unsigned char*>(bytes.data()),
                                   static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(size));
  return text;
}

struct Algorithm {
  const char* name;
  const EVP_MD* (*make)();
};
constexpr std::array<Algorithm, 2> kAlgorithms{{{"sha-256", EVP_sha256}, {"sha-512", EVP_sha512}}};

// "sha-256=:47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU=:", alone or among others.
void checkEntry(const std::string& entry, const HttpRequest& request, int& checked) {
  for (const Algorithm& algorithm : kAlgorithms) {
    if (entry.rfind(std::string(algorithm.name) + "=", 0) != 0) {
      continue;
    }
    Hasher hasher(algorithm.make());
    hasher.add(*request.body);
    const std::string expected =
        std::string(algorithm.name) + "=:" + toBase64(hasher.finish()) + ":";
    require(entry == expected,
            ErrorCode::kRequestDigest,
            "the body that came has the digest " + expected,
            {"", 0, 0, "Content-Digest"});
    ++checked;
  }
}

void addText(Hasher& hasher, const std::string& text) {
  hasher.add(std::to_string(text.size()) + ":" + text);
}

void addSource(Hasher& hasher, const ByteSource& source) {
  hasher.add(std::to_string(source.size()) + ":");
  hasher.add(source);
}

}  // namespace

std::string hashTexts(const std::vector<std::string>& texts) {
  Hasher hasher(EVP_sha256());
  for (const std::string& text : texts) {
    addText(hasher, text);
  }
  return toHex(hasher.finish());
}

std::string hashBytes(const ByteSource& source) {
  Hasher hasher(EVP_sha256());
  hasher.add(source);
  return toHex(hasher.finish());
}

void checkContentDigest(const HttpRequest& request) {
  const std::string& header = request.header("content-digest");
  if (header.empty()) {
    return;
  }
  int checked = 0;
  std::istringstream entries(header);
  std::string entry;
  while (std::getline(entries, entry, ',')) {
    const std::size_t first = entry.find_first_not_of(" \t");
    const std::size_t last = entry.find_last_not_of(" \t");
    if (first != std::string::npos) {
      checkEntry(entry.substr(first, last - first + 1), request, checked);
    }
  }
  require(checked > 0,
          ErrorCode::kRequestDigest,
          "the header must have a digest like sha-256=:BASE64: (or sha-512)",
          {"", 0, 0, "Content-Digest"});
}

std::string hashRequest(const HttpRequest& request) {
  Hasher hasher(EVP_sha256());
  addText(hasher, request.method);
  addText(hasher, request.path);
  for (const auto& [name, value] : request.query) {
    addText(hasher, name);
    addText(hasher, value);
  }
  if (request.parts.empty()) {
    addSource(hasher, *request.body);
  }
  for (const BodyPart& part : request.parts) {
    addText(hasher, part.name);
    addText(hasher, part.file_name);
    addSource(hasher, *part.bytes);
  }
  return toHex(hasher.finish());
}

}  // namespace gaitmill::api
