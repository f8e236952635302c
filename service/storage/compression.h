#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gaitmill {

enum class Encoding { kRaw, kZstd };
/// "raw", "zstd"
const char* encodingName(Encoding encoding);
/// @throws Error kStorage for another word
Encoding findEncoding(std::string_view name);

/// Bytes as they are stored, with what it takes to verify them.
struct PackedBytes {
  Encoding encoding = Encoding::kRaw;
  std::int64_t size = 0;  ///< [bytes] of the plain text
  std::string sha256;     ///< hex, of the plain text
  std::string bytes;
};

/// Compresses with zstd where that makes the bytes smaller.
PackedBytes pack(std::string_view plain);

/// The plain bytes again, checked against size and hash.
/// @param what  for the message: "result 'moments'"
/// @throws Error kStorage if they are not what was packed
std::string unpack(const PackedBytes& packed, const std::string& what);

}  // namespace gaitmill
