#include "tests/fuzz/fuzz_target.h"

#include <stdexcept>

#include "core/base/error.h"

namespace gaitmill {

namespace {

std::vector<FuzzTarget>& targets() {
  static std::vector<FuzzTarget> list;
  return list;
}

}  // namespace

const std::vector<FuzzTarget>& fuzzTargets() {
  return targets();
}

bool addFuzzTarget(const char* name, void (*body)(std::string_view input)) {
  targets().push_back({name, body});
  return true;
}

void tryParse(const std::function<void()>& parse) {
  try {
    parse();
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kInternal) {
      throw;
    }
  }
}

void requirePromise(bool kept, const char* promise) {
  if (!kept) {
    throw std::logic_error(promise);
  }
}

}  // namespace gaitmill
