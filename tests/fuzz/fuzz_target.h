#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace gaitmill {

/// A parser fed with any bytes at all. It may return or throw Error with any code but kInternal;
/// everything else (another exception, a crash, a broken promise) is a fault of ours.
struct FuzzTarget {
  std::string name;  ///< of the corpus folder: tests/fuzz/corpus/<name>
  void (*body)(std::string_view input);
};

/// Those linked into this program: one in a fuzzer, all in the test of the corpus.
const std::vector<FuzzTarget>& fuzzTargets();

/// Adds to fuzzTargets(). @returns true, so that a constant can be initialised with it
bool addFuzzTarget(const char* name, void (*body)(std::string_view input));

/// Runs one parser, taking its refusals for answers.
/// @throws what the parser threw, unless it is an Error about the input
void tryParse(const std::function<void()>& parse);

/// @throws std::logic_error naming the promise unless the parser kept it
void requirePromise(bool kept, const char* promise);

}  // namespace gaitmill

/// GAITMILL_FUZZ_TARGET(trc) { readTrc(input, "fuzz.trc"); }
#define GAITMILL_FUZZ_TARGET(name)                                                           \
  static void name##FuzzBody(std::string_view input);                                        \
  [[maybe_unused]] static const bool name##_is_added = addFuzzTarget(#name, name##FuzzBody); \
  static void name##FuzzBody(std::string_view input)
