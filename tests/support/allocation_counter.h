#pragma once

namespace gaitmill {

/// Number of heap allocations of this thread since its start: malloc and its relatives, so that
/// Eigen's are seen as well as those of operator new. Always 0 under a sanitizer, which owns
/// malloc.
long countAllocations();

/// Runs `action` and returns how often it allocated.
template <class Action>
long countAllocationsOf(Action&& action) {
  const long before = countAllocations();
  action();
  return countAllocations() - before;
}

}  // namespace gaitmill
