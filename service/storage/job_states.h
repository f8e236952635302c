#pragma once

#include "api/dto/job.h"

namespace gaitmill {

/// The changes a job may go through. Everything else is refused, whoever asks.
///
///   queued  -> running     a worker claims it
///   queued  -> cancelled   the user, before it began
///   running -> succeeded, failed, cancelled
///
/// A job whose worker stops or dies stays running until somebody claims it again.
bool isAllowedChange(api::JobState from, api::JobState to);

}  // namespace gaitmill
