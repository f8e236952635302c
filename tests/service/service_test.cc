// End to end: a real socket, a real database file, the fake pipeline.

#include "service/service.h"

#include <csignal>
#include <memory>
#include <set>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "service/observe/log.h"
#include "tests/http/http_client.h"
#include "tests/service/child_process.h"
#include "tests/service/fake_pipeline.h"
#include "tests/service/observe/exposition.h"
#include "tests/support/temporary_folder.h"

namespace gaitmill {
namespace {

using nlohmann::json;

const std::vector<ClientPart> kTrial = {
    {"markers", "walk.trc", "the bytes"},
    {"trial", "", R"({"mass_kg": 75.3, "height_m": 1.7, "marker_set": "lab_a"})"}};

void writeSettings(const TemporaryFolder& folder) {
  folder.write("models/settings/default.json", "{}");
  folder.write("models/marker_sets/lab_a.json", R"({"markers": ["RASI"]})");
  folder.write("models/settings/slow.json", R"({"steps": 20, "step_ms": 10})");
}

class ServiceTest : public ::testing::Test {
 protected:
  void SetUp() override {
    setUpLog("off");
    writeSettings(folder_);
    startService();
  }

  void startService() {
    config_.db = folder_ / "mill.db";
    config_.models = folder_ / "models";
    config_.port = 0;
    config_.workers = 2;
    config_.spool = folder_.path();
    config_.stop_limit_s = 0.2;
    service_ = std::make_unique<Service>(config_, makeFakePipeline(), FAKE_SERVICE);
    client_ = std::make_unique<HttpClient>(service_->start());
  }

  std::string uploadTrial() { return client_->upload("/v1/trials", kTrial).json()["id"]; }

  std::string submitJob(const json& settings) {
    const json request{{"trial", uploadTrial()}, {"settings", settings}};
    const ClientReply reply = client_->post("/v1/jobs", request.dump());
    EXPECT_EQ(reply.status, 202) << reply.body;
    return reply.json()["id"];
  }

  TemporaryFolder folder_;
  ServeConfig config_;
  std::unique_ptr<Service> service_;
  std::unique_ptr<HttpClient> client_;
};

TEST_F(ServiceTest, TrialGoesInAndResultsComeOut) {
  const ClientReply trial = client_->upload("/v1/trials", kTrial);
  ASSERT_EQ(trial.status, 201) << trial.body;
  EXPECT_EQ(trial.headers.at("Location"), "/v1/trials/" + trial.json()["id"].get<std::string>());
  EXPECT_EQ(trial.json()["files"][0]["markers"], json({"RASI", "LASI"}));
  EXPECT_EQ(client_->get(trial.headers.at("Location")).json(), trial.json());

  const ClientReply job = client_->post("/v1/jobs", json{{"trial", trial.json()["id"]}}.dump());
  ASSERT_EQ(job.status, 202) << job.body;
  const std::string id = job.json()["id"];
  EXPECT_EQ(job.headers.at("Location"), "/v1/jobs/" + id);
  const json done = client_->waitForState(id, {"succeeded", "failed"});
  EXPECT_EQ(done["state"], "succeeded") << done;
  EXPECT_EQ(done["progress"], 1.0);
  ASSERT_EQ(done["stages"].size(), 6U);
  EXPECT_EQ(done["stages"][5]["stage"], "cmc");

  const std::string results = "/v1/jobs/" + id + "/results/";
  const json moments = client_->get(results + "moments").json();
  EXPECT_EQ(moments["axis"]["values"], json({0.0, 0.5, 1.0}));
  EXPECT_EQ(moments["columns"][0]["unit"], "N.m");
  EXPECT_EQ(moments["columns"][0]["values"], json({1.5, nullptr, -2.0}));
  EXPECT_EQ(client_->get(results + "moments?format=csv").body,
            "time [s],hip_flexion_r [N.m],hip_angle [rad]\n0,1.5,0.1\n0.5,,0.2\n1,-2,0.3\n");
  EXPECT_EQ(client_->get(results + "quality", {{"Accept", "text/csv"}}).body,
            "quantity,value\nmoments.ankle_angle_r.rmse_nm,0.25\n");
  EXPECT_EQ(client_->get("/v1/jobs/" + id + "/files/scaled_model.osim").body, "the bytes");
}

TEST_F(ServiceTest, FailedStageSaysWhere) {
  const json job = client_->waitForState(submitJob({{"fail_at", "rra"}}), {"failed"});
  EXPECT_EQ(job["error"]["code"], "input.markers");
  EXPECT_EQ(
      job["error"]["where"],
      (json{
          {"file", "walk.trc"}, {"line", 7}, {"column", 3}, {"field", "RASI"}, {"stage", "rra"}}));
  EXPECT_EQ(job["error"]["context"], json({"rra"}));
}

TEST_F(ServiceTest, RunningJobIsCancelledAtItsNextStep) {
  const std::string id = submitJob({{"steps", 10000}, {"step_ms", 2}});
  client_->waitForState(id, {"running"});
  EXPECT_EQ(client_->get("/v1/jobs/" + id + "/results/moments").status, 409);
  EXPECT_EQ(client_->post("/v1/jobs/" + id + "/cancel", "").status, 202);
  const json job = client_->waitForState(id, {"cancelled"});
  EXPECT_FALSE(job["finished_at"].is_null());
  EXPECT_EQ(client_->post("/v1/jobs/" + id + "/cancel", "").status, 202) << "cancel twice";
}

TEST_F(ServiceTest, StoppingPutsRunningJobsBackAndTheNextStartFinishesThem) {
  const std::string id = submitJob("slow");
  client_->waitForState(id, {"running"});
  EXPECT_TRUE(service_->stop());
  service_.reset();
  startService();
  const json job = client_->waitForState(id, {"succeeded"});
  EXPECT_EQ(job["attempt"], 2);
}

TEST_F(ServiceTest, MetricsAreInTheTextFormat) {
  client_->waitForState(submitJob(json::object()), {"succeeded"});
  const ClientReply reply = client_->get("/metrics");
  EXPECT_EQ(reply.headers.at("Content-Type"), "text/plain; version=0.0.4; charset=utf-8");
  const Exposition exposition = parseExposition(reply.body);
  EXPECT_EQ(exposition.faults, std::vector<std::string>());
  EXPECT_EQ(exposition.samples.at("gaitmill_jobs{state=\"succeeded\"}"), 1);
  EXPECT_EQ(exposition.samples.at("gaitmill_queue_depth"), 0);
  EXPECT_EQ(exposition.samples.at("gaitmill_stage_seconds_count{stage=\"cmc\"}"), 1);
  EXPECT_EQ(exposition.samples.at("gaitmill_http_request_seconds_count{route=\"/v1/jobs\","
                                  "method=\"POST\",status=\"202\"}"),
            1);
  EXPECT_GT(exposition.samples.at("gaitmill_database_bytes"), 0);
}

// Not ready at once, but answering until the running jobs have ended.
TEST_F(ServiceTest, StoppingServiceIsNotReady) {
  EXPECT_EQ(client_->get("/readyz").status, 200);
  const std::string gate = folder_ / "gate";
  const std::string id = submitJob({{"gate", gate}});
  client_->waitForState(id, {"running"});
  service_.reset();
  config_.stop_limit_s = 60;
  startService();
  client_->waitForState(id, {"running"});
  std::thread stopper([this] { EXPECT_TRUE(service_->stop()); });
  ClientReply ready;
  do {
    ready = client_->get("/readyz");
  } while (ready.status == 200);
  EXPECT_EQ(ready.status, 503) << ready.body;
  EXPECT_EQ(ready.json()["code"], "service.not_ready");
  EXPECT_EQ(client_->get("/livez").status, 200);
  for (const char* stage : {"scale", "ik", "rra", "id", "so", "cmc"}) {
    folder_.write(std::string("gate.") + stage, "");
  }
  stopper.join();
}

// What a process of its own reads gives the same answers and the same errors.
TEST_F(ServiceTest, LargeUploadsAreReadByAChild) {
  const json in_process = client_->upload("/v1/trials", kTrial).json();
  service_.reset();
  config_.inspect_in_child_mb = 0;
  startService();
  json in_child = client_->upload("/v1/trials", kTrial).json();
  EXPECT_EQ(in_child["files"], in_process["files"]);
  EXPECT_EQ(in_child["warnings"], in_process["warnings"]);
  const ClientReply refused =
      client_->upload("/v1/trials", {kTrial[0], kTrial[1], {"grf", "grf.mot", ""}});
  EXPECT_EQ(refused.status, 422) << refused.body;
  EXPECT_EQ(refused.json()["code"], "file.empty");
  EXPECT_EQ(refused.json()["where"]["file"], "grf.mot");
  EXPECT_EQ(refused.json()["where"]["line"], 1);
}

TEST(ServiceKeys, WithoutKeysOnlyThisMachineIsServed) {
  const TemporaryFolder folder;
  writeSettings(folder);
  ServeConfig config;
  config.db = folder / "mill.db";
  config.models = folder / "models";
  config.host = "0.0.0.0";
  config.port = 0;
  try {
    const Service service(config, makeFakePipeline(), FAKE_SERVICE);
    FAIL() << "it would be open to the network";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kConfig);
    EXPECT_EQ(error.where().field, "host");
  }
}

// The process is killed in the middle of several jobs, again and again; every job completes.
TEST(ServiceProcess, KillInMidJobLosesNothing) {
  const TemporaryFolder folder;
  writeSettings(folder);
  const std::vector<std::string> command = {FAKE_SERVICE,
                                            "serve",
                                            "--db",
                                            folder / "mill.db",
                                            "--models",
                                            folder / "models",
                                            "--workers",
                                            "2",
                                            "--port",
                                            "0",
                                            "--log-level",
                                            "off"};
  std::set<std::string> jobs;
  for (int round = 0; round < 2; ++round) {
    ChildProcess process(command);
    const std::string address = process.readLine();
    const HttpClient client(std::stoi(address.substr(address.rfind(':') + 1)));
    const std::string trial = client.upload("/v1/trials", kTrial).json()["id"];
    for (int i = 0; i < 3; ++i) {
      const json request{{"trial", trial}, {"settings", "slow"}};
      const ClientReply reply = client.post("/v1/jobs", request.dump());
      ASSERT_EQ(reply.status, 202) << reply.body;
      jobs.insert(reply.json()["id"]);
    }
    client.waitForState(*jobs.begin(), {"running"});
    process.signal(SIGKILL);
    EXPECT_EQ(process.wait(), 128 + SIGKILL);
  }
  ChildProcess process(command);
  const std::string address = process.readLine();
  const HttpClient client(std::stoi(address.substr(address.rfind(':') + 1)));
  EXPECT_EQ(jobs.size(), 6U);
  for (const std::string& id : jobs) {
    EXPECT_EQ(client.waitForState(id, {"succeeded", "failed"})["state"], "succeeded");
    EXPECT_EQ(client.get("/v1/jobs/" + id + "/results/moments").status, 200);
  }
  process.signal(SIGTERM);
  EXPECT_EQ(process.wait(), 0);
}

}  // namespace
}  // namespace gaitmill
