#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace gaitmill::api {

enum class JobState { kQueued, kRunning, kSucceeded, kFailed, kCancelled };
/// "queued", "running", "succeeded", "failed", "cancelled"
const char* jobStateName(JobState state);
/// @throws Error kInternal for another word
JobState findJobState(const std::string& name);
/// Succeeded, failed and cancelled jobs never change again.
bool isFinal(JobState state);

/// {"trial": "tri_…", "settings": "paper_walk"} or {"trial", "settings": {…}}; without settings the
/// name is "default". "label" and "model" ("mod_…", replaces the trial's model part) may be absent.
struct JobRequest {
  std::string trial_id;
  std::string settings_name;  ///< one of models/settings, or empty
  std::string settings_json;  ///< a settings document, or empty
  std::string label;
  std::string model_id;        ///< empty = the trial's own model, or the one that ships
  std::string submission_key;  ///< not of the document: the request's Idempotency-Key, or empty
};

/// How long one stage has taken, wall-clock [s]; of the attempt that finished it.
struct StageTiming {
  std::string stage;
  double seconds = 0;   ///< [s]
  double fraction = 0;  ///< done, in [0, 1]
};

struct JobView {
  std::string id;
  std::string trial_id;
  std::string study_id;  ///< empty if submitted alone
  std::string model_id;  ///< empty if none was named
  std::string label;
  std::string subject;        ///< of the trial
  std::string settings_name;  ///< empty if the job brought its own document
  std::string settings_json;  ///< the whole document the job runs with; empty in lists
  JobState state = JobState::kQueued;
  std::int64_t version = 0;  ///< grows with every change that the view shows: the ETag
  int attempt = 0;           ///< 0 before the first
  bool cancel_requested = false;
  std::vector<StageTiming> stages;          ///< those begun so far, in order
  std::int64_t submitted_at = 0;            ///< [ms since 1970 UTC]
  std::optional<std::int64_t> started_at;   ///< of the first attempt
  std::optional<std::int64_t> finished_at;  ///<
  std::optional<std::int64_t> jobs_ahead;   ///< while queued
  std::optional<double> seconds_left;       ///< [s] estimated; absent when final or unknown
  std::vector<std::string> warnings;        ///<
  std::string verdict;     ///< "pass", "warn" or "fail" when the job has succeeded, else empty
  std::string provenance;  ///< SHA-256 over inputs, model, settings and code version, hex
  std::optional<std::string> error;  ///< JSON problem object as by renderProblemObject, if failed
};

/// One step of a job's life, for server-sent events.
struct JobEvent {
  std::int64_t id = 0;  ///< ascends within a job: the Last-Event-ID
  std::int64_t at = 0;  ///< [ms since 1970 UTC]
  std::string kind;     ///< "state", "stage", "progress", "warning"
  std::string data;     ///< JSON object
};

/// @throws Error kRequestMalformed, kRequestField naming the field
JobRequest parseJobRequest(const std::string& json);
/// The settings of a request: a name, a document, or nothing for "default".
/// @throws Error kRequestField for any other kind of value
void putSettings(const nlohmann::json* settings, JobRequest& request);

std::string renderJob(const JobView& job);

/// Part of the whole job that is done, in [0, 1], from its stages' usual shares of the time.
double calcJobProgress(const JobView& job);

}  // namespace gaitmill::api
