#pragma once

#include <cstdint>
#include <string>

#include "core/pipeline/job.h"

namespace gaitmill {

/// Sum over everything that a job's results depend on: settings, input files, subject.
std::uint64_t calcFingerprint(const TrialInput& input, const InputFile& settings);

/// What a stage left in the job, as bytes: its result, its processor seconds and the warnings from
/// `first_warning` on. The rest of the job follows from these (takeOver).
std::string writeCheckpoint(Stage stage, std::size_t first_warning, const Job& job);

/// Puts the result, seconds and warnings of a stage back.
/// @throws Error kCheckpointUnusable if the bytes are damaged, belong to another stage, version of
///   the code, input or settings
void readCheckpoint(Stage stage, const std::string& bytes, Job& job);

}  // namespace gaitmill
