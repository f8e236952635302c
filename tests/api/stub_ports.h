#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/ports.h"
#include "core/base/error.h"

namespace gaitmill {

inline constexpr const char* kTrialId = "tri_01hf3v6k9e2m8xw7p0q4t5r6s1";
inline constexpr const char* kJobId = "job_01hf3v6k9e2m8xw7p0q4t5r6s1";

/// What the stubs were asked, and what they throw instead of answering.
struct StubRecord {
  std::vector<std::string> calls;
  std::optional<Error> failure;
  api::TrialUpload upload;
  api::JobRequest request;
  std::string options;

  void note(const std::string& call) {
    calls.push_back(call);
    if (failure) {
      throw Error(*failure);
    }
  }
};

inline api::TrialView makeTrialView() {
  api::TrialView trial;
  trial.id = kTrialId;
  trial.created_at = 1'700'000'000'123;
  trial.subject = {75.3, 1.7, "lab_a", R"({"ik":{"end_s":1.0}})"};
  api::UnderstoodFile file;
  file.part = "markers";
  file.name = "walk.trc";
  file.size = 9;
  file.sha256 = std::string(64, 'a');
  file.format = "trc";
  file.frames = 300;
  file.rate = 100.0;
  file.start = 0.0;
  file.end = 2.99;
  file.labels_kind = "markers";
  file.labels = {"RASI", "LASI"};
  trial.files = {file};
  trial.warnings = {"walk.trc: a cut last row"};
  return trial;
}

inline api::JobView makeJobView(api::JobState state) {
  api::JobView job;
  job.id = kJobId;
  job.trial_id = kTrialId;
  job.settings_name = "default";
  job.state = state;
  job.attempt = 1;
  job.submitted_at = 1'700'000'000'000;
  job.started_at = 1'700'000'001'000;
  job.stages = {{"scale", 0.25, 1.0}, {"ik", 1.5, 0.5}};
  return job;
}

class StubTrials : public api::TrialPort {
 public:
  explicit StubTrials(StubRecord& record) : record_(record) {}
  api::TrialView submit(api::TrialUpload upload) override {
    record_.upload = std::move(upload);
    record_.note("submit trial");
    return makeTrialView();
  }
  api::TrialView find(const std::string& trial_id) override {
    record_.note("find trial " + trial_id);
    return makeTrialView();
  }

 private:
  StubRecord& record_;
};

class StubJobs : public api::JobPort {
 public:
  explicit StubJobs(StubRecord& record) : record_(record) {}
  api::JobView submit(const api::JobRequest& request) override {
    record_.request = request;
    record_.note("submit job");
    return makeJobView(api::JobState::kQueued);
  }
  api::JobView find(const std::string& job_id) override {
    record_.note("find job " + job_id);
    return makeJobView(api::JobState::kRunning);
  }
  api::JobView cancel(const std::string& job_id) override {
    record_.note("cancel job " + job_id);
    return makeJobView(api::JobState::kCancelled);
  }

 private:
  StubRecord& record_;
};

class StubResults : public api::ResultPort {
 public:
  explicit StubResults(StubRecord& record) : record_(record) {}
  TimeSeries findTable(const std::string& job_id,
                       const std::string& name,
                       api::TableAxis axis) override {
    record_.note("find table " + job_id + " " + name +
                 (axis == api::TableAxis::kCycle ? " cycle" : " time"));
    TimeSeries table = makeTimeSeries(name, {"hip_flexion_r", "soleus_r"}, {0.0, 0.5});
    table.units = {"rad", ""};
    table.values << 0.5, 0.25, std::numeric_limits<double>::quiet_NaN(), 1.0;
    return table;
  }
  std::string findQuality(const std::string& job_id) override {
    record_.note("find quality " + job_id);
    return R"({"tracking":{"rra":{"max_deg":1.5}}})";
  }
  std::string encodeSto(const TimeSeries& table, api::AngleUnit angles) override {
    return table.name + (angles == api::AngleUnit::kDegrees ? " deg" : " rad");
  }
  std::vector<api::FileView> listFiles(const std::string& job_id) override {
    record_.note("list files " + job_id);
    return {{"ik.mot", 5, std::string(64, 'b')}};
  }
  api::FileContent findFile(const std::string& job_id, const std::string& name) override {
    record_.note("find file " + job_id + " " + name);
    return {{name, 5, std::string(64, 'b')}, "bytes"};
  }

 private:
  StubRecord& record_;
};

/// The three ports on one record.
struct StubPorts {
  StubRecord record;
  StubTrials trials{record};
  StubJobs jobs{record};
  StubResults results{record};

  api::Ports ports() { return {trials, jobs, results}; }
};

}  // namespace gaitmill
