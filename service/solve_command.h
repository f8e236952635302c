#pragma once

#include <sys/types.h>

#include <string>

#include "service/pipeline_functions.h"
#include "service/process/child.h"

namespace gaitmill {

/// How the service starts this program as its own child.
struct ChildOptions {
  enum class Task { kSolve, kInspect };
  Task task = Task::kSolve;
  pid_t parent = -1;
  ChildLimits limits;
  std::string models;  ///< folder
};

/// The child's side of solveInChild() and inspectInChild(): takes the limits upon itself, reads
/// what there is to do from the channel, does it and tells. Whatever goes wrong is told as an
/// error.
/// @returns the exit code of the process
int runChild(const ChildOptions& options, const PipelineFunctions& functions);

}  // namespace gaitmill
