#include "api/dto/job.h"

#include <algorithm>
#include <array>
#include <utility>

#include <nlohmann/json.hpp>

#include "api/dto/object_reader.h"
#include "api/dto/timestamp.h"
#include "core/base/error.h"

namespace gaitmill::api {

namespace {

using nlohmann::json;

constexpr std::array<std::pair<JobState, const char*>, 5> kStateNames{
    {{JobState::kQueued, "queued"},
     {JobState::kRunning, "running"},
     {JobState::kSucceeded, "succeeded"},
     {JobState::kFailed, "failed"},
     {JobState::kCancelled, "cancelled"}}};

// Share of a whole job that lies before a stage begins, and the stage's own share: rounded from the
// published cost of the stages (RRA 40 s per pass against eight minutes of CMC). For display only.
struct StageShare {
  const char* stage;
  double before;
  double own;
};
constexpr std::array<StageShare, 6> kStageShares{{{"scale", 0.00, 0.02},
                                                  {"ik", 0.02, 0.08},
                                                  {"rra", 0.10, 0.20},
                                                  {"id", 0.30, 0.02},
                                                  {"so", 0.32, 0.08},
                                                  {"cmc", 0.40, 0.60}}};

json timestampOrNull(const std::optional<std::int64_t>& time) {
  return time ? json(formatTimestamp(*time)) : json(nullptr);
}

json toJson(const std::vector<StageTiming>& stages) {
  json list = json::array();
  for (const StageTiming& stage : stages) {
    list.push_back(
        {{"stage", stage.stage}, {"seconds", stage.seconds}, {"progress", stage.fraction}});
  }
  return list;
}

json textOrNull(const std::string& text) {
  return text.empty() ? json(nullptr) : json(text);
}

}  // namespace

const char* jobStateName(JobState state) {
  for (const auto& [value, name] : kStateNames) {
    if (value == state) {
      return name;
    }
  }
  throw Error(ErrorCode::kInternal, "job state without a name");
}

JobState findJobState(const std::string& name) {
  for (const auto& [value, word] : kStateNames) {
    if (name == word) {
      return value;
    }
  }
  throw Error(ErrorCode::kInternal, "no job state is called '" + name + "'");
}

bool isFinal(JobState state) {
  return state != JobState::kQueued && state != JobState::kRunning;
}

void putSettings(const json* settings, JobRequest& request) {
  if (settings == nullptr) {
    request.settings_name = "default";
  } else if (settings->is_object()) {
    request.settings_json = dumpJson(*settings);
  } else {
    request.settings_name = toText(*settings, "settings");
  }
}

JobRequest parseJobRequest(const std::string& text) {
  const json object = parseJson(text, "job");
  ObjectReader reader(object, "job");
  JobRequest request;
  request.trial_id = reader.text("trial");
  putSettings(reader.value("settings"), request);
  request.label = reader.optionalText("label").value_or("");
  request.model_id = reader.optionalText("model").value_or("");
  reader.finish();
  return request;
}

double calcJobProgress(const JobView& job) {
  if (job.state == JobState::kSucceeded) {
    return 1.0;
  }
  double progress = 0.0;
  for (const StageTiming& stage : job.stages) {
    for (const StageShare& share : kStageShares) {
      if (stage.stage == share.stage) {
        progress = std::max(progress, share.before + share.own * stage.fraction);
      }
    }
  }
  return progress;
}

std::string renderJob(const JobView& job) {
  json object{{"id", job.id},
              {"trial", job.trial_id},
              {"study", textOrNull(job.study_id)},
              {"model", textOrNull(job.model_id)},
              {"subject", textOrNull(job.subject)},
              {"label", textOrNull(job.label)},
              {"settings", textOrNull(job.settings_name)},
              {"state", jobStateName(job.state)},
              {"stage", nullptr},
              {"progress", calcJobProgress(job)},
              {"queue_position", nullptr},
              {"seconds_left", nullptr},
              {"attempt", job.attempt},
              {"cancel_requested", job.cancel_requested},
              {"stages", toJson(job.stages)},
              {"submitted_at", formatTimestamp(job.submitted_at)},
              {"started_at", timestampOrNull(job.started_at)},
              {"finished_at", timestampOrNull(job.finished_at)},
              {"warnings", job.warnings},
              {"verdict", textOrNull(job.verdict)},
              {"provenance", textOrNull(job.provenance)},
              {"error", nullptr}};
  if (job.state == JobState::kRunning && !job.stages.empty()) {
    object["stage"] = job.stages.back().stage;
  }
  if (job.jobs_ahead) {
    object["queue_position"] = *job.jobs_ahead + 1;
  }
  if (job.seconds_left) {
    object["seconds_left"] = *job.seconds_left;
  }
  if (job.error) {
    object["error"] = json::parse(*job.error);
  }
  if (!job.settings_json.empty()) {
    object["settings_document"] = json::parse(job.settings_json);
  }
  return dumpJson(object);
}

}  // namespace gaitmill::api
