// Who may write about a running job, and what becomes of it when its worker goes.

#include <atomic>
#include <chrono>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "service/storage/job_store.h"
#include "tests/service/storage/storage_fixture.h"

namespace gaitmill {
namespace {

using State = api::JobState;
using std::chrono::milliseconds;

// Lapsed as soon as it is given.
constexpr milliseconds kNoLease{0};

class JobLeasesTest : public StorageTest {
 protected:
  FinishedStage makeStage(const std::string& name) {
    return {name, "checkpoint of " + name, {}, {{name, 1.0, 1.0}}, {}};
  }
  void expectVoid(const JobTicket& ticket) {
    EXPECT_FALSE(jobs_.findStanding(ticket).is_held);
    EXPECT_FALSE(jobs_.heartbeat(ticket, kLease).is_held);
    EXPECT_FALSE(jobs_.saveProgress(ticket, {{"ik", 1, 1}}, {"late"}));
    EXPECT_FALSE(jobs_.saveStage(ticket, makeStage("ik")));
    EXPECT_FALSE(jobs_.succeed(ticket, {{ResultKind::kFile, "late", "", ""}}, "pass"));
    EXPECT_FALSE(jobs_.fail(ticket, Error(ErrorCode::kInternal, "late")));
    EXPECT_FALSE(jobs_.cancelRunning(ticket));
    EXPECT_FALSE(jobs_.giveBack(ticket));
    EXPECT_EQ(jobs_.recordDeath(ticket, Error(ErrorCode::kJobCrashed, "late")),
              DeathOutcome::kTicketVoid);
  }
};

TEST_F(JobLeasesTest, OldestJobIsClaimedFirst) {
  const std::string first = submit();
  const std::string second = submit();
  EXPECT_EQ(find(second).jobs_ahead, 1);
  const ClaimedJob job = jobs_.claimNext("serve:1", kLease).value();
  EXPECT_EQ(job.ticket.job_id, first);
  EXPECT_EQ(job.tenant, kTenant);
  EXPECT_EQ(job.trial_id, trial_);
  EXPECT_EQ(job.settings_json, R"({"a":1})");
  EXPECT_EQ(job.provenance, "abc");
  EXPECT_EQ(stateOf(first), State::kRunning);
  EXPECT_EQ(find(second).jobs_ahead, 0);
  EXPECT_EQ(claim().job_id, second);
  EXPECT_FALSE(jobs_.claimNext("serve:1", kLease).has_value());
}

// A worker that has lost its job, for instance because it slept too long, changes nothing.
TEST_F(JobLeasesTest, StaleTicketWritesNothing) {
  const std::string id = submit();
  const JobTicket old = jobs_.claimNext("work:1", kNoLease).value().ticket;
  const JobTicket current = claim();
  EXPECT_EQ(current.job_id, id);
  const std::int64_t version = find(id).version;
  expectVoid(old);
  EXPECT_EQ(find(id).version, version);
  EXPECT_TRUE(jobs_.readCheckpoints(id).empty());
  EXPECT_TRUE(jobs_.succeed(current, {}, "pass"));
  expectVoid(current);
  expectVoid(old);
  EXPECT_EQ(stateOf(id), State::kSucceeded);
  EXPECT_TRUE(jobs_.listFiles(kTenant, id).empty());
  jobs_.remove(kTenant, id);
  expectVoid(current);
}

TEST_F(JobLeasesTest, StaleTicketOfAnotherProcessWritesNothing) {
  const std::string id = submit();
  const JobTicket current = jobs_.claimNext("serve:1", kNoLease).value().ticket;
  Database other({folder_ / "mill.db", DatabaseUse::kWork});
  JobStore elsewhere(other);
  const JobTicket theirs = elsewhere.claimNext("work:2", kLease).value().ticket;
  EXPECT_EQ(theirs.job_id, id);
  expectVoid(current);
  EXPECT_TRUE(elsewhere.succeed(theirs, {}, "pass"));
  EXPECT_EQ(stateOf(id), State::kSucceeded);
}

TEST_F(JobLeasesTest, HeartbeatKeepsTheJob) {
  submit();
  const JobTicket ticket = jobs_.claimNext("work:1", kNoLease).value().ticket;
  EXPECT_TRUE(jobs_.heartbeat(ticket, kLease).is_held) << "nobody has claimed it since";
  EXPECT_FALSE(jobs_.claimNext("work:2", kLease).has_value());
}

TEST_F(JobLeasesTest, GivenBackIsNoDeathAndIsClaimedAgain) {
  const std::string id = submit();
  for (int stop = 0; stop < 10; ++stop) {
    const JobTicket ticket = claim();
    EXPECT_EQ(ticket.claim, stop + 1);
    EXPECT_TRUE(jobs_.giveBack(ticket));
    expectVoid(ticket);
    EXPECT_EQ(stateOf(id), State::kRunning) << "states never go backwards";
  }
  EXPECT_EQ(jobs_.claimNext("serve:2", kLease).value().deaths, 0);
}

TEST_F(JobLeasesTest, ResumesAfterItsLastFinishedStage) {
  const std::string id = submit();
  JobTicket ticket = claim();
  jobs_.saveProgress(ticket, {{"scale", 0.5, 0.5}}, {"in scale"});
  EXPECT_TRUE(jobs_.saveStage(ticket, makeStage("scale")));
  FinishedStage ik = makeStage("ik");
  ik.stages = {{"scale", 1.0, 1.0}, {"ik", 2.0, 1.0}};
  ik.results = {{ResultKind::kTime, "kinematics", "table", ""}};
  EXPECT_TRUE(jobs_.saveStage(ticket, ik));
  jobs_.saveProgress(
      ticket, {{"scale", 1.0, 1.0}, {"ik", 2.0, 1.0}, {"rra", 9.0, 0.4}}, {"in rra"});
  jobs_.giveBack(ticket);
  const ClaimedJob again = jobs_.claimNext("serve:2", kLease).value();
  ASSERT_EQ(again.stages.size(), 2U);
  EXPECT_EQ(again.stages[1].stage, "ik");
  EXPECT_EQ(again.stages[1].seconds, 2.0);
  EXPECT_EQ(jobs_.readCheckpoints(id),
            (std::vector<std::string>{"checkpoint of scale", "checkpoint of ik"}));
  const api::JobView job = find(id);
  EXPECT_EQ(job.stages.size(), 2U) << "rra begins anew";
  EXPECT_EQ(job.warnings, std::vector<std::string>{"in scale"});
  EXPECT_EQ(job.attempt, 2);
  const StoredResult table = jobs_.readResult(kTenant, id, ResultKind::kTime, "kinematics");
  EXPECT_EQ(table.bytes, "table") << "readable while later stages run";
  EXPECT_EQ(table.info.stage, "ik");
}

TEST_F(JobLeasesTest, JobThatDiesThreeTimesFailsWithTheReasonAndOthersGoOn) {
  const std::string deadly = submit();
  const std::string other = submit();
  for (int death = 1; death <= JobStore::kMaxDeaths; ++death) {
    EXPECT_EQ(stateOf(deadly), death == 1 ? State::kQueued : State::kRunning);
    const ClaimedJob job = jobs_.claimNext("serve:1", kLease).value();
    EXPECT_EQ(job.ticket.job_id, deadly);
    EXPECT_EQ(job.deaths, death - 1);
    const DeathOutcome outcome =
        jobs_.recordDeath(job.ticket, Error(ErrorCode::kJobMemory, "more than 2048 MiB"));
    EXPECT_EQ(outcome, death < 3 ? DeathOutcome::kGivenBack : DeathOutcome::kFailed);
  }
  const api::JobView job = find(deadly);
  EXPECT_EQ(job.state, State::kFailed);
  const auto error = nlohmann::json::parse(job.error.value());
  EXPECT_EQ(error["code"], "job.memory");
  EXPECT_NE(job.error->find("2048 MiB"), std::string::npos);
  EXPECT_EQ(claim().job_id, other);
}

TEST_F(JobLeasesTest, LapsesUnderOtherOwnersAreDeaths) {
  const std::string id = submit();
  for (const char* owner : {"work:1", "work:2", "work:3"}) {
    EXPECT_TRUE(jobs_.claimNext(owner, kNoLease).has_value());
  }
  EXPECT_FALSE(jobs_.claimNext("work:4", kLease).has_value());
  EXPECT_EQ(stateOf(id), State::kFailed);
  EXPECT_EQ(nlohmann::json::parse(find(id).error.value())["code"], "job.abandoned");
}

TEST_F(JobLeasesTest, LapseUnderTheSameOwnerIsOnlySlowness) {
  const std::string id = submit();
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(jobs_.claimNext("serve:1", kNoLease).value().deaths, 0);
  }
  EXPECT_EQ(stateOf(id), State::kRunning);
}

TEST_F(JobLeasesTest, StartOfTheServiceTakesOverFromTheLastOne) {
  const std::string orphan = submit();
  const std::string unwanted = submit();
  const std::string elsewhere = submit();
  const JobTicket first = claim();
  claim();
  const JobTicket theirs = jobs_.claimNext("work:1", kLease).value().ticket;
  jobs_.requestCancel(kTenant, unwanted);
  const Recovery recovery = jobs_.lapseLeases("serve:");
  EXPECT_EQ(recovery.given_back, 1);
  EXPECT_EQ(recovery.cancelled, 1);
  EXPECT_EQ(recovery.abandoned, 0);
  EXPECT_EQ(stateOf(orphan), State::kRunning);
  EXPECT_EQ(stateOf(unwanted), State::kCancelled);
  expectVoid(first);
  EXPECT_TRUE(jobs_.heartbeat(theirs, kLease).is_held) << elsewhere;
  EXPECT_EQ(jobs_.claimNext("serve:2", kLease).value().ticket.job_id, orphan);
  EXPECT_EQ(jobs_.lapseLeases("serve:2").given_back, 1);
}

TEST_F(JobLeasesTest, ServiceThatDiesThreeTimesOnAJobFailsIt) {
  const std::string id = submit();
  for (int start = 0; start < JobStore::kMaxDeaths; ++start) {
    claim();
    jobs_.lapseLeases("serve:");
  }
  EXPECT_EQ(stateOf(id), State::kFailed);
}

TEST_F(JobLeasesTest, JobToBeCancelledDiesCancelled) {
  const std::string id = submit();
  const JobTicket ticket = claim();
  jobs_.requestCancel(kTenant, id);
  EXPECT_EQ(jobs_.recordDeath(ticket, Error(ErrorCode::kJobCrashed, "x")),
            DeathOutcome::kCancelled);
  EXPECT_EQ(stateOf(id), State::kCancelled);
  const std::string other = submit();
  jobs_.claimNext("work:1", kNoLease);
  jobs_.requestCancel(kTenant, other);
  EXPECT_FALSE(jobs_.claimNext("work:2", kLease).has_value());
  EXPECT_EQ(stateOf(other), State::kCancelled);
}

// Four threads of two processes.
TEST_F(JobLeasesTest, ManyWorkersNeverClaimTheSameJob) {
  constexpr int kJobs = 60;
  for (int i = 0; i < kJobs; ++i) {
    submit();
  }
  Database other({folder_ / "mill.db", DatabaseUse::kWork});
  JobStore elsewhere(other);
  std::vector<std::vector<std::string>> claimed(4);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < claimed.size(); ++i) {
    threads.emplace_back([&, i] {
      JobStore& jobs = i % 2 == 0 ? jobs_ : elsewhere;
      while (const auto job = jobs.claimNext("work:" + std::to_string(i), kLease)) {
        claimed[i].push_back(job->ticket.job_id);
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

// Workers claim, lose, die and finish at random while leases lapse at once: every job ends once.
TEST_F(JobLeasesTest, EveryJobEndsExactlyOnceWhateverItsWorkersDo) {
  constexpr int kJobs = 40;
  std::vector<std::string> ids;
  for (int i = 0; i < kJobs; ++i) {
    ids.push_back(submit());
  }
  std::atomic<int> ends{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      const std::string owner = "serve:1";
      int round = t;
      while (const auto job = jobs_.claimNext(owner, round % 3 == 0 ? kNoLease : kLease)) {
        ++round;
        jobs_.saveStage(job->ticket, makeStage("ik"));
        if (round % 4 == 1) {
          jobs_.giveBack(job->ticket);
        } else if (jobs_.succeed(job->ticket, {{ResultKind::kFile, "f", "x", ""}}, "pass")) {
          ++ends;
        }
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  EXPECT_EQ(ends, kJobs);
  for (const std::string& id : ids) {
    EXPECT_EQ(stateOf(id), State::kSucceeded);
    int told = 0;
    for (const api::JobEvent& event : jobs_.listEvents(kTenant, id, 0)) {
      told += event.data == R"({"state":"succeeded"})" ? 1 : 0;
    }
    EXPECT_EQ(told, 1);
  }
  EXPECT_EQ(queryInteger(database_, "SELECT count(*) FROM checkpoints"), 0);
}

}  // namespace
}  // namespace gaitmill
