#pragma once

#include <chrono>
#include <cstdint>

namespace gaitmill {

/// Wall clock [ms since 1970 UTC].
inline std::int64_t nowMilliseconds() {
  using std::chrono::duration_cast;
  using std::chrono::milliseconds;
  using std::chrono::system_clock;
  return duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
}

}  // namespace gaitmill
