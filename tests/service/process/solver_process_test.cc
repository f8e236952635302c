// Real child processes of a program that does what its settings' name says: child_main.cc.

#include "service/process/solver_process.h"

#include <dirent.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <cerrno>
#include <string>
#include <thread>

#include <gtest/gtest.h>

namespace gaitmill {
namespace {

using End = SolveOutcome::End;
using std::chrono::milliseconds;

class Recorder : public SolveListener {
 public:
  void progress(Stage stage, double fraction) override {
    said += std::string(stageName(stage)) + " " + std::to_string(fraction).substr(0, 3) + "\n";
    if (on_progress) {
      on_progress();
    }
  }
  void warn(const std::string& sentence) override { said += sentence + "\n"; }
  void finish(SolvedStage stage) override { stages.push_back(std::move(stage)); }
  void print(const std::string& line) override { printed += line + "\n"; }
  bool goesOn() override { return goes_on; }

  std::string said;
  std::string printed;
  std::vector<SolvedStage> stages;
  bool goes_on = true;
  std::function<void()> on_progress;
};

int countOpenFiles() {
  int count = 0;
  DIR* folder = ::opendir("/proc/self/fd");
  while (::readdir(folder) != nullptr) {
    ++count;
  }
  ::closedir(folder);
  return count;
}

SolveRequest makeRequest(const std::string& task) {
  SolveRequest request;
  request.settings = {task, "{}"};
  request.mass = 70;
  request.height = 1.7;
  return request;
}

// The child is gone and its files are closed, whatever has happened.
class SolverProcessTest : public ::testing::Test {
 protected:
  void TearDown() override {
    EXPECT_EQ(countOpenFiles(), files_before_);
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
    EXPECT_EQ(errno, ECHILD);
  }
  SolveOutcome solve(const SolveRequest& request) {
    return solveInChild({PROCESS_CHILD}, request, limits_, recorder_, &interrupt_);
  }
  SolveOutcome solve(const std::string& task) { return solve(makeRequest(task)); }

  Interrupt interrupt_;
  int files_before_ = countOpenFiles();
  SolveLimits limits_;
  Recorder recorder_;
};

// A source of 5 MiB that is never in memory as a whole.
class CountingSource : public api::ByteSource {
 public:
  std::uint64_t size() const override { return 5U << 20U; }
  std::string read(std::uint64_t offset, std::size_t size) const override {
    largest_read = std::max(largest_read, size);
    return std::string(std::min<std::uint64_t>(size, this->size() - offset), 'm');
  }
  mutable std::size_t largest_read = 0;
};

TEST_F(SolverProcessTest, InputsGoInAndResultsComeOutByteForByte) {
  const auto source = std::make_shared<CountingSource>();
  SolveRequest request = makeRequest("echo");
  request.parts["markers"] = {"walk.trc", source};
  request.checkpoints = {std::string("a\0b", 3), std::string(3U << 20U, 'c')};
  ::setenv("GAITMILL_SECRET", "x", 1);
  const SolveOutcome outcome = solve(request);
  ::unsetenv("GAITMILL_SECRET");
  ASSERT_EQ(outcome.end, End::kSucceeded);
  EXPECT_EQ(recorder_.said, "ik 0.5\na sentence\n");
  EXPECT_EQ(recorder_.printed, "a line\n [31mred\n");
  ASSERT_EQ(recorder_.stages.size(), 1U);
  EXPECT_EQ(recorder_.stages[0].checkpoint, "left by ik");
  ASSERT_EQ(recorder_.stages[0].items.size(), 2U);
  EXPECT_EQ(recorder_.stages[0].items[0].name, "markers");
  EXPECT_EQ(recorder_.stages[0].items[0].bytes, std::string(5U << 20U, 'm'));
  EXPECT_EQ(recorder_.stages[0].items[1].bytes, "{}");
  ASSERT_EQ(outcome.items.size(), 3U);
  EXPECT_EQ(outcome.items[0].bytes, request.checkpoints[0]);
  EXPECT_EQ(outcome.items[1].bytes, request.checkpoints[1]);
  EXPECT_EQ(outcome.items[2].bytes, "0 1 2 3 clean") << "files and environment of the child";
  EXPECT_EQ(outcome.verdict, "warn");
  EXPECT_EQ(outcome.warnings, std::vector<std::string>{"a sentence"});
  EXPECT_LE(source->largest_read, 1U << 20U);
}

TEST_F(SolverProcessTest, ErrorsKeepPlaceAndContext) {
  const SolveOutcome outcome = solve("fail");
  ASSERT_EQ(outcome.end, End::kFailed);
  const Error& error = outcome.error.value();
  EXPECT_EQ(error.code(), ErrorCode::kInputMarkers);
  EXPECT_EQ(error.message(), "markers are missing");
  const Where& where = error.where();
  EXPECT_EQ(where.file, "walk.trc");
  EXPECT_EQ(where.line, 7);
  EXPECT_EQ(where.column, 3);
  EXPECT_EQ(where.field, "RASI");
  EXPECT_EQ(where.stage, "ik");
  EXPECT_EQ(where.time, 0.25);
  EXPECT_EQ(where.marker, "RASI");
  EXPECT_EQ(where.muscle, "soleus_r");
  EXPECT_EQ(where.coordinate, "knee_angle_r");
  EXPECT_EQ(error.context(), (std::vector<std::string>{"ik", "trial"}));
}

struct DeathCase {
  const char* task;
  ErrorCode code;
  const char* stage;
  const char* sentence;
};
class SolverProcessDeath : public SolverProcessTest,
                           public ::testing::WithParamInterface<DeathCase> {};
TEST_P(SolverProcessDeath, IsToldApart) {
  limits_.child.memory_mb = 256;
  if (GetParam().code == ErrorCode::kJobTimeout) {
    limits_.silence = milliseconds(300);
    limits_.stage = milliseconds(600);
  }
  const SolveOutcome outcome = solve(GetParam().task);
  ASSERT_EQ(outcome.end, End::kDied);
  EXPECT_EQ(outcome.error->code(), GetParam().code);
  EXPECT_EQ(outcome.error->where().stage, GetParam().stage);
  EXPECT_NE(outcome.error->message().find(GetParam().sentence), std::string::npos)
      << outcome.error->message();
}
INSTANTIATE_TEST_SUITE_P(
    Table,
    SolverProcessDeath,
    ::testing::Values(DeathCase{"abort", ErrorCode::kJobCrashed, "so", "SIGABRT"},
                      DeathCase{"segfault", ErrorCode::kJobCrashed, "", "SIGSEGV"},
                      DeathCase{"exit", ErrorCode::kJobCrashed, "", "exit code 3"},
                      DeathCase{"garbage", ErrorCode::kJobCrashed, "", "SIGKILL"},
                      DeathCase{"hang", ErrorCode::kJobTimeout, "", "no sign of life for 0.3 s"},
                      DeathCase{"speak", ErrorCode::kJobTimeout, "rra", "longer than its 0.6 s"}));

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
INSTANTIATE_TEST_SUITE_P(Memory,
                         SolverProcessDeath,
                         ::testing::Values(DeathCase{
                             "eat", ErrorCode::kJobMemory, "", "more than its 256 MiB"}));
#endif

TEST_F(SolverProcessTest, IsKilledAtOnceWhenNoLongerWanted) {
  limits_.tick = milliseconds(3'600'000);  // only the interrupt makes it ask
  std::thread canceller;
  recorder_.on_progress = [&] {
    if (recorder_.goes_on) {
      recorder_.goes_on = false;
      canceller = std::thread([&] { interrupt_.raise(); });
    }
  };
  EXPECT_EQ(solve("speak").end, End::kStopped);
  canceller.join();
}

TEST_F(SolverProcessTest, IsKilledWhenTheTickSaysSo) {
  limits_.tick = milliseconds(5);
  recorder_.goes_on = false;
  EXPECT_EQ(solve("hang").end, End::kStopped);
}

}  // namespace
}  // namespace gaitmill
