#pragma once

#include <functional>

namespace gaitmill {

/// Called by long computations with the finished fraction in [0, 1] of their own work. Returns
/// false to ask the computation to stop; it then throws Error{kCancelled}. May be empty. Called
/// from the computing thread, often; must return quickly.
using Progress = std::function<bool(double fraction)>;

/// Reports to `progress` if there is one. @throws Error kCancelled if it asks to stop
void reportProgress(const Progress& progress, double fraction);

}  // namespace gaitmill
