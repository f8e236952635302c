#include "tests/service/port_fixture.h"

#include <chrono>
#include <utility>

#include "core/base/error.h"
#include "service/job_input.h"
#include "service/storage/table_codec.h"
#include "tests/service/fake_pipeline.h"

namespace gaitmill {

namespace {

FinishedStage makeFinished(const StageOutcome& outcome, std::vector<api::StageTiming> stages) {
  FinishedStage finished;
  finished.stage = stageName(outcome.stage);
  finished.checkpoint = outcome.checkpoint;
  finished.stages = std::move(stages);
  for (const auto& [name, bytes] : outcome.files) {
    finished.results.push_back({ResultKind::kFile, name, bytes, finished.stage});
  }
  for (const auto& [name, table] : outcome.tables) {
    finished.results.push_back({ResultKind::kTime, name, encodeTable(table), finished.stage});
  }
  for (const auto& [name, table] : outcome.cycle_tables) {
    finished.results.push_back({ResultKind::kCycle, name, encodeTable(table), finished.stage});
  }
  return finished;
}

}  // namespace

PortFixture::PortFixture(const Quota& quota) : quota_(quota) {
  folder_.write("models/settings/default.json", "{}");
  folder_.write("models/settings/slow.json", R"({"steps": 20})");
  folder_.write("models/rajagopal2016/rajagopal2016.osim", R"({"markers": [], "bodies": []})");
  folder_.write("models/marker_sets/lab_a.json", R"({"markers": ["RASI", "LASI", "RKNE"]})");
  folder_.write("models/marker_sets/lab_b.json", R"({"markers": ["RASI", "LASI"]})");
  open();
}

void PortFixture::open() {
  DatabaseOptions options;
  options.path = folder_ / "mill.db";
  database_ = std::make_unique<Database>(options);
  stores_ = std::make_unique<Stores>(*database_, "serve:" + std::to_string(++openings_));
  WorkerSignals signals;
  signals.wake = [this] {
    ++woken;
  };
  signals.cancel = [this](const std::string& job_id) {
    cancelled.push_back(job_id);
  };
  PortOptions port_options;
  port_options.models = folder_ / "models";
  port_options.spool_folder = folder_.path();
  port_options.quota = quota_;
  port_options.draw.program = FAKE_SERVICE;
  services_ = std::make_unique<PortServices>(*stores_, makeFakePipeline(), signals, port_options);
}

void PortFixture::reopen() {
  services_.reset();
  stores_.reset();
  database_.reset();
  open();
}

std::string PortFixture::addTrial(const api::Identity& who, const std::string& marker_bytes) {
  return ports().trials.submit(who, makeUpload(marker_bytes)).id;
}

std::string PortFixture::addJob(const api::Identity& who,
                                const std::string& trial_id,
                                const std::string& settings_json) {
  api::JobRequest request;
  request.trial_id = trial_id;
  request.settings_json = settings_json;
  return ports().jobs.submit(who, request).id;
}

JobTicket PortFixture::runNextJob(const std::string& last) {
  const auto job = stores_->jobs.claimNext("test:1", std::chrono::hours(1));
  check(job.has_value(), "no job waits");
  const JobTicket ticket = job->ticket;
  std::vector<api::StageTiming> timings = job->stages;
  PipelineEvents events;
  bool stopped = false;
  events.progress = [&](Stage, double) {
    return !stopped;
  };
  events.stage_done = [&](const StageOutcome& outcome) {
    timings.push_back({stageName(outcome.stage), 1.0, 1.0});
    check(stores_->jobs.saveStage(ticket, makeFinished(outcome, timings)), "the ticket is void");
    stopped = stageName(outcome.stage) == last && last != "cmc";
  };
  const TrialInput input = makeTrialInput(readJobInput(*stores_, services_->shipped(), *job));
  try {
    const PipelineResult result =
        makeFakePipeline().run(input,
                               {"settings", job->settings_json},
                               events,
                               stores_->jobs.readCheckpoints(ticket.job_id));
    check(stores_->jobs.succeed(
              ticket,
              {{ResultKind::kSummary, "summary", result.summary_json, ""},
               {ResultKind::kSummary, "quality", R"({"moments": {"rmse_nm": 0.25}})", ""}},
              "pass"),
          "the ticket is void");
  } catch (const Error& error) {
    check(error.code() == ErrorCode::kCancelled, error.what());
  }
  return ticket;
}

std::string PortFixture::addFinishedJob(const api::Identity& who,
                                        const std::string& settings_json) {
  const std::string id = addJob(who, addTrial(who), settings_json);
  check(runNextJob().job_id == id, "another job was waiting");
  return id;
}

api::Identity makeMember(const std::string& tenant, const std::string& key_id) {
  api::Identity member;
  member.tenant = tenant;
  member.key_id = key_id;
  return member;
}

api::TrialUpload makeUpload(const std::string& marker_bytes) {
  api::TrialUpload upload;
  upload.subject.mass = 75.3;
  upload.subject.height = 1.7;
  upload.files["markers"] = {"walk.trc", api::makeByteSource(marker_bytes)};
  return upload;
}

std::string readSource(const api::ByteSource& source) {
  return api::readAll(source, std::uint64_t{1} << 30U);
}

}  // namespace gaitmill
