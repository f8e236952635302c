#include "service/result_service.h"

#include <gtest/gtest.h>

#include "tests/service/expect_error.h"
#include "tests/service/fake_pipeline.h"
#include "tests/service/port_fixture.h"

namespace gaitmill {
namespace {

class ResultServiceTest : public ::testing::Test {
 protected:
  api::ResultPort& results() { return fixture_.ports().results; }

  PortFixture fixture_;
  const api::Identity who_ = makeMember("gait lab");
};

TEST_F(ResultServiceTest, TableComesWithWhereItComesFrom) {
  const std::string id = fixture_.addFinishedJob(who_, R"({"steps": 3})");
  const api::ResultTable moments = results().findTable(who_, id, "moments", api::TableAxis::kTime);
  EXPECT_EQ(moments.table.labels, makeFakeTable("moments").labels);
  EXPECT_EQ(moments.stage, "cmc");
  EXPECT_TRUE(moments.is_final);
  EXPECT_EQ(moments.settings_json, R"({"steps":3})");
  EXPECT_EQ(moments.provenance, fixture_.ports().jobs.find(who_, id).provenance);
  EXPECT_ERROR(results().findTable(who_, id, "forces", api::TableAxis::kCycle),
               ErrorCode::kResultNotFound);
}

TEST_F(ResultServiceTest, FinishedStagesAreReadableWhileLaterOnesRun) {
  fixture_.addJob(who_, fixture_.addTrial(who_));
  const std::string id = fixture_.runNextJob("id").job_id;
  const api::ResultTable moments = results().findTable(who_, id, "moments", api::TableAxis::kTime);
  EXPECT_EQ(moments.stage, "id");
  EXPECT_FALSE(moments.is_final);
  EXPECT_ERROR(results().findTable(who_, id, "activations", api::TableAxis::kTime),
               ErrorCode::kResultNotReady);
  EXPECT_ERROR(results().findQuality(who_, id), ErrorCode::kResultNotReady);
  EXPECT_ERROR(results().makeArchive(who_, id), ErrorCode::kResultNotReady);
  EXPECT_EQ(readSource(*results().findFile(who_, id, "ik.txt").bytes), "what ik leaves\n");
}

TEST_F(ResultServiceTest, ListNamesEachResultOnceInTheContractsOrder) {
  const std::string id = fixture_.addFinishedJob(who_);
  const auto list = results().list(who_, id);
  ASSERT_EQ(list.size(), 6U);
  EXPECT_EQ(list.front().name, "moments");
  EXPECT_EQ(list.front().stage, "cmc");
  EXPECT_TRUE(list.front().has_cycle);
  EXPECT_EQ(list[1].name, "activations");
  EXPECT_FALSE(list[1].has_cycle);
  EXPECT_EQ(list.back().name, "quality");
}

}  // namespace
}  // namespace gaitmill
