// Figures, images, reports, comparisons and validations over a real database, drawn by a real child
// of the fake service.

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "service/observe/log.h"
#include "service/picture_data.h"
#include "service/stored_results.h"
#include "tests/service/expect_error.h"
#include "tests/service/fake_pipeline.h"
#include "tests/service/port_fixture.h"

namespace gaitmill {
namespace {

using nlohmann::json;

class ViewServicesTest : public ::testing::Test {
 protected:
  void SetUp() override { setUpLog("off", "text"); }

  api::ImageFile paint(const std::string& job, const api::ImageRequest& request = {}) {
    return ports_.images.paint(who_, job, request);
  }
  std::string textOf(const api::ImageFile& image) { return readSource(*image.bytes); }
  static std::vector<std::string> namesOf(const std::vector<FigureInfo>& list) {
    std::vector<std::string> names;
    for (const FigureInfo& info : list) {
      names.push_back(info.name);
    }
    return names;
  }

  PortFixture fixture_;
  api::Ports ports_ = fixture_.ports();
  const api::Identity who_ = makeMember("gait lab", "key_a");
};

TEST_F(ViewServicesTest, StoredResultsAreThoseOfTheJob) {
  const std::string id = fixture_.addFinishedJob(who_);
  const StoredResults results(fixture_.stores().jobs, who_.tenant, id);
  EXPECT_TRUE(results.has("moments", ResultSource::Axis::kTime));
  EXPECT_TRUE(results.has("moments", ResultSource::Axis::kCycle));
  EXPECT_FALSE(results.has("activations", ResultSource::Axis::kCycle));
  const TimeSeries& moments = results.table("moments", ResultSource::Axis::kTime);
  EXPECT_EQ(moments.labels, makeFakeTable("moments").labels);
  EXPECT_EQ(&moments, &results.table("moments", ResultSource::Axis::kTime));
  EXPECT_ERROR(results.table("nothing", ResultSource::Axis::kTime), ErrorCode::kResultNotFound);
  EXPECT_TRUE(json::parse(results.summary()).contains("quality"));
}

TEST_F(ViewServicesTest, CycleSpanIsReadFromAnySummary) {
  EXPECT_EQ(findCycleSpan(R"({"gait_cycle_s": [0.5, 1.75]})").end, 1.75);
  for (const char* summary : {"",
                              "{}",
                              "[]",
                              R"({"gait_cycle_s": null})",
                              R"({"gait_cycle_s": [1]})",
                              R"({"gait_cycle_s": ["a", "b"]})",
                              R"({"gait_cycle_s": {"a": 1, "b": 2}})"}) {
    EXPECT_FALSE(findCycleSpan(summary).exists()) << summary;
  }
}

TEST_F(ViewServicesTest, FiguresComeWithTheStagesThatMakeTheirTables) {
  const std::string id = fixture_.addJob(who_, fixture_.addTrial(who_));
  EXPECT_TRUE(ports_.figures.list(who_, id).empty());
  EXPECT_ERROR(ports_.figures.find(who_, id, "moments"), ErrorCode::kResultNotReady);
  const std::string before = ports_.figures.findTag(who_, id);
  fixture_.runNextJob("id");
  EXPECT_EQ(namesOf(ports_.figures.list(who_, id)), std::vector<std::string>{"moments"});
  EXPECT_EQ(ports_.figures.find(who_, id, "moments").panels.size(), 1U);
  EXPECT_NE(ports_.figures.findTag(who_, id), before);
  EXPECT_ERROR(ports_.figures.find(who_, id, "activations"), ErrorCode::kResultNotReady);
}

TEST_F(ViewServicesTest, UnknownFigureOfAFinishedJobIsNotFound) {
  const std::string id = fixture_.addFinishedJob(who_);
  EXPECT_ERROR(ports_.figures.find(who_, id, "momments"), ErrorCode::kFigureNotFound);
}

// Equal work has equal tags, whoever did it and when; other settings have others.
TEST_F(ViewServicesTest, TagsFollowTheProvenance) {
  const std::string first = fixture_.addFinishedJob(who_);
  const std::string again = fixture_.addFinishedJob(who_);
  const std::string other = fixture_.addFinishedJob(who_, R"({"steps": 3})");
  EXPECT_EQ(ports_.figures.findTag(who_, first), ports_.figures.findTag(who_, again));
  EXPECT_NE(ports_.figures.findTag(who_, first), ports_.figures.findTag(who_, other));
  EXPECT_EQ(ports_.images.findTag(who_, first, {}), ports_.images.findTag(who_, again, {}));
  api::ImageRequest small;
  small.width = 400;
  EXPECT_NE(ports_.images.findTag(who_, first, {}), ports_.images.findTag(who_, first, small));
  EXPECT_NE(ports_.reports.findTag(who_, first), ports_.reports.findTag(who_, again))
      << "the report names the job";
}

TEST_F(ViewServicesTest, ImageIsDrawnOnceAndKept) {
  const std::string id = fixture_.addFinishedJob(who_);
  EXPECT_EQ(textOf(paint(id)), "picture of 3 rows at 0.00");
  fixture_.services().drawing().stop();
  EXPECT_EQ(textOf(paint(id)), "picture of 3 rows at 0.00");
  api::ImageRequest later;
  later.time = 0.5;
  EXPECT_ERROR(paint(id, later), ErrorCode::kRequestBusy);
}

TEST_F(ViewServicesTest, ImagesAskForAMotionAndForWhatThereIs) {
  const std::string waiting = fixture_.addJob(who_, fixture_.addTrial(who_));
  EXPECT_ERROR(paint(waiting), ErrorCode::kResultNotReady);
  fixture_.runNextJob();
  api::ImageRequest request;
  request.percent = 50;
  EXPECT_ERROR(paint(waiting, request), ErrorCode::kRequestField);  // it has no gait cycle
  request = {};
  request.view = "from above";
  EXPECT_ERROR(paint(waiting, request), ErrorCode::kRequestField);
  request = {};
  request.kind = api::ImageKind::kAnimation;
  request.slow_down = 100;
  EXPECT_ERROR(paint(waiting, request), ErrorCode::kImageSize);
}

TEST_F(ViewServicesTest, ChildThatDiesOverAnImageIsOneError) {
  const std::string id = fixture_.addFinishedJob(who_);
  api::ImageRequest deadly;
  deadly.width = 666;
  EXPECT_ERROR(paint(id, deadly), ErrorCode::kRender);
  EXPECT_EQ(textOf(paint(id)), "picture of 3 rows at 0.00");
}

TEST_F(ViewServicesTest, ReportHoldsFiguresPicturesAndInputs) {
  const std::string id = fixture_.addFinishedJob(who_);
  const std::string report = ports_.reports.render(who_, id);
  const std::string hash =
      ports_.trials.find(who_, ports_.jobs.find(who_, id).trial_id).files.front().sha256;
  for (const std::string& part : {id,
                                  std::string("The moments"),
                                  std::string("Right heel strike, 0.00 s: picture of"),
                                  std::string("Right toe-off, 1.00 s: picture of"),
                                  "markers " + hash}) {
    EXPECT_NE(report.find(part), std::string::npos) << part << " in " << report;
  }
  fixture_.services().drawing().stop();
  EXPECT_EQ(ports_.reports.render(who_, id), report);
}

TEST_F(ViewServicesTest, VerdictAndReportWaitForTheEnd) {
  const std::string id = fixture_.addJob(who_, fixture_.addTrial(who_));
  EXPECT_ERROR(ports_.reports.render(who_, id), ErrorCode::kResultNotReady);
  EXPECT_ERROR(ports_.reports.findQuality(who_, id), ErrorCode::kResultNotReady);
  fixture_.runNextJob();
  const json quality = json::parse(ports_.reports.findQuality(who_, id));
  EXPECT_EQ(quality["verdict"], "pass");
  EXPECT_EQ(quality["figures"]["moments"]["ankle_angle_r"]["rmse_nm"], 0.25);
  EXPECT_EQ(quality["report"], "/v1/jobs/" + id + "/report.html");
}

TEST_F(ViewServicesTest, ComparisonTakesFinishedJobsInTheirOrder) {
  const std::string first = fixture_.addFinishedJob(who_);
  const std::string second = fixture_.addFinishedJob(who_, R"({"steps": 3})");
  const api::ComparisonView view = ports_.comparisons.compare(who_, {second, first});
  EXPECT_EQ(view.comparison.labels, (std::vector<std::string>{second, first}));
  EXPECT_EQ(namesOf(view.figures), (std::vector<std::string>{"moments", "activations"}));
  EXPECT_EQ(ports_.comparisons.find(who_, {first, second}, "moments").name, "moments");
  EXPECT_NE(ports_.comparisons.findTag(who_, {first, second}),
            ports_.comparisons.findTag(who_, {second, first}));
  const std::string waiting = fixture_.addJob(who_, fixture_.addTrial(who_));
  EXPECT_ERROR(ports_.comparisons.compare(who_, {first, waiting}), ErrorCode::kResultNotReady);
}

TEST_F(ViewServicesTest, ValidationsAreMadeByTheChildAndKept) {
  const std::string id = ports_.models.add(who_, "m", R"({"markers": ["A"]})").id;
  EXPECT_EQ(namesOf(ports_.validations.list(who_, id)),
            (std::vector<std::string>{"curves", "moment_arms"}));
  EXPECT_EQ(ports_.validations.find(who_, id, "curves", 1).caption, R"({"markers": ["A"]})");
  EXPECT_ERROR(ports_.validations.find(who_, id, "cuves", 1), ErrorCode::kFigureNotFound);
  EXPECT_ERROR(ports_.validations.find(who_, id, "crash", 1), ErrorCode::kRender);
  fixture_.services().drawing().stop();
  EXPECT_EQ(ports_.validations.find(who_, id, "curves", 1).name, "curves");
  EXPECT_ERROR(ports_.validations.find(who_, id, "curves", 2), ErrorCode::kRequestBusy);
  EXPECT_NE(ports_.validations.findTag(who_, id, 1), ports_.validations.findTag(who_, id, 2));
}

// The quota holds over all images of a job; deleting it gives them back.
TEST(ImageQuota, CountsPixelsAndGivesThemBack) {
  setUpLog("off", "text");
  Quota quota;
  quota.pixels = 2 * 1280 * 720;
  PortFixture fixture(quota);
  api::Ports ports = fixture.ports();
  const api::Identity who = makeMember("gait lab", "key_a");
  const std::string id = fixture.addFinishedJob(who);
  const auto paint = [&](const std::string& job, double time) {
    api::ImageRequest request;
    request.time = time;
    ports.images.paint(who, job, request);
  };
  paint(id, 0.0);
  paint(id, 0.0);  // from the cache
  paint(id, 0.5);
  EXPECT_ERROR(paint(id, 1.0), ErrorCode::kQuotaExceeded);
  ports.jobs.remove(who, id);
  paint(fixture.addFinishedJob(who, R"({"steps": 3})"), 1.0);
}

}  // namespace
}  // namespace gaitmill
