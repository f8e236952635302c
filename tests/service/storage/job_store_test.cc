#include "service/storage/job_store.h"

#include <set>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "service/storage/trial_store.h"
#include "tests/support/temporary_folder.h"

namespace gaitmill {
namespace {

using State = api::JobState;

class JobStoreTest : public ::testing::Test {
 protected:
  JobStoreTest() { trial_ = TrialStore(database_).add({{70, 1.7, std::nullopt, "{}"}, {}}, {}).id; }

  std::string submit() { return store_.submit(trial_, "default", R"({"a":1})"); }
  JobTicket claim() { return store_.claimNext().value().ticket; }
  State stateOf(const std::string& id) { return store_.find(id).state; }
  template <class Call>
  ErrorCode codeOf(Call call) {
    try {
      call();
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::kInternal;
  }

  TemporaryFolder folder_;
  Database database_{folder_ / "mill.db"};
  JobStore store_{database_};
  std::string trial_;
};

TEST_F(JobStoreTest, OldestJobIsClaimedFirst) {
  const std::string first = submit();
  const std::string second = submit();
  EXPECT_EQ(store_.find(second).jobs_ahead, 1);
  const ClaimedJob job = store_.claimNext().value();
  EXPECT_EQ(job.ticket.job_id, first);
  EXPECT_EQ(job.trial_id, trial_);
  EXPECT_EQ(job.settings_json, R"({"a":1})");
  EXPECT_EQ(stateOf(first), State::kRunning);
  EXPECT_EQ(store_.find(second).jobs_ahead, 0);
  EXPECT_EQ(claim().job_id, second);
  EXPECT_FALSE(store_.claimNext().has_value());
}

TEST_F(JobStoreTest, UnknownTrialAndJobAreNamed) {
  EXPECT_EQ(codeOf([&] { store_.submit("tri_none", "", "{}"); }), ErrorCode::kTrialNotFound);
  EXPECT_EQ(codeOf([&] { store_.find("job_none"); }), ErrorCode::kJobNotFound);
  EXPECT_EQ(codeOf([&] { store_.requestCancel("job_none"); }), ErrorCode::kJobNotFound);
}

TEST_F(JobStoreTest, ProgressAndWarningsOfTheLastAttemptAreKept) {
  const std::string id = submit();
  JobTicket ticket = claim();
  EXPECT_TRUE(store_.saveProgress(ticket, {{"scale", 1.0, 1.0}, {"ik", 0.5, 0.2}}, {"old"}));
  store_.requeue(ticket);
  ticket = claim();
  EXPECT_TRUE(store_.saveProgress(ticket, {{"scale", 2.0, 0.5}}, {"one"}));
  EXPECT_TRUE(store_.saveProgress(ticket, {{"scale", 3.0, 1.0}}, {"two"}));
  const api::JobView job = store_.find(id);
  ASSERT_EQ(job.stages.size(), 1U);
  EXPECT_EQ(job.stages[0].seconds, 3.0);
  EXPECT_EQ(job.warnings, (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(job.attempt, 2);
}

TEST_F(JobStoreTest, ResultsComeWithSuccessAndNotBefore) {
  const std::string id = submit();
  const JobTicket ticket = claim();
  EXPECT_EQ(codeOf([&] { store_.listFiles(id); }), ErrorCode::kResultNotReady);
  EXPECT_TRUE(store_.succeed(
      ticket, {{ResultKind::kFile, "ik.mot", "bytes"}, {ResultKind::kTime, "moments", "table"}}));
  EXPECT_EQ(stateOf(id), State::kSucceeded);
  EXPECT_EQ(store_.readFile(id, "ik.mot").bytes, "bytes");
  EXPECT_EQ(store_.readResult(id, ResultKind::kTime, "moments"), "table");
  EXPECT_EQ(store_.listFiles(id).size(), 1U);
  EXPECT_EQ(codeOf([&] { store_.readFile(id, "moments"); }), ErrorCode::kResultNotFound);
}

TEST_F(JobStoreTest, DamagedResultsAreNotHandedOut) {
  const std::string id = submit();
  store_.succeed(claim(), {{ResultKind::kFile, "ik.mot", "bytes"}});
  database_.connection().runScript("UPDATE results SET bytes = 'bytez'");
  EXPECT_EQ(codeOf([&] { store_.readFile(id, "ik.mot"); }), ErrorCode::kStorage);
}

// A worker that has lost its job, for instance because it slept too long, changes nothing.
TEST_F(JobStoreTest, VoidTicketWritesNothing) {
  const std::string id = submit();
  const JobTicket old = claim();
  store_.requeue(old);
  const JobTicket current = claim();
  EXPECT_FALSE(store_.saveProgress(old, {{"ik", 1, 1}}, {"late"}));
  EXPECT_FALSE(store_.succeed(old, {{ResultKind::kFile, "late", ""}}));
  EXPECT_FALSE(store_.fail(old, "{}"));
  EXPECT_FALSE(store_.cancelRunning(old));
  EXPECT_FALSE(store_.requeue(old));
  EXPECT_EQ(stateOf(id), State::kRunning);
  EXPECT_TRUE(store_.succeed(current, {}));
  EXPECT_FALSE(store_.fail(current, "{}")) << "final states never change";
  EXPECT_TRUE(store_.listFiles(id).empty());
}

TEST_F(JobStoreTest, CancelEndsQueuedJobsAndMarksRunningOnes) {
  const std::string running = submit();
  const std::string queued = submit();
  const JobTicket ticket = claim();
  store_.requestCancel(queued);
  EXPECT_EQ(stateOf(queued), State::kCancelled);
  store_.requestCancel(running);
  EXPECT_EQ(stateOf(running), State::kRunning);
  EXPECT_TRUE(store_.find(running).cancel_requested);
  store_.cancelRunning(ticket);
  store_.requestCancel(running);
  EXPECT_EQ(stateOf(running), State::kCancelled);
}

TEST_F(JobStoreTest, FinishedJobCannotBeCancelled) {
  const std::string id = submit();
  store_.fail(claim(), R"({"code":"x"})");
  EXPECT_EQ(codeOf([&] { store_.requestCancel(id); }), ErrorCode::kJobState);
  EXPECT_EQ(store_.find(id).error, R"({"code":"x"})");
}

TEST_F(JobStoreTest, RecoverRequeuesOrphansAndHonoursCancels) {
  const std::string orphan = submit();
  const std::string unwanted = submit();
  claim();
  claim();
  store_.requestCancel(unwanted);
  const Recovery recovery = store_.recover();
  EXPECT_EQ(recovery.requeued, 1);
  EXPECT_EQ(recovery.cancelled, 1);
  EXPECT_EQ(stateOf(orphan), State::kQueued);
  EXPECT_EQ(stateOf(unwanted), State::kCancelled);
}

TEST_F(JobStoreTest, JobThatDiesThreeTimesFailsAndOthersGoOn) {
  const std::string deadly = submit();
  for (int death = 0; death < JobStore::kMaxDeaths; ++death) {
    EXPECT_EQ(stateOf(deadly), State::kQueued);
    claim();
    store_.recover();
  }
  const api::JobView job = store_.find(deadly);
  EXPECT_EQ(job.state, State::kFailed);
  EXPECT_EQ(nlohmann::json::parse(job.error.value())["code"], "job.abandoned");
  const std::string other = submit();
  EXPECT_EQ(claim().job_id, other);
}

TEST_F(JobStoreTest, StoppingTheServiceIsNoDeath) {
  const std::string id = submit();
  for (int stop = 0; stop < 10; ++stop) {
    EXPECT_TRUE(store_.requeue(claim()));
  }
  store_.recover();
  EXPECT_EQ(stateOf(id), State::kQueued);
}

TEST_F(JobStoreTest, ManyWorkersNeverClaimTheSameJob) {
  constexpr int kJobs = 60;
  for (int i = 0; i < kJobs; ++i) {
    submit();
  }
  std::vector<std::vector<std::string>> claimed(4);
  std::vector<std::thread> threads;
  for (auto& mine : claimed) {
    threads.emplace_back([this, &mine] {
      while (const auto job = store_.claimNext()) {
        mine.push_back(job->ticket.job_id);
      }
    });
  }
  std::multiset<std::string> all;
  for (std::size_t i = 0; i < threads.size(); ++i) {
    threads[i].join();
    all.insert(claimed[i].begin(), claimed[i].end());
  }
  EXPECT_EQ(all.size(), static_cast<std::size_t>(kJobs));
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), static_cast<std::size_t>(kJobs));
}

}  // namespace
}  // namespace gaitmill
