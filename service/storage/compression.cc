#include "service/storage/compression.h"

#include <zstd.h>

#include <cstdint>

#include "core/base/error.h"
#include "service/storage/sha256.h"

namespace gaitmill {

namespace {

// zstd's own default: text of numbers to about a third at several hundred MB/s.
constexpr int kLevel = 3;

/// Whether so few bytes can stand for so many: a block of zstd takes three bytes and one more, and
/// holds 128 KiB at most. What a damaged row merely claims is not allocated.
bool isPossible(const PackedBytes& packed) {
  constexpr std::uint64_t kBlock = 128U << 10U;
  const std::uint64_t limit = (packed.bytes.size() / 4 + 1) * kBlock;
  return packed.size >= 0 && static_cast<std::uint64_t>(packed.size) <= limit;
}

std::string decompress(const PackedBytes& packed) {
  if (!isPossible(packed)) {
    return {};
  }
  std::string plain(static_cast<std::size_t>(packed.size), '\0');
  const std::size_t size =
      ZSTD_decompress(plain.data(), plain.size(), packed.bytes.data(), packed.bytes.size());
  return ZSTD_isError(size) != 0 || size != plain.size() ? std::string() : plain;
}

}  // namespace

const char* encodingName(Encoding encoding) {
  return encoding == Encoding::kZstd ? "zstd" : "raw";
}

Encoding findEncoding(std::string_view name) {
  require(name == "zstd" || name == "raw",
          ErrorCode::kStorage,
          "stored bytes have an unknown encoding '" + std::string(name) + "'",
          {"", 0, 0, "encoding"});
  return name == "zstd" ? Encoding::kZstd : Encoding::kRaw;
}

PackedBytes pack(std::string_view plain) {
  PackedBytes packed;
  packed.size = static_cast<std::int64_t>(plain.size());
  packed.sha256 = calcSha256(plain);
  packed.bytes.resize(ZSTD_compressBound(plain.size()));
  const std::size_t size =
      ZSTD_compress(packed.bytes.data(), packed.bytes.size(), plain.data(), plain.size(), kLevel);
  if (ZSTD_isError(size) != 0 || size >= plain.size()) {
    packed.bytes = plain;
    return packed;
  }
  packed.encoding = Encoding::kZstd;
  packed.bytes.resize(size);
  packed.bytes.shrink_to_fit();
  return packed;
}

std::string unpack(const PackedBytes& packed, const std::string& what) {
  std::string plain = packed.encoding == Encoding::kZstd ? decompress(packed) : packed.bytes;
  require(
      static_cast<std::int64_t>(plain.size()) == packed.size && calcSha256(plain) == packed.sha256,
      ErrorCode::kStorage,
      what + " does not have its size and hash any more",
      {"", 0, 0, what});
  return plain;
}

}  // namespace gaitmill
