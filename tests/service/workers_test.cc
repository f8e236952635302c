// The workers over a real database, with real child processes that run the fake pipeline.

#include "service/workers.h"

#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "service/observe/log.h"
#include "tests/service/port_fixture.h"

namespace gaitmill {
namespace {

using nlohmann::json;
using State = api::JobState;
using std::chrono::milliseconds;

class WorkersTest : public ::testing::Test {
 protected:
  WorkersTest() {
    setUpLog("off");
    declareJobMetrics(metrics_);
    trial_ = fixture_.addTrial(who_);
    options_.look_around = milliseconds(20);
    options_.runs.owner = "serve:test";
    options_.runs.solver = {FAKE_SERVICE, "solve", "--models", "models"};
    options_.runs.limits.tick = milliseconds(20);
  }

  void start(int count = 1) {
    options_.count = count;
    workers_ = std::make_unique<Workers>(
        fixture_.stores(), fixture_.services().shipped(), metrics_, options_);
    workers_->start();
  }
  std::string submit(const json& settings) {
    return fixture_.addJob(who_, trial_, settings.dump());
  }
  api::JobView find(const std::string& id) { return fixture_.stores().jobs.find(who_.tenant, id); }

  template <class Condition>
  api::JobView waitUntil(const std::string& id, Condition condition) {
    for (int i = 0; i < 20'000 && !condition(find(id)); ++i) {
      std::this_thread::sleep_for(milliseconds(1));
    }
    return find(id);
  }
  api::JobView waitForEnd(const std::string& id) {
    return waitUntil(id, [](const api::JobView& job) { return api::isFinal(job.state); });
  }
  std::string codeOf(const api::JobView& job) {
    return json::parse(job.error.value_or("{}")).value("code", "");
  }

  PortFixture fixture_;
  api::Identity who_ = makeMember("local");
  Metrics metrics_;
  WorkersOptions options_;
  std::string trial_;
  std::unique_ptr<Workers> workers_;
};

TEST_F(WorkersTest, TakeJobsFromBeforeAndAfterTheStart) {
  const std::string before = submit(json::object());
  start(2);
  EXPECT_EQ(waitForEnd(before).state, State::kSucceeded);
  const std::string after = submit({{"warn", "a sentence"}});
  workers_->wake();
  const api::JobView job = waitForEnd(after);
  EXPECT_EQ(job.state, State::kSucceeded);
  EXPECT_EQ(job.warnings, std::vector<std::string>{"a sentence"});
  EXPECT_EQ(job.stages.size(), 6U);
  EXPECT_EQ(job.verdict, "warn");
}

TEST_F(WorkersTest, FailedStageSaysWhere) {
  const std::string id = submit({{"fail_at", "rra"}});
  start();
  const api::JobView job = waitForEnd(id);
  EXPECT_EQ(job.state, State::kFailed);
  EXPECT_EQ(codeOf(job), "input.markers");
  EXPECT_EQ(json::parse(*job.error)["where"]["line"], 7);
}

// The third death in the same stage fails the job; its neighbour never notices.
TEST_F(WorkersTest, JobThatKillsItsSolverFailsAfterThreeDeathsAlone) {
  const std::string deadly = submit({{"crash_at", "so"}});
  const std::string neighbour = submit(json::object());
  start();
  const api::JobView job = waitForEnd(deadly);
  EXPECT_EQ(job.state, State::kFailed);
  EXPECT_EQ(codeOf(job), "job.crashed");
  EXPECT_EQ(job.attempt, 3);
  EXPECT_NE(job.error->find("SIGKILL"), std::string::npos) << *job.error;
  EXPECT_EQ(waitForEnd(neighbour).state, State::kSucceeded);
  EXPECT_EQ(find(neighbour).attempt, 1);
}

TEST_F(WorkersTest, SilentSolverIsTakenForDead) {
  options_.runs.limits.silence = milliseconds(200);
  const std::string id = submit({{"steps", 1}, {"step_ms", 600'000}});
  start();
  const api::JobView job = waitForEnd(id);
  EXPECT_EQ(job.state, State::kFailed);
  EXPECT_EQ(codeOf(job), "job.timeout");
}

TEST_F(WorkersTest, CancelKillsTheSolverAtOnce) {
  options_.runs.limits.tick = milliseconds(3'600'000);  // only the signal can be the reason
  const std::string id = submit({{"gate", fixture_.folder() / "never"}, {"deaf", true}});
  start();
  waitUntil(id, [](const api::JobView& job) { return !job.stages.empty() || job.attempt > 0; });
  fixture_.stores().jobs.requestCancel(who_.tenant, id);
  workers_->cancel(id);
  EXPECT_EQ(waitForEnd(id).state, State::kCancelled);
}

TEST_F(WorkersTest, CancelByAnotherProcessIsSeenAtTheNextTick) {
  const std::string id = submit({{"steps", 1}, {"step_ms", 600'000}});
  start();
  waitUntil(id, [](const api::JobView& job) { return !job.stages.empty(); });
  fixture_.stores().jobs.requestCancel(who_.tenant, id);
  EXPECT_EQ(waitForEnd(id).state, State::kCancelled);
}

// Stopped in mid-job without blame; the next process goes on after the last finished stage.
TEST_F(WorkersTest, StoppedJobGoesOnAfterItsLastStage) {
  const std::string gate = "gate";
  for (const char* stage : {"scale", "ik"}) {
    fixture_.folder().write(gate + "." + stage, "");
  }
  const std::string id = submit({{"gate", fixture_.folder() / gate}});
  start();
  waitUntil(id, [](const api::JobView& job) { return job.stages.size() >= 2; });
  EXPECT_TRUE(workers_->stop(milliseconds(200)));
  workers_.reset();
  EXPECT_EQ(find(id).state, State::kRunning) << "states only move forward";
  for (const char* stage : {"rra", "id", "so", "cmc"}) {
    fixture_.folder().write(gate + "." + stage, "");
  }
  start();
  const api::JobView job = waitForEnd(id);
  EXPECT_EQ(job.state, State::kSucceeded);
  EXPECT_EQ(job.attempt, 2);
  EXPECT_EQ(job.stages.size(), 6U);
}

TEST_F(WorkersTest, StopLetsAShortJobEnd) {
  const std::string id = submit({{"steps", 5}, {"step_ms", 5}});
  start();
  waitUntil(id, [](const api::JobView& job) { return job.state == State::kRunning; });
  EXPECT_TRUE(workers_->stop(milliseconds(60'000)));
  EXPECT_EQ(find(id).state, State::kSucceeded);
}

// Somebody else has the job now: what this worker still brings is dropped.
TEST_F(WorkersTest, LateResultOfALostJobIsDropped) {
  options_.runs.limits.tick = milliseconds(3'600'000);
  const std::string gate = fixture_.folder() / "gate";
  const std::string id = submit({{"gate", gate}});
  start();
  waitUntil(id, [](const api::JobView& job) { return job.attempt == 1; });
  EXPECT_TRUE(fixture_.stores().jobs.giveBack({id, 1}));
  const auto other = fixture_.stores().jobs.claimNext("work:other", milliseconds(600'000));
  ASSERT_EQ(other->ticket.claim, 2);
  for (const char* stage : {"scale", "ik", "rra", "id", "so", "cmc"}) {
    fixture_.folder().write(std::string("gate.") + stage, "");
  }
  EXPECT_TRUE(workers_->stop(milliseconds(60'000)));
  EXPECT_EQ(find(id).state, State::kRunning);
  EXPECT_TRUE(find(id).stages.empty());
}

TEST_F(WorkersTest, CountWhatTheyDo) {
  const std::string id = submit(json::object());
  start();
  waitForEnd(id);
  EXPECT_TRUE(workers_->stop(milliseconds(60'000)));
  const std::string text = metrics_.render();
  EXPECT_NE(text.find("gaitmill_claims_total 1\n"), std::string::npos) << text;
  EXPECT_NE(text.find("gaitmill_jobs_finished_total{state=\"succeeded\"} 1\n"), std::string::npos);
  EXPECT_NE(text.find("gaitmill_stage_seconds_count{stage=\"cmc\"} 1\n"), std::string::npos);
}

}  // namespace
}  // namespace gaitmill
