#include "core/math/ipopt_lock.h"

namespace gaitmill {

std::mutex& ipoptLock() {
  static std::mutex one_at_a_time;
  return one_at_a_time;
}

}  // namespace gaitmill
