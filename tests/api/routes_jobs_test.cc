// What the routes of jobs ask for, and what they make of the answer.

#include <chrono>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "api/event_stream.h"
#include "tests/api/route_fixture.h"

namespace gaitmill::api {
namespace {

using nlohmann::json;

class JobRoutes : public RouteFixture {
 protected:
  const std::string body_ = std::string(R"({"trial": ")") + kTrialId + "\"}";
};

TEST_F(JobRoutes, SubmitTakesANameADocumentOrNothing) {
  EXPECT_EQ(post("/v1/jobs", R"({"trial": "tri_1", "settings": "paper_walk"})").status, 202);
  EXPECT_EQ(stub_.record.request.settings_name, "paper_walk");
  post("/v1/jobs", R"({"trial": "tri_1", "settings": {"cmc": {"window_s": 0.01}}})");
  EXPECT_EQ(stub_.record.request.settings_name, "");
  EXPECT_EQ(stub_.record.request.settings_json, R"({"cmc":{"window_s":0.01}})");
  post("/v1/jobs", R"({"trial": "tri_1", "label": "again", "model": "mod_1"})");
  EXPECT_EQ(stub_.record.request.settings_name, "default");
  EXPECT_EQ(stub_.record.request.label, "again");
  EXPECT_EQ(stub_.record.request.model_id, "mod_1");
  EXPECT_EQ(errorOf([&] { post("/v1/jobs", R"({"trial": "tri_1", "settings": 3})"); }).code(),
            ErrorCode::kRequestField);
}

TEST_F(JobRoutes, SubmitAnswersWithLocationAndQueuePosition) {
  const HttpReply reply = post("/v1/jobs", body_);
  EXPECT_EQ(reply.headers.at("Location"), job_);
  EXPECT_EQ(reply.headers.count("Preference-Applied"), 0U);
  EXPECT_EQ(json::parse(reply.body)["queue_position"], 3);
  EXPECT_EQ(json::parse(reply.body)["settings_document"], json::parse(R"({"ik":{}})"));
}

TEST_F(JobRoutes, SubmitWaitsOnceAndSubmitsOnce) {
  HttpRequest request;
  request.body = makeByteSource(body_);
  request.headers["prefer"] = "respond-async, wait=120";
  const HttpReply parked = ask("POST", "/v1/jobs", request);
  ASSERT_TRUE(parked.park.has_value());
  EXPECT_EQ(parked.park->topic, kJobId);
  EXPECT_EQ(parked.park->limit, std::chrono::seconds(120));
  EXPECT_TRUE(ask("POST", "/v1/jobs", request).park.has_value());
  stub_.record.state = JobState::kSucceeded;
  const HttpReply reply = ask("POST", "/v1/jobs", request);
  EXPECT_EQ(reply.status, 202);
  EXPECT_EQ(reply.headers.at("Location"), job_);
  EXPECT_EQ(reply.headers.at("Preference-Applied"), "wait=120");
  EXPECT_EQ(json::parse(reply.body)["state"], "succeeded");
  EXPECT_EQ(stub_.record.calls,
            (std::vector<std::string>{"submit job",
                                      std::string("find job ") + kJobId,
                                      std::string("find job ") + kJobId,
                                      std::string("find job ") + kJobId}));
}

TEST_F(JobRoutes, LongPollAnswersWhenTheJobIsFinalOrTheWaitIsOver) {
  HttpRequest request;
  request.headers["prefer"] = "wait=900";
  const HttpReply parked = ask("GET", job_, request);
  ASSERT_TRUE(parked.park.has_value());
  EXPECT_EQ(parked.park->limit, std::chrono::seconds(300));
  request.wait_is_over = true;
  const HttpReply late = ask("GET", job_, request);
  EXPECT_FALSE(late.park.has_value());
  EXPECT_EQ(json::parse(late.body)["state"], "running");
  EXPECT_EQ(late.headers.at("Preference-Applied"), "wait=300");
  stub_.record.state = JobState::kFailed;
  request.wait_is_over = false;
  EXPECT_FALSE(ask("GET", job_, request).park.has_value());
}

TEST_F(JobRoutes, PreferencesThatMakeNoSenseAreIgnored) {
  for (const char* prefer : {"wait=", "wait=-1", "wait=1e3", "wait=soon", "waits=3", "", "wait"}) {
    HttpRequest request;
    request.headers["prefer"] = prefer;
    const HttpReply reply = ask("GET", job_, request);
    EXPECT_FALSE(reply.park.has_value()) << prefer;
    EXPECT_EQ(reply.headers.count("Preference-Applied"), 0U) << prefer;
  }
}

TEST_F(JobRoutes, TagOfAJobIsItsVersion) {
  EXPECT_EQ(get(job_).headers.at("ETag"), "W/\"7-0\"");
}

TEST_F(JobRoutes, CancelAndDeletionAskForThisJob) {
  EXPECT_EQ(call("POST", job_ + "/cancel").status, 202);
  EXPECT_EQ(stub_.record.calls.back(), std::string("cancel job ") + kJobId);
  EXPECT_EQ(call("DELETE", job_).status, 204);
  EXPECT_EQ(stub_.record.calls.back(), std::string("remove job ") + kJobId);
}

TEST_F(JobRoutes, ListIsNarrowedByEveryParameter) {
  const HttpReply reply = get("/v1/jobs",
                              {{"limit", "7"},
                               {"cursor", kJobId},
                               {"state", "failed"},
                               {"subject", "S07"},
                               {"label", "walk 3"},
                               {"trial", kTrialId},
                               {"study", kStudyId},
                               {"created_after", "2023-11-14T22:13:20Z"},
                               {"created_before", "2023-11-14T23:13:20.5+01:00"}});
  const ListFilter& filter = stub_.record.filter;
  EXPECT_EQ(stub_.record.page.limit, 7);
  EXPECT_EQ(stub_.record.page.cursor, kJobId);
  EXPECT_EQ(filter.state, "failed");
  EXPECT_EQ(filter.subject, "S07");
  EXPECT_EQ(filter.label, "walk 3");
  EXPECT_EQ(filter.trial_id, kTrialId);
  EXPECT_EQ(filter.study_id, kStudyId);
  EXPECT_EQ(filter.created_after, 1'700'000'000'000);
  EXPECT_EQ(filter.created_before, 1'700'000'000'500);
  EXPECT_EQ(json::parse(reply.body)["next_cursor"], nullptr);
  EXPECT_FALSE(json::parse(reply.body)["items"][0].contains("settings_document"));
}

TEST_F(JobRoutes, ListSaysWhereTheNextPageBegins) {
  stub_.record.next_cursor = kJobId;
  EXPECT_EQ(json::parse(get("/v1/jobs").body)["next_cursor"], kJobId);
  EXPECT_EQ(stub_.record.page.limit, 50);
}

struct BadQuery {
  const char* name;
  const char* value;
};
class BadListQuery : public RouteFixture, public ::testing::WithParamInterface<BadQuery> {};
TEST_P(BadListQuery, IsRefusedByItsName) {
  const Error error = errorOf([&] { get("/v1/jobs", {{GetParam().name, GetParam().value}}); });
  EXPECT_EQ(error.code(), ErrorCode::kRequestField);
  EXPECT_EQ(error.where().field, GetParam().name);
  EXPECT_TRUE(stub_.record.calls.empty());
}
INSTANTIATE_TEST_SUITE_P(Table,
                         BadListQuery,
                         ::testing::Values(BadQuery{"limit", "0"},
                                           BadQuery{"limit", "201"},
                                           BadQuery{"limit", "ten"},
                                           BadQuery{"limit", ""},
                                           BadQuery{"limit", "5 "},
                                           BadQuery{"cursor", "tri_01hf3v6k9e2m8xw7p0q4t5r6s1"},
                                           BadQuery{"cursor", "' OR 1=1 --"},
                                           BadQuery{"state", "done"},
                                           BadQuery{"subject", "two\nlines"},
                                           BadQuery{"trial", "tri_1"},
                                           BadQuery{"study", kJobId},
                                           BadQuery{"created_after", "yesterday"},
                                           BadQuery{"created_before", "2026-02-30T00:00:00Z"},
                                           BadQuery{"colour", "red"}));

TEST_F(JobRoutes, MisspeltParametersAndStatesAreAnsweredWithTheNearestName) {
  EXPECT_EQ(errorOf([&] {
              get("/v1/jobs", {{"limits", "5"}});
            }).message(),
            "there is no parameter of this name; did you mean 'limit'?");
  EXPECT_NE(errorOf([&] {
              get("/v1/jobs", {{"state", "suceeded"}});
            })
                .message()
                .find("did you mean 'succeeded'?"),
            std::string::npos);
}

// --- server-sent events ---

JobEvent makeEvent(std::int64_t id, const std::string& kind, const std::string& data) {
  return {id, 1'700'000'000'000, kind, data};
}

TEST_F(JobRoutes, EventsComeFromTheBeginningAndEndWithTheJob) {
  stub_.record.events = {makeEvent(1, "state", R"({"state":"running"})")};
  const HttpReply reply = get(job_ + "/events");
  ASSERT_TRUE(reply.events.has_value());
  EXPECT_EQ(reply.events->topic, kJobId);
  bool ended = false;
  EXPECT_EQ(reply.events->next(ended),
            "id: 1\nevent: state\ndata: "
            R"({"at":"2023-11-14T22:13:20.000Z","state":"running"})"
            "\n\n");
  EXPECT_FALSE(ended);
  EXPECT_EQ(reply.events->next(ended), "");
  EXPECT_FALSE(ended);
  stub_.record.events.push_back(makeEvent(2, "stage", R"({"stage":"ik"})"));
  stub_.record.events.push_back(makeEvent(3, "state", R"({"state":"succeeded"})"));
  const std::string rest = reply.events->next(ended);
  EXPECT_EQ(rest.substr(0, 5), "id: 2");
  EXPECT_NE(rest.find("\n\nid: 3\nevent: state\n"), std::string::npos);
  EXPECT_TRUE(ended);
}

TEST_F(JobRoutes, EventsResumeAfterTheLastOneSeen) {
  stub_.record.events = {makeEvent(1, "stage", R"({"stage":"scale"})"),
                         makeEvent(2, "stage", R"({"stage":"ik"})")};
  HttpRequest request;
  request.headers["last-event-id"] = "1";
  bool ended = false;
  EXPECT_EQ(call("GET", job_ + "/events", request).events->next(ended).substr(0, 5), "id: 2");
  EXPECT_EQ(get(job_ + "/events", {{"last_event_id", "1"}}).events->next(ended).substr(0, 5),
            "id: 2");
  EXPECT_EQ(errorOf([&] {
              get(job_ + "/events", {{"last_event_id", "x"}});
            })
                .where()
                .field,
            "last_event_id");
}

TEST_F(JobRoutes, StreamOfAnEndedJobEndsEvenIfAllWasSeen) {
  stub_.record.state = JobState::kCancelled;
  stub_.record.events = {makeEvent(1, "state", R"({"state":"cancelled"})")};
  bool ended = false;
  EXPECT_EQ(get(job_ + "/events", {{"last_event_id", "1"}}).events->next(ended), "");
  EXPECT_TRUE(ended);
}

TEST_F(JobRoutes, StreamEndsWhenItsJobIsDeleted) {
  const HttpReply reply = get(job_ + "/events");
  stub_.record.failure = Error(ErrorCode::kJobNotFound, "gone");
  bool ended = false;
  EXPECT_EQ(reply.events->next(ended), "");
  EXPECT_TRUE(ended);
}

}  // namespace
}  // namespace gaitmill::api
