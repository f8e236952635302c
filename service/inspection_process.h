#pragma once

#include <chrono>
#include <cstdint>

#include "service/pipeline_functions.h"
#include "service/process/child.h"

namespace gaitmill {

struct InspectionLimits {
  std::uint64_t in_process = 8U << 20U;  ///< [bytes] of all parts together that are read in-process
  std::chrono::milliseconds silence{120'000};  ///< a child may read without an answer
  ChildLimits child;
};

/// An inspector that reads small uploads itself and has a child process read larger ones, so that
/// the memory of the service stays flat whatever is uploaded. A child that dies over an upload
/// refuses it (Error kFileFormat, or kFileTooLarge when it was out of memory); the service lives.
TrialInspector inspectLargeInChild(ChildCommand command,
                                   TrialInspector in_process,
                                   InspectionLimits limits);

}  // namespace gaitmill
