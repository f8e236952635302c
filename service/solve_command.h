#pragma once

#include <sys/types.h>

#include <string>

#include "service/pipeline_functions.h"
#include "service/process/child.h"

namespace gaitmill {

/// How the service starts this program as its own child.
struct ChildOptions {
  enum class Task { kSolve, kInspect, kDraw };
  Task task = Task::kSolve;
  pid_t parent = -1;
  ChildLimits limits;
  std::string models;    ///< folder
  std::string geometry;  ///< folder of meshes, for kDraw; empty = none
};

/// The child's side of solveInChild(), inspectInChild() and DrawProcess: takes the limits upon
/// itself, reads what there is to do from the channel, does it and tells; one that draws goes on
/// with the next task. Whatever goes wrong is told as an error.
/// @returns the exit code of the process
int runChild(const ChildOptions& options, const PipelineFunctions& functions);

}  // namespace gaitmill
