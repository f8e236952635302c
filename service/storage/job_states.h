#pragma once

#include "api/dto/job.h"

namespace gaitmill {

/// The changes a job may go through. Everything else is refused, whoever asks.
///
///   queued  -> running     a worker claims it
///   queued  -> cancelled   the user, before it began
///   running -> succeeded, failed, cancelled
///   running -> queued      the service stops or has died
bool isAllowedChange(api::JobState from, api::JobState to);

}  // namespace gaitmill
