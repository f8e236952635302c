#pragma once

#include "api/dto/trial.h"

namespace gaitmill {

/// Reads every file of an upload and says what it holds: frames, rate, time range, units and
/// markers of TRC files; force plates, contacts and the foot of each of ground reactions, and the
/// gait events they make; columns of other tables; muscles of a model. Fills `files` in the order
/// of api::trialParts(), without hashes and marker sets, `events` and `warnings`. Forces that can
/// be read but are not what a job expects (no force reaches the threshold) are a warning: settings
/// may leave their plate out.
/// @throws Error of the reader that refuses a file, with the part as context
api::TrialView inspectTrial(const api::TrialUpload& upload);

}  // namespace gaitmill
