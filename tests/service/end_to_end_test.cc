// What a client does from upload to removal: a real socket, a real database file, real solver
// processes with the fake pipeline.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "service/backup_command.h"
#include "service/observe/log.h"
#include "service/service.h"
#include "tests/http/http_client.h"
#include "tests/service/fake_pipeline.h"
#include "tests/service/zip_reader.h"
#include "tests/support/temporary_folder.h"

namespace gaitmill {
namespace {

using nlohmann::json;

const std::vector<ClientPart> kTrial = {
    {"markers", "walk.trc", "the bytes"},
    {"trial", "", R"({"mass_kg": 75.3, "height_m": 1.7, "marker_set": "lab_a"})"}};

void writeModels(const TemporaryFolder& folder) {
  folder.write("models/settings/default.json", "{}");
  folder.write("models/settings/slow.json", R"({"steps": 20, "step_ms": 10})");
  folder.write("models/marker_sets/lab_a.json", R"({"markers": ["RASI", "LASI"]})");
}

// A service that may be stopped and started again on the same database.
class EndToEndTest : public ::testing::Test {
 protected:
  void SetUp() override {
    setUpLog("off", "text");
    writeModels(folder_);
    config_.db = folder_ / "mill.db";
    config_.models = folder_ / "models";
    config_.spool = folder_.path();
    config_.port = 0;
    config_.workers = 2;
    config_.stop_limit_s = 0.5;
    startService();
  }
  void TearDown() override { stopService(); }

  void startService() {
    service_ = std::make_unique<Service>(config_, makeFakePipeline(), FAKE_SERVICE);
    client_ = std::make_unique<HttpClient>(service_->start());
  }
  void stopService() {
    if (service_ != nullptr) {
      EXPECT_TRUE(service_->stop());
      service_.reset();
    }
  }

  std::string uploadTrial(const std::string& bytes = "the bytes") {
    std::vector<ClientPart> parts = kTrial;
    parts[0].bytes = bytes;
    const ClientReply reply = client_->upload("/v1/trials", parts);
    EXPECT_EQ(reply.status, 201) << reply.body;
    return reply.json()["id"];
  }
  std::string submitJob(const json& settings) {
    const json request{{"trial", uploadTrial()}, {"settings", settings}};
    const ClientReply reply = client_->post("/v1/jobs", request.dump());
    EXPECT_EQ(reply.status, 202) << reply.body;
    return reply.json()["id"];
  }
  // A request with any method and headers. @returns the whole answer as it came
  std::string send(const std::string& method,
                   const std::string& path,
                   const std::map<std::string, std::string>& headers = {},
                   const std::string& body = "") const {
    std::string request = method + " " + path + " HTTP/1.1\r\nHost: localhost\r\n";
    for (const auto& [name, value] : headers) {
      request += name + ": " + value + "\r\n";
    }
    request += "Content-Length: " + std::to_string(body.size()) + "\r\nConnection: close\r\n\r\n";
    return client_->sendRaw(request + body);
  }
  static int statusOf(const std::string& reply) {
    return reply.size() < 12 ? 0 : std::stoi(reply.substr(9, 3));
  }
  bool isOnDisk(const std::string& bytes) const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      if (entry.is_regular_file()) {
        std::ifstream file(entry.path(), std::ios::binary);
        const std::string content{std::istreambuf_iterator<char>(file), {}};
        if (content.find(bytes) != std::string::npos) {
          return true;
        }
      }
    }
    return false;
  }

  TemporaryFolder folder_;
  ServeConfig config_;
  std::unique_ptr<Service> service_;
  std::unique_ptr<HttpClient> client_;
};

TEST_F(EndToEndTest, ArchiveHoldsTheJobAndComesInRanges) {
  const std::string id = submitJob({{"steps", 3}});
  EXPECT_EQ(client_->get("/v1/jobs/" + id + "/results.zip").status, 409);
  client_->waitForState(id, {"succeeded"});
  const std::string path = "/v1/jobs/" + id + "/results.zip";
  const ClientReply whole = client_->get(path);
  ASSERT_EQ(whole.status, 200);
  std::map<std::string, std::string> files;
  for (const auto& [name, bytes] : readZip(whole.body)) {
    files[name] = bytes;
  }
  EXPECT_EQ(files["inputs/markers/walk.trc"], "the bytes");
  EXPECT_EQ(json::parse(files["settings.json"])["steps"], 3);
  EXPECT_EQ(files.count("results/moments.csv"), 1U);
  EXPECT_EQ(files.count("SHA256SUMS"), 1U);
  const ClientReply part = client_->get(path, {{"Range", "bytes=10-19"}});
  EXPECT_EQ(part.status, 206);
  EXPECT_EQ(part.body, whole.body.substr(10, 10));
  const std::string etag = whole.headers.at("ETag");
  EXPECT_EQ(client_->get(path, {{"If-None-Match", etag}}).status, 304);
}

// The gate of CMC is opened only after the results of ID have been read.
TEST_F(EndToEndTest, ResultsOfFinishedStagesAreReadableWhileLaterStagesRun) {
  const std::string gate = folder_ / "gate";
  for (const char* stage : {"scale", "ik", "rra", "id"}) {
    folder_.write(std::string("gate.") + stage, "");
  }
  const std::string id = submitJob({{"gate", gate}});
  const std::string moments = "/v1/jobs/" + id + "/results/moments";
  ClientReply reply = client_->get(moments);
  for (; reply.status != 200; reply = client_->get(moments)) {
    ASSERT_EQ(reply.json()["code"], "result.not_ready");
  }
  const json early = reply.json();
  EXPECT_EQ(early["stage"], "id");
  EXPECT_FALSE(early["final"].get<bool>());
  EXPECT_EQ(client_->get("/v1/jobs/" + id).json()["state"], "running");
  EXPECT_EQ(client_->get("/v1/jobs/" + id + "/results/activations").status, 409);
  folder_.write("gate.so", "");
  folder_.write("gate.cmc", "");
  client_->waitForState(id, {"succeeded"});
  const json late = client_->get(moments).json();
  EXPECT_EQ(late["stage"], "cmc");
  EXPECT_TRUE(late["final"].get<bool>());
}

TEST_F(EndToEndTest, DeletedJobAndTrialAreNotOnTheDiskAnyMore) {
  const std::string secret = "Jane Doe, born 1970-01-01";
  const std::string trial = uploadTrial(secret);
  const ClientReply reply = client_->post("/v1/jobs", json{{"trial", trial}}.dump());
  const std::string job = reply.json()["id"];
  client_->waitForState(job, {"succeeded"});
  EXPECT_TRUE(isOnDisk(secret));
  EXPECT_EQ(statusOf(send("DELETE", "/v1/trials/" + trial)), 409) << "a job refers to it";
  EXPECT_EQ(statusOf(send("DELETE", "/v1/jobs/" + job)), 204);
  EXPECT_EQ(statusOf(send("DELETE", "/v1/trials/" + trial)), 204);
  EXPECT_EQ(client_->get("/v1/trials/" + trial).status, 404);
  EXPECT_FALSE(isOnDisk(secret));
}

TEST_F(EndToEndTest, StudyOfTwoTrialsTimesTwoSettingsGivesATable) {
  const json request{{"name", "shoes"},
                     {"trials", {uploadTrial("one"), uploadTrial("two")}},
                     {"settings", {"default", {{"steps", 2}}}}};
  const ClientReply reply = client_->post("/v1/studies", request.dump());
  ASSERT_EQ(reply.status, 202) << reply.body;
  const std::string path = reply.headers.at("Location");
  const json study = client_->get(path).json();
  EXPECT_EQ(study["jobs"].size(), 4U);
  for (const json& id : study["jobs"]) {
    client_->waitForState(id, {"succeeded"});
  }
  EXPECT_EQ(client_->get(path).json()["progress"], 1.0);
  const std::string csv = client_->get(path + "/results?format=csv").body;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5) << csv;
}

TEST_F(EndToEndTest, RepeatedRequestIsAnsweredAsTheFirstAlsoAfterARestart) {
  const std::map<std::string, std::string> headers = {{"Idempotency-Key", "monday"},
                                                      {"Content-Type", "application/json"}};
  const std::string body = json{{"trial", uploadTrial()}}.dump();
  const auto idOfAnswer = [](const std::string& reply) {
    return json::parse(reply.substr(reply.find("\r\n\r\n") + 4))["id"].get<std::string>();
  };
  const std::string first = send("POST", "/v1/jobs", headers, body);
  ASSERT_EQ(statusOf(first), 202) << first;
  const std::string again = send("POST", "/v1/jobs", headers, body);
  EXPECT_EQ(idOfAnswer(again), idOfAnswer(first));
  EXPECT_NE(again.find("Idempotency-Replayed: true"), std::string::npos);
  EXPECT_EQ(statusOf(send("POST", "/v1/jobs", headers, body + " ")), 422);
  stopService();
  startService();
  EXPECT_EQ(idOfAnswer(send("POST", "/v1/jobs", headers, body)), idOfAnswer(first));
  EXPECT_EQ(client_->get("/v1/jobs").json()["items"].size(), 1U);
}

TEST_F(EndToEndTest, ConcurrentRequestsWithOneKeyMakeOneJob) {
  const std::map<std::string, std::string> headers = {{"Idempotency-Key", "monday"},
                                                      {"Content-Type", "application/json"}};
  const std::string body = json{{"trial", uploadTrial()}}.dump();
  std::vector<std::thread> clients;
  std::vector<int> statuses(8);
  for (std::size_t i = 0; i < statuses.size(); ++i) {
    clients.emplace_back(
        [&, i] { statuses[i] = statusOf(send("POST", "/v1/jobs", headers, body)); });
  }
  for (std::thread& client : clients) {
    client.join();
  }
  for (const int status : statuses) {
    EXPECT_TRUE(status == 202 || status == 409) << status;
  }
  EXPECT_EQ(client_->get("/v1/jobs").json()["items"].size(), 1U);
}

TEST_F(EndToEndTest, BackupOfALiveServiceRestoresElsewhere) {
  const std::string done = submitJob({{"steps", 2}});
  client_->waitForState(done, {"succeeded"});
  const std::string moments = client_->get("/v1/jobs/" + done + "/results/moments").body;
  submitJob({{"steps", 400}, {"step_ms", 2}});
  std::ostringstream said;
  backUp({config_.db, folder_ / "backup.db"}, said);
  const std::string after = submitJob({{"steps", 2}});
  stopService();

  config_.db = folder_ / "restored.db";
  restore({config_.db, folder_ / "backup.db", RestoreOptions::Overwrite::kNo}, said);
  startService();
  EXPECT_EQ(client_->get("/v1/jobs/" + done + "/results/moments").body, moments);
  EXPECT_EQ(client_->get("/v1/jobs/" + after).status, 404) << "submitted after the backup";
  const json jobs = client_->get("/v1/jobs").json();
  EXPECT_EQ(jobs["items"].size(), 2U);
  for (const json& job : jobs["items"]) {
    EXPECT_EQ(client_->waitForState(job["id"], {"succeeded", "failed"})["state"], "succeeded");
  }
}

TEST_F(EndToEndTest, FullDatabaseRefusesUploadsAndStillAnswersReads) {
  const std::string id = submitJob({{"steps", 2}});
  client_->waitForState(id, {"succeeded"});
  stopService();
  config_.max_db_mb = 1;
  startService();
  std::string bytes;
  unsigned int state = 1;
  while (bytes.size() < 3U << 20U) {
    state = state * 1664525U + 1013904223U;
    bytes += static_cast<char>(state >> 24U);
  }
  std::vector<ClientPart> parts = kTrial;
  parts[0].bytes = bytes;
  const ClientReply refused = client_->upload("/v1/trials", parts);
  EXPECT_EQ(refused.status, 507) << refused.body;
  EXPECT_EQ(client_->get("/v1/jobs/" + id + "/results/moments").status, 200);
  stopService();
  config_.max_db_mb = 0;
  startService();
  EXPECT_EQ(client_->upload("/v1/trials", parts).status, 201) << "once there is room again";
}

}  // namespace
}  // namespace gaitmill
