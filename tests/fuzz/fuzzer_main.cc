// The entry that libFuzzer calls: one target per program. What a target throws ends the process,
// which libFuzzer reports together with the input.

#include <cstddef>
#include <cstdint>

#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const gaitmill::FuzzTarget& target = gaitmill::fuzzTargets().front();
  gaitmill::tryParse([&] { target.body(input); });
  return 0;
}
