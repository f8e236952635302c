// Real children of the fake service: service/draw_process.h.

#include "service/draw_process.h"

#include <signal.h>

#include <cerrno>
#include <chrono>
#include <future>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "service/draw_task.h"
#include "service/observe/log.h"
#include "tests/service/expect_error.h"

namespace gaitmill {
namespace {

using std::chrono::milliseconds;

// Waits for something that another thread or process does.
template <class Condition>
bool comesTrue(Condition condition) {
  for (int i = 0; i < 1000 && !condition(); ++i) {
    std::this_thread::sleep_for(milliseconds(5));
  }
  return condition();
}

class DrawProcessTest : public ::testing::Test {
 protected:
  void SetUp() override { setUpLog("off", "text"); }

  DrawProcess& process() {
    if (process_ == nullptr) {
      process_ = std::make_unique<DrawProcess>(
          ChildCommand{FAKE_SERVICE, "draw", "--models", "models"}, limits_);
    }
    return *process_;
  }
  // The answer to a validation of this name, with the model as its only data.
  std::string ask(const std::string& figure, const std::string& model = "model") {
    DrawTask task;
    task.kind = DrawTask::Kind::kValidation;
    task.figure = figure;
    const DrawReply reply = process().ask({encodeDrawTask(task), model, [&] {
                                             ++times_read_;
                                             DrawData data;
                                             data.picture.model_osim = model;
                                             return encodeDrawData(data);
                                           }});
    return decodeFigures(reply.bytes).at(0).caption;
  }
  ErrorCode codeOf(const std::string& figure) {
    try {
      ask(figure);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::kInternal;
  }

  DrawLimits limits_;
  int times_read_ = 0;
  std::unique_ptr<DrawProcess> process_;
};

TEST_F(DrawProcessTest, OneChildServesRequestAfterRequestAndKeepsTheData) {
  EXPECT_EQ(process().findPid(), -1);
  EXPECT_EQ(ask("curves"), "model");
  const pid_t pid = process().findPid();
  EXPECT_GT(pid, 0);
  EXPECT_EQ(ask("curves"), "model");
  EXPECT_EQ(times_read_, 1);
  EXPECT_EQ(ask("curves", "another"), "another");
  EXPECT_EQ(times_read_, 2);
  EXPECT_EQ(process().findPid(), pid);
}

TEST_F(DrawProcessTest, ErrorOfTheChildComesThroughAndTheChildStays) {
  EXPECT_EQ(ask("curves"), "model");
  const pid_t pid = process().findPid();
  EXPECT_EQ(codeOf("no such figure"), ErrorCode::kFigureNotFound);
  EXPECT_EQ(ask("curves"), "model");
  EXPECT_EQ(process().findPid(), pid);
  EXPECT_EQ(times_read_, 1);
}

TEST_F(DrawProcessTest, ChildKilledInTheMiddleGetsASuccessor) {
  EXPECT_EQ(ask("curves"), "model");
  const pid_t first = process().findPid();
  std::future<std::string> slow = std::async(std::launch::async, [this] { return ask("sleep"); });
  std::this_thread::sleep_for(milliseconds(100));
  ::kill(first, SIGKILL);
  EXPECT_EQ(slow.get(), "model");
  EXPECT_NE(process().findPid(), first);
  EXPECT_EQ(ask("curves"), "model");
}

TEST_F(DrawProcessTest, ChildKilledBetweenRequestsIsNotNoticed) {
  EXPECT_EQ(ask("curves"), "model");
  ::kill(process().findPid(), SIGKILL);
  EXPECT_EQ(ask("curves"), "model");
}

TEST_F(DrawProcessTest, WhatKillsEveryChildIsOneErrorAndTheNextRequestWorks) {
  EXPECT_EQ(codeOf("crash"), ErrorCode::kRender);
  EXPECT_EQ(ask("curves"), "model");
}

TEST_F(DrawProcessTest, WhatTakesTooLongIsEnded) {
  limits_.deadline = milliseconds(100);
  EXPECT_EQ(codeOf("sleep"), ErrorCode::kRender);
  EXPECT_TRUE(comesTrue([this] { return process().findPid() == -1; }));
  EXPECT_EQ(ask("curves"), "model");
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_F(DrawProcessTest, WhatTakesTooMuchMemoryIsEnded) {
  limits_.child.memory_mb = 1024;
  EXPECT_EQ(codeOf("memory"), ErrorCode::kRender);
  EXPECT_EQ(ask("curves"), "model");
}
#endif

TEST_F(DrawProcessTest, IdleChildEndsAndComesBack) {
  limits_.idle = milliseconds(50);
  EXPECT_EQ(ask("curves"), "model");
  const pid_t pid = process().findPid();
  EXPECT_TRUE(comesTrue([this] { return process().findPid() == -1; }));
  EXPECT_EQ(::kill(pid, 0), -1);
  EXPECT_EQ(errno, ESRCH);
  EXPECT_EQ(ask("curves"), "model");
  EXPECT_EQ(times_read_, 2);
}

TEST_F(DrawProcessTest, MoreThanMayWaitAreToldToComeBack) {
  limits_.waiting = 2;
  EXPECT_EQ(ask("curves"), "model");
  std::vector<std::future<ErrorCode>> answers;
  for (int i = 0; i < 8; ++i) {
    answers.push_back(std::async(std::launch::async, [this] {
      try {
        ask("sleep");
        return ErrorCode::kCancelled;  // no error
      } catch (const Error& error) {
        return error.code();
      }
    }));
  }
  int served = 0;
  for (auto& answer : answers) {
    const ErrorCode code = answer.get();
    EXPECT_TRUE(code == ErrorCode::kCancelled || code == ErrorCode::kRequestBusy);
    served += code == ErrorCode::kCancelled ? 1 : 0;
  }
  EXPECT_GE(served, 2);
  EXPECT_LT(served, 8);
}

TEST_F(DrawProcessTest, StopAnswersWhoWaits) {
  EXPECT_EQ(ask("curves"), "model");
  std::future<ErrorCode> slow = std::async(std::launch::async, [this] { return codeOf("sleep"); });
  std::this_thread::sleep_for(milliseconds(50));
  process().stop();
  EXPECT_EQ(slow.get(), ErrorCode::kRequestBusy);
  EXPECT_EQ(codeOf("curves"), ErrorCode::kRequestBusy);
}

// What a request cannot be drawn from is its own fault, not the child's.
TEST_F(DrawProcessTest, ErrorOfTheDataComesThrough) {
  EXPECT_EQ(ask("curves"), "model");
  const pid_t pid = process().findPid();
  EXPECT_THROW(process().ask({"{}",
                              "other",
                              []() -> std::map<std::string, std::string> {
                                throw Error(ErrorCode::kResultNotReady, "not yet");
                              }}),
               Error);
  EXPECT_EQ(ask("curves"), "model");
  EXPECT_EQ(process().findPid(), pid);
}

}  // namespace
}  // namespace gaitmill
