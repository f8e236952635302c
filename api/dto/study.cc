#include "api/dto/study.h"

#include <algorithm>
#include <cstddef>
#include <map>

#include <nlohmann/json.hpp>

#include "api/dto/csv.h"
#include "api/dto/object_reader.h"
#include "api/dto/page.h"
#include "api/dto/result.h"
#include "api/dto/timestamp.h"
#include "core/base/error.h"

namespace gaitmill::api {

namespace {

using nlohmann::json;

// Jobs of one study: a day's recordings of a lab; keeps one submission one short transaction.
constexpr std::size_t kMaxJobs = 1000;

std::vector<std::string> readTrials(ObjectReader& reader) {
  const json* trials = reader.value("trials");
  require(trials != nullptr && trials->is_array() && !trials->empty(),
          ErrorCode::kRequestField,
          "field 'trials' must be a list of at least one trial",
          {"", 0, 0, "study.trials"});
  std::vector<std::string> ids;
  for (const json& trial : *trials) {
    const std::string id = toText(trial, "study.trials");
    require(std::find(ids.begin(), ids.end(), id) == ids.end(),
            ErrorCode::kRequestField,
            "trial '" + id + "' is there twice",
            {"", 0, 0, "study.trials"});
    ids.push_back(id);
  }
  return ids;
}

// A name or a document alone is a list of one; nothing is the default settings.
json readSettings(ObjectReader& reader) {
  const json* settings = reader.value("settings");
  if (settings == nullptr) {
    return json::array({"default"});
  }
  require(!settings->is_array() || !settings->empty(),
          ErrorCode::kRequestField,
          "field 'settings' must have at least one name or document",
          {"", 0, 0, "study.settings"});
  return settings->is_array() ? *settings : json::array({*settings});
}

int countJobs(const StudyView& study, const char* state) {
  const auto found = study.jobs.find(state);
  return found == study.jobs.end() ? 0 : found->second;
}

json textOrNull(const std::string& text) {
  return text.empty() ? json(nullptr) : json(text);
}

std::string settingsWord(const JobView& job) {
  return job.settings_name.empty() ? "document" : job.settings_name;
}

json toJson(const StudyRow& row) {
  const JobView& job = row.job;
  json object{{"job", job.id},
              {"trial", job.trial_id},
              {"subject", textOrNull(job.subject)},
              {"label", textOrNull(job.label)},
              {"settings", textOrNull(job.settings_name)},
              {"state", jobStateName(job.state)},
              {"verdict", textOrNull(job.verdict)},
              {"quality", nullptr}};
  if (!row.quality_json.empty()) {
    object["quality"] = json::parse(row.quality_json);
  }
  return object;
}

// Quantities of all rows, each once, in the order of first appearance.
std::vector<std::string> listColumns(const std::vector<Quantities>& rows) {
  std::vector<std::string> columns;
  for (const Quantities& row : rows) {
    for (const auto& [name, value] : row) {
      if (std::find(columns.begin(), columns.end(), name) == columns.end()) {
        columns.push_back(name);
      }
    }
  }
  return columns;
}

void appendRow(std::string& out,
               const JobView& job,
               const Quantities& quantities,
               const std::vector<std::string>& columns) {
  out += job.id + "," + job.trial_id + "," + quoteUserCsv(job.subject) + "," +
         quoteUserCsv(job.label) + "," + quoteUserCsv(settingsWord(job)) + "," +
         jobStateName(job.state) + "," + job.verdict;
  const std::map<std::string, double> values(quantities.begin(), quantities.end());
  for (const std::string& column : columns) {
    out += ',';
    const auto found = values.find(column);
    if (found != values.end()) {
      appendNumber(out, found->second);
    }
  }
  out += '\n';
}

}  // namespace

StudyRequest parseStudyRequest(const std::string& text) {
  const json object = parseJson(text, "study");
  ObjectReader reader(object, "study");
  StudyRequest request;
  request.name = reader.text("name");
  const std::vector<std::string> trials = readTrials(reader);
  const json settings = readSettings(reader);
  JobRequest job;
  job.label = reader.optionalText("label").value_or("");
  job.model_id = reader.optionalText("model").value_or("");
  reader.finish();
  require(trials.size() * settings.size() <= kMaxJobs,
          ErrorCode::kRequestField,
          "trials times settings make " + std::to_string(trials.size() * settings.size()) +
              " jobs, more than " + std::to_string(kMaxJobs),
          {"", 0, 0, "study.trials"});
  for (const std::string& trial : trials) {
    for (const json& entry : settings) {
      job.trial_id = trial;
      job.settings_name.clear();
      job.settings_json.clear();
      putSettings(&entry, job);
      request.jobs.push_back(job);
    }
  }
  return request;
}

std::string renderStudy(const StudyView& study) {
  const int unfinished = countJobs(study, "queued") + countJobs(study, "running");
  json counts = json::object();
  for (const char* state : {"queued", "running", "succeeded", "failed", "cancelled"}) {
    counts[state] = countJobs(study, state);
  }
  return dumpJson({{"id", study.id},
                   {"name", study.name},
                   {"created_at", formatTimestamp(study.created_at)},
                   {"finished", unfinished == 0},
                   {"progress", study.progress},
                   {"job_counts", counts},
                   {"jobs", study.job_ids}});
}

std::string renderStudyTable(const std::vector<StudyRow>& rows) {
  std::vector<std::string> items;
  items.reserve(rows.size());
  for (const StudyRow& row : rows) {
    items.push_back(dumpJson(toJson(row)));
  }
  return renderPage(items, "");
}

std::string renderStudyTableCsv(const std::vector<StudyRow>& rows) {
  std::vector<Quantities> quantities;
  quantities.reserve(rows.size());
  for (const StudyRow& row : rows) {
    quantities.push_back(row.quality_json.empty() ? Quantities{}
                                                  : listQuantities(row.quality_json));
  }
  const std::vector<std::string> columns = listColumns(quantities);
  std::string out = "job,trial,subject,label,settings,state,verdict";
  for (const std::string& column : columns) {
    out += "," + quoteCsv(column);
  }
  out += '\n';
  for (std::size_t i = 0; i < rows.size(); ++i) {
    appendRow(out, rows[i].job, quantities[i], columns);
  }
  return out;
}

}  // namespace gaitmill::api
