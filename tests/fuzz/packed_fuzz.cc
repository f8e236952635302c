#include <cstdint>
#include <string>

#include "service/storage/compression.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {

// A compressed row of a damaged database; the first byte says how large it claims to be.
GAITMILL_FUZZ_TARGET(packed) {
  // A few bytes may rightly stand for a lot: 128 KiB for every four.
  constexpr std::size_t kMostBytes = 2048;
  if (input.empty() || input.size() > kMostBytes) {
    return;
  }
  PackedBytes packed;
  packed.encoding = Encoding::kZstd;
  packed.size = std::int64_t{1} << (static_cast<unsigned char>(input.front()) % 64U);
  packed.bytes = std::string(input.substr(1));
  tryParse([&] { unpack(packed, "fuzz"); });
  const PackedBytes good = pack(input);
  requirePromise(unpack(good, "fuzz") == input, "what was packed comes back");
}

}  // namespace gaitmill
