// The workers with a pipeline that each test writes itself.

#include "service/workers.h"

#include <chrono>
#include <future>
#include <stdexcept>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "service/observe/log.h"
#include "tests/support/temporary_folder.h"

namespace gaitmill {
namespace {

using State = api::JobState;
using std::chrono::milliseconds;

class WorkersTest : public ::testing::Test {
 protected:
  WorkersTest() {
    setUpLog("off");
    trial_ = trials_.add({{70, 1.7, std::nullopt, "{}"}, {}}, {}).id;
  }
  std::string submit() { return jobs_.submit(trial_, "", "{}"); }

  api::JobView waitFor(const std::string& id, State state) {
    for (int i = 0; i < 5000 && jobs_.find(id).state != state; ++i) {
      std::this_thread::sleep_for(milliseconds(1));
    }
    EXPECT_EQ(jobs_.find(id).state, state);
    return jobs_.find(id);
  }
  static PipelineResult makeResult() {
    PipelineResult result;
    result.summary_json = "{}";
    return result;
  }

  TemporaryFolder folder_;
  Database database_{folder_ / "mill.db"};
  TrialStore trials_{database_};
  JobStore jobs_{database_};
  std::string trial_;
};

TEST_F(WorkersTest, TakeJobsFromBeforeAndAfterTheStart) {
  Workers workers(
      trials_, jobs_, [](auto&&...) { return makeResult(); }, 2);
  const std::string before = submit();
  workers.start();
  waitFor(before, State::kSucceeded);
  const std::string after = submit();
  workers.wake();
  waitFor(after, State::kSucceeded);
}

TEST_F(WorkersTest, EveryKindOfExceptionFailsItsJobOnly) {
  int calls = 0;
  const auto run = [&calls](const TrialInput&, const InputFile&, const PipelineEvents&) {
    switch (calls++) {
      case 0:
        throw std::bad_alloc();
      case 1:
        throw std::runtime_error("a secret path");
      case 2:
        throw Error(ErrorCode::kTrcNumber, "not a number", {"a.trc", 3, 7, ""});
      case 3:
        throw Error(ErrorCode::kCancelled, "nobody asked for this");
      default:
        return makeResult();
    }
  };
  std::vector<std::string> ids;
  for (int i = 0; i < 5; ++i) {
    ids.push_back(submit());
  }
  Workers workers(trials_, jobs_, run, 1);
  workers.start();
  waitFor(ids[4], State::kSucceeded);
  const auto codeOf = [&](const std::string& id) -> std::string {
    return nlohmann::json::parse(jobs_.find(id).error.value())["code"];
  };
  EXPECT_EQ(codeOf(ids[0]), "internal");
  EXPECT_EQ(codeOf(ids[1]), "internal");
  EXPECT_EQ(jobs_.find(ids[1]).error->find("secret"), std::string::npos);
  EXPECT_EQ(codeOf(ids[2]), "trc.number");
  EXPECT_EQ(codeOf(ids[3]), "cancelled");
  EXPECT_EQ(jobs_.find(ids[3]).state, State::kFailed);
}

TEST_F(WorkersTest, WarningsOfEventsAndResultAreKeptOnce) {
  const auto run = [](const TrialInput&, const InputFile&, const PipelineEvents& events) {
    events.progress(Stage::kIk, 0.0);
    events.warn("first");
    events.progress(Stage::kIk, 1.0);
    PipelineResult result = makeResult();
    result.warnings = {"first", "second"};
    return result;
  };
  const std::string id = submit();
  Workers workers(trials_, jobs_, run, 1);
  workers.start();
  const api::JobView job = waitFor(id, State::kSucceeded);
  EXPECT_EQ(job.warnings, (std::vector<std::string>{"first", "second"}));
  ASSERT_EQ(job.stages.size(), 1U);
  EXPECT_EQ(job.stages[0].fraction, 1.0);
}

// A solver that never reports cannot hold up the end of the service, nor does its job get lost.
TEST_F(WorkersTest, StopGivesUpOnADeafSolverAndRequeuesItsJob) {
  std::promise<void> begun;
  std::promise<void> release;
  const auto run = [&](const TrialInput&, const InputFile&, const PipelineEvents&) {
    begun.set_value();
    release.get_future().wait();
    return makeResult();
  };
  const std::string id = submit();
  Workers workers(trials_, jobs_, run, 1);
  workers.start();
  begun.get_future().wait();
  EXPECT_FALSE(workers.stop(milliseconds(20)));
  EXPECT_EQ(jobs_.find(id).state, State::kQueued);
  release.set_value();
}

TEST_F(WorkersTest, LateResultOfALostJobIsDropped) {
  std::promise<void> begun;
  std::promise<void> release;
  const auto run = [&](const TrialInput&, const InputFile&, const PipelineEvents& events) {
    begun.set_value();
    release.get_future().wait();
    EXPECT_FALSE(events.progress(Stage::kIk, 0.5)) << "the ticket is void";
    return makeResult();
  };
  const std::string id = submit();
  {
    Workers workers(trials_, jobs_, run, 1);
    workers.start();
    begun.get_future().wait();
    EXPECT_TRUE(jobs_.requeue({id, 1}));
    EXPECT_EQ(jobs_.claimNext().value().ticket.claim, 2) << "somebody else has it now";
    release.set_value();
  }
  EXPECT_EQ(jobs_.find(id).state, State::kRunning);
}

}  // namespace
}  // namespace gaitmill
