#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gaitmill::api {

enum class JobState { kQueued, kRunning, kSucceeded, kFailed, kCancelled };
/// "queued", "running", "succeeded", "failed", "cancelled"
const char* jobStateName(JobState state);
/// @throws Error kInternal for another word
JobState findJobState(const std::string& name);
/// Succeeded, failed and cancelled jobs never change again.
bool isFinal(JobState state);

/// {"trial": "tri_…", "settings": "paper_walk"} or {"trial", "settings": {…}}; without settings the
/// name is "default".
struct JobRequest {
  std::string trial_id;
  std::string settings_name;  ///< one of models/settings, or empty
  std::string settings_json;  ///< a settings document, or empty
};

/// How long one stage has taken, wall-clock [s]; of the last attempt.
struct StageTiming {
  std::string stage;
  double seconds = 0;   ///< [s]
  double fraction = 0;  ///< done, in [0, 1]
};

struct JobView {
  std::string id;
  std::string trial_id;
  std::string settings_name;  ///< empty if the job brought its own document
  JobState state = JobState::kQueued;
  int attempt = 0;  ///< 0 before the first
  bool cancel_requested = false;
  std::vector<StageTiming> stages;          ///< those begun so far, in order
  std::int64_t submitted_at = 0;            ///< [ms since 1970 UTC]
  std::optional<std::int64_t> started_at;   ///< of the last attempt
  std::optional<std::int64_t> finished_at;  ///<
  std::optional<std::int64_t> jobs_ahead;   ///< while queued
  std::vector<std::string> warnings;        ///<
  std::optional<std::string> error;         ///< JSON object as by renderErrorObject, if failed
};

/// @throws Error kRequestMalformed, kRequestField naming the field
JobRequest parseJobRequest(const std::string& json);

std::string renderJob(const JobView& job);

/// Part of the whole job that is done, in [0, 1], from its stages' usual shares of the time.
double calcJobProgress(const JobView& job);

}  // namespace gaitmill::api
