#pragma once

#include <string>
#include <vector>

#include "api/dto/job.h"

namespace gaitmill {

/// A short name for what is made from these texts by this build: 32 hex digits, equal for equal
/// texts and equal code.
std::string makeTag(const std::vector<std::string>& texts);

/// What stands for all results of a job: its provenance if it has succeeded, else the job as it is
/// now, because its stages may have come to other ends than those of an equal job.
std::string identifyResults(const api::JobView& job);

}  // namespace gaitmill
