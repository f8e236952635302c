#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "service/storage/job_store.h"
#include "tests/service/storage/storage_fixture.h"

namespace gaitmill {
namespace {

using JobResultsTest = StorageTest;

TEST_F(JobResultsTest, ComeWithTheirStageOrTheEnd) {
  const std::string id = submit();
  const JobTicket ticket = claim();
  const auto read = [&](ResultKind kind, const std::string& name) {
    return jobs_.readResult(kTenant, id, kind, name);
  };
  EXPECT_EQ(codeOf([&] { read(ResultKind::kTime, "moments"); }), ErrorCode::kResultNotReady);
  jobs_.saveStage(ticket, {"id", "c", {{ResultKind::kTime, "moments", "first", ""}}, {}, {}});
  EXPECT_EQ(read(ResultKind::kTime, "moments").bytes, "first");
  EXPECT_EQ(codeOf([&] { read(ResultKind::kCycle, "moments"); }), ErrorCode::kResultNotReady);
  EXPECT_TRUE(jobs_.succeed(ticket,
                            {{ResultKind::kFile, "ik.mot", "bytes", "ik"},
                             {ResultKind::kTime, "moments", "second", "cmc"}},
                            "warn"));
  EXPECT_EQ(find(id).verdict, "warn");
  EXPECT_EQ(read(ResultKind::kTime, "moments").bytes, "second");
  EXPECT_EQ(read(ResultKind::kTime, "moments").info.stage, "cmc");
  const api::FileContent file = jobs_.readFile(kTenant, id, "ik.mot");
  EXPECT_EQ(api::readAll(*file.bytes, 100), "bytes");
  EXPECT_EQ(file.view.size, 5);
  EXPECT_EQ(jobs_.listFiles(kTenant, id).size(), 1U);
  EXPECT_EQ(jobs_.listResults(kTenant, id).size(), 2U);
  EXPECT_EQ(codeOf([&] { jobs_.readFile(kTenant, id, "moments"); }), ErrorCode::kResultNotFound);
}

TEST_F(JobResultsTest, AreCompressedAndComeBackBitForBit) {
  const std::string id = submit();
  const std::string text(2'000'000, 'a');
  const std::string noise = makeNoise(2'000'000, 1);
  jobs_.succeed(claim(),
                {{ResultKind::kFile, "text", text, ""}, {ResultKind::kFile, "noise", noise, ""}},
                "pass");
  EXPECT_TRUE(jobs_.readResult(kTenant, id, ResultKind::kFile, "text").bytes == text);
  EXPECT_TRUE(jobs_.readResult(kTenant, id, ResultKind::kFile, "noise").bytes == noise);
  EXPECT_LT(queryInteger(database_, "SELECT length(bytes) FROM results WHERE name = 'text'"),
            10'000);
  EXPECT_EQ(queryText(database_, "SELECT encoding FROM results WHERE name = 'noise'"), "raw");
}

TEST_F(JobResultsTest, DamagedOnesAreNotHandedOut) {
  const std::string id = submit();
  jobs_.succeed(claim(),
                {{ResultKind::kFile, "raw", "bytes", ""},
                 {ResultKind::kFile, "packed", std::string(1000, 'x'), ""}},
                "pass");
  tamper(database_, "UPDATE results SET bytes = 'bytez'");
  EXPECT_EQ(codeOf([&] { jobs_.readFile(kTenant, id, "raw"); }), ErrorCode::kStorage);
  EXPECT_EQ(codeOf([&] { jobs_.readFile(kTenant, id, "packed"); }), ErrorCode::kStorage);
}

TEST_F(JobResultsTest, DamagedCheckpointsAreNotHandedOut) {
  const std::string id = submit();
  jobs_.saveStage(claim(), {"ik", std::string(1000, 'x'), {}, {}, {}});
  EXPECT_EQ(jobs_.readCheckpoints(id), std::vector<std::string>{std::string(1000, 'x')});
  tamper(database_, "UPDATE checkpoints SET bytes = 'bytez'");
  EXPECT_EQ(codeOf([&] { jobs_.readCheckpoints(id); }), ErrorCode::kStorage);
}

TEST_F(JobResultsTest, CheckpointsGoWithTheEnd) {
  for (int end = 0; end < 3; ++end) {
    const std::string id = submit();
    const JobTicket ticket = claim();
    jobs_.saveStage(ticket, {"ik", "c", {}, {}, {}});
    jobs_.saveStage(ticket, {"ik", "again", {}, {}, {}});
    EXPECT_EQ(jobs_.readCheckpoints(id), std::vector<std::string>{"again"});
    const bool ended = end == 0   ? jobs_.succeed(ticket, {}, "pass")
                       : end == 1 ? jobs_.fail(ticket, Error(ErrorCode::kInternal, ""))
                                  : jobs_.cancelRunning(ticket);
    EXPECT_TRUE(ended);
    EXPECT_TRUE(jobs_.readCheckpoints(id).empty());
  }
}

}  // namespace
}  // namespace gaitmill
