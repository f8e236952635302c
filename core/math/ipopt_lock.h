#pragma once

#include <mutex>

namespace gaitmill {

/// Held during every solve of Ipopt: the linear solver behind it keeps process-wide state, so one
/// solve runs at a time in the process, of whatever kind of problem.
std::mutex& ipoptLock();

}  // namespace gaitmill
