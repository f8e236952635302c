#pragma once

#include "api/dto/trial.h"

namespace gaitmill {

/// Reads every file of an upload and says what it holds: frames, rate, time range and markers of
/// TRC files; rows and force plates of ground reactions; columns of other tables; muscles of a
/// model. Fills `files` in the order of api::trialParts(), without hashes, and `warnings`.
/// @throws Error of the reader that refuses a file, with the part as context
api::TrialView inspectTrial(const api::TrialUpload& upload);

}  // namespace gaitmill
