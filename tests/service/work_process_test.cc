// `gaitmill work` as processes of its own beside a database that the test has open.

#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/service/child_process.h"
#include "tests/service/port_fixture.h"

namespace gaitmill {
namespace {

using nlohmann::json;
using State = api::JobState;

class WorkProcessTest : public ::testing::Test {
 protected:
  std::unique_ptr<ChildProcess> startWork(const std::string& lease_s) {
    auto process =
        std::make_unique<ChildProcess>(std::vector<std::string>{FAKE_SERVICE,
                                                                "work",
                                                                "--db",
                                                                fixture_.folder() / "mill.db",
                                                                "--models",
                                                                fixture_.folder() / "models",
                                                                "--workers",
                                                                "1",
                                                                "--lease-s",
                                                                lease_s,
                                                                "--stop-limit-s",
                                                                "0",
                                                                "--log-level",
                                                                "off"});
    EXPECT_EQ(process->readLine().rfind("gaitmill works on", 0), 0U);
    return process;
  }
  std::string submitBehindGate() {
    const json settings{{"gate", fixture_.folder() / "gate"}};
    return fixture_.addJob(who_, fixture_.addTrial(who_), settings.dump());
  }
  void openGates() {
    for (const char* stage : {"scale", "ik", "rra", "id", "so", "cmc"}) {
      fixture_.folder().write(std::string("gate.") + stage, "");
    }
  }
  template <class Condition>
  api::JobView waitUntil(const std::string& id, Condition condition) {
    const auto find = [&] {
      return fixture_.stores().jobs.find(who_.tenant, id);
    };
    for (int i = 0; i < 20'000 && !condition(find()); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return find();
  }

  PortFixture fixture_;
  api::Identity who_ = makeMember("local");
};

// Asleep past its lease, the first process wakes when the second has done the job: what it still
// writes is rejected, and nothing is there twice.
TEST_F(WorkProcessTest, ProcessAsleepPastItsLeaseChangesNothing) {
  const std::string id = submitBehindGate();
  const auto sleeper = startWork("0.5");
  waitUntil(id, [](const api::JobView& job) { return job.attempt == 1; });
  sleeper->signal(SIGSTOP);
  const auto other = startWork("60");
  const api::JobView taken =
      waitUntil(id, [](const api::JobView& job) { return job.attempt == 2; });
  ASSERT_EQ(taken.attempt, 2);
  openGates();
  const auto has_ended = [](const api::JobView& job) {
    return api::isFinal(job.state);
  };
  const api::JobView done = waitUntil(id, has_ended);
  EXPECT_EQ(done.state, State::kSucceeded);
  sleeper->signal(SIGCONT);
  sleeper->signal(SIGTERM);
  EXPECT_EQ(sleeper->wait(), 0);
  const api::JobView later = fixture_.stores().jobs.find(who_.tenant, id);
  EXPECT_EQ(later.state, State::kSucceeded);
  EXPECT_EQ(later.attempt, 2);
  EXPECT_EQ(later.version, done.version) << "no write has come through";
  other->signal(SIGTERM);
  EXPECT_EQ(other->wait(), 0);
}

// No file of the process may grow: its stages find no room, and the job waits for it.
TEST_F(WorkProcessTest, JobWithoutRoomForItsResultsIsParkedAndGoesOn) {
  fixture_.folder().write("gate.scale", "");
  const std::string id = submitBehindGate();
  const auto worker = startWork("600");
  waitUntil(id, [](const api::JobView& job) { return job.stages.size() == 2; });
  rlimit unlimited{};
  ASSERT_EQ(::prlimit(worker->pid(), RLIMIT_FSIZE, nullptr, &unlimited), 0);
  const rlimit full{0, unlimited.rlim_max};
  ASSERT_EQ(::prlimit(worker->pid(), RLIMIT_FSIZE, &full, nullptr), 0);
  openGates();
  // Long enough for several tries to store; the outcome does not depend on how many.
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_EQ(fixture_.stores().jobs.find(who_.tenant, id).state, State::kRunning);
  ASSERT_EQ(::prlimit(worker->pid(), RLIMIT_FSIZE, &unlimited, nullptr), 0);
  const auto has_ended = [](const api::JobView& job) {
    return api::isFinal(job.state);
  };
  const api::JobView done = waitUntil(id, has_ended);
  EXPECT_EQ(done.state, State::kSucceeded) << done.error.value_or("");
  EXPECT_EQ(done.attempt, 1);
  EXPECT_EQ(done.stages.size(), 6U);
  EXPECT_EQ(fixture_.database().checkIntegrity(), "ok");
}

TEST_F(WorkProcessTest, CancellationReachesAnotherProcess) {
  const std::string id = submitBehindGate();
  const auto worker = startWork("60");
  waitUntil(id, [](const api::JobView& job) { return job.attempt == 1; });
  fixture_.ports().jobs.cancel(who_, id);
  const auto is_cancelled = [](const api::JobView& job) {
    return job.state == State::kCancelled;
  };
  EXPECT_EQ(waitUntil(id, is_cancelled).state, State::kCancelled);
}

TEST_F(WorkProcessTest, StopGivesTheJobToTheNextWithoutBlame) {
  const std::string id = submitBehindGate();
  const auto first = startWork("600");
  waitUntil(id, [](const api::JobView& job) { return job.attempt == 1; });
  first->signal(SIGTERM);
  EXPECT_EQ(first->wait(), 0);
  openGates();
  const auto second = startWork("600");
  const auto has_ended = [](const api::JobView& job) {
    return api::isFinal(job.state);
  };
  const api::JobView done = waitUntil(id, has_ended);
  EXPECT_EQ(done.state, State::kSucceeded);
  EXPECT_EQ(done.attempt, 2);
}

TEST_F(WorkProcessTest, SecondSignalEndsItAtOnce) {
  const std::string id = submitBehindGate();
  ChildProcess process({FAKE_SERVICE,
                        "work",
                        "--db",
                        fixture_.folder() / "mill.db",
                        "--models",
                        fixture_.folder() / "models",
                        "--stop-limit-s",
                        "3600",
                        "--log-level",
                        "info"});
  process.readLine();
  waitUntil(id, [](const api::JobView& job) { return job.attempt == 1; });
  process.signal(SIGTERM);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));  // two at once would be one
  process.signal(SIGINT);
  EXPECT_EQ(process.wait(), 128 + SIGINT);
}

}  // namespace
}  // namespace gaitmill
