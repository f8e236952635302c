// The program itself, as its users run it: the sample trial through the real pipeline, over a real
// socket and from the command line. Some ten seconds of computing per job.

#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "service/command_line.h"
#include "tests/http/api_contract.h"
#include "tests/http/http_client.h"
#include "tests/service/product_service.h"
#include "tests/support/temporary_folder.h"

namespace gaitmill {
namespace {

using nlohmann::json;

// What the contract says about every result of a finished job.
void checkResults(const HttpClient& client, const std::string& id) {
  const ApiContract contract;
  for (const char* name :
       {"moments", "activations", "forces", "kinematics", "residuals", "quality"}) {
    for (const char* query :
         {"?format=json", "?format=csv", "?format=sto", "?axis=cycle", "?axis=cycle&angles=deg"}) {
      const std::string path = "/v1/jobs/" + id + "/results/" + name + query;
      const ClientReply reply = client.get(path);
      EXPECT_EQ(reply.status, 200) << path << reply.body;
      for (const auto& fault : contract.findFaults("GET", "/v1/jobs/{id}/results/{name}", reply)) {
        ADD_FAILURE() << path << ": " << fault;
      }
    }
  }
}

// Results of a job that the issue asks for by name, of the same trial without a server.
std::vector<std::string> listRunFiles() {
  return {"scaled_model.osim",
          "ik.mot",
          "rra.mot",
          "adjusted_model.osim",
          "inverse_dynamics.sto",
          "so_activations.sto",
          "so_forces.sto",
          "cmc_activations.sto",
          "cmc_forces.sto",
          "cmc_kinematics.mot",
          "moments.csv",
          "summary.json"};
}

std::vector<std::string> makeRunCommand(const std::string& out) {
  return {GAITMILL,
          "run",
          "--static",
          kSample + "static.trc",
          "--markers",
          kSample + "markers.trc",
          "--grf",
          kSample + "grf.mot",
          "--emg",
          kSample + "emg.sto",
          "--mass",
          "70",
          "--height",
          "1.76",
          "--models",
          "models",
          "--out",
          out};
}

TEST(Product, KillInMidJobThenTheJobCompletesAsTheCommandLineDoes) {
  const TemporaryFolder folder;
  std::string id;
  {
    ProductService service(folder);
    id = service.submit(service.uploadSample());
    json job;
    do {
      job = service.client().waitForState(id, {"running"});
    } while (job["stages"].size() < 3);
    service.process().signal(SIGKILL);
    EXPECT_EQ(service.process().wait(), 128 + SIGKILL);
  }
  ProductService service(folder);
  const json job = service.client().waitForState(id, {"succeeded", "failed"});
  ASSERT_EQ(job["state"], "succeeded") << job;
  EXPECT_EQ(job["attempt"], 2);
  EXPECT_EQ(job["stages"].size(), 6U);
  checkResults(service.client(), id);

  ChildProcess run(makeRunCommand(folder / "out"));
  while (!run.readLine().empty()) {
  }
  ASSERT_EQ(run.wait(), kExitSuccess);
  for (const std::string& name : listRunFiles()) {
    const std::string bytes = readBytes(folder / ("out/" + name));
    EXPECT_NE(bytes, "") << name;
    const ClientReply file = service.client().get("/v1/jobs/" + id + "/files/" + name);
    EXPECT_EQ(file.status, 200) << name;
    EXPECT_TRUE(name == "summary.json" || file.body == bytes) << name << " differs";
  }
}

// Nothing is shared between jobs: two at a time give what one alone gives, bit for bit.
TEST(Product, JobsSideBySideGiveTheSameBits) {
  const TemporaryFolder folder;
  ProductService service(folder, "2");
  const std::string trial = service.uploadSample();
  const std::vector<std::string> ids = {service.submit(trial), service.submit(trial)};
  std::vector<std::string> activations;
  std::vector<std::string> etags;
  for (const std::string& id : ids) {
    EXPECT_EQ(service.client().waitForState(id, {"succeeded", "failed"})["state"], "succeeded");
    const ClientReply reply = service.client().get("/v1/jobs/" + id + "/results/activations");
    activations.push_back(reply.body);
    etags.push_back(reply.headers.at("ETag"));
  }
  EXPECT_EQ(activations[0], activations[1]);
  EXPECT_EQ(etags[0], etags[1]) << "equal work has equal provenance";
}

// Hashes of all files but the summary, which holds processor seconds.
std::map<std::string, std::string> readHashes(const HttpClient& client, const std::string& id) {
  std::map<std::string, std::string> hashes;
  const json list = client.get("/v1/jobs/" + id + "/files").json();
  for (const json& file : list.at("items")) {
    if (file.at("name") != "summary.json") {
      hashes[file.at("name")] = file.at("sha256");
    }
  }
  return hashes;
}

TEST(Product, TerminatedInMidJobGoesOnAfterItsLastStageWithTheSameBits) {
  const TemporaryFolder folder;
  std::string id;
  std::size_t finished = 0;
  {
    ProductService service(folder);
    id = service.submit(service.uploadSample());
    json job;
    do {
      job = service.client().waitForState(id, {"running"});
    } while (job["stages"].size() < 3);
    finished = job["stages"].size() - 1;
    service.process().signal(SIGTERM);
    EXPECT_EQ(service.process().wait(), kExitSuccess);
  }
  ProductService service(folder);
  const json job = service.client().waitForState(id, {"succeeded", "failed"});
  EXPECT_EQ(job["state"], "succeeded") << job;
  EXPECT_EQ(job["attempt"], 2);
  EXPECT_GE(finished, 2U);
  const std::string undisturbed = service.submit(job["trial"]);
  service.client().waitForState(undisturbed, {"succeeded", "failed"});
  const auto hashes = readHashes(service.client(), id);
  EXPECT_GE(hashes.size(), 12U);
  EXPECT_EQ(hashes, readHashes(service.client(), undisturbed));
}

TEST(Product, CancelEndsARunningJobAndItsSolver) {
  const TemporaryFolder folder;
  ProductService service(folder);
  const std::string id = service.submit(service.uploadSample());
  service.client().waitForState(id, {"running"});
  EXPECT_EQ(service.client().post("/v1/jobs/" + id + "/cancel", "").status, 202);
  service.client().waitForState(id, {"cancelled"});
}

// A user learns at once of all that keeps a model from being simulated.
TEST(Product, ModelsAreRefusedWithAllThatCannotBeSimulated) {
  const TemporaryFolder folder;
  const ProductService service(folder);
  std::string model = readBytes("models/rajagopal2016/rajagopal2016.osim");
  const std::size_t at = model.find("<objects>", model.find("<ForceSet"));
  ASSERT_NE(at, std::string::npos);
  std::string refused = model;
  refused.insert(at + std::string("<objects>").size(),
                 "\n<Ligament name=\"acl\" />\n<PathSpring name=\"band\" />");
  const ClientReply reply = service.client().post("/v1/models?name=knee.osim", refused);
  ASSERT_EQ(reply.status, 422) << reply.body;
  EXPECT_EQ(reply.json()["code"], "model.unsupported");
  const json unsupported = reply.json()["unsupported"];
  ASSERT_EQ(unsupported.size(), 2U) << reply.body;
  EXPECT_EQ(unsupported[0]["element"], "Ligament 'acl'");
  EXPECT_EQ(unsupported[1]["element"], "PathSpring 'band'");
  EXPECT_EQ(unsupported[1]["line"], unsupported[0]["line"].get<int>() + 1);
  EXPECT_FALSE(unsupported[0]["reason"].get<std::string>().empty());

  const ClientReply accepted = service.client().post("/v1/models?name=knee.osim", model);
  ASSERT_EQ(accepted.status, 201) << accepted.body;
  const json summary = accepted.json()["summary"];
  EXPECT_EQ(summary["document_version"], 40000);
  EXPECT_EQ(summary["counts"]["muscle_kinds"]["millard_2012"], 80);
  EXPECT_EQ(summary["counts"]["wrap_objects"]["cylinder"], 40);
  EXPECT_EQ(summary["counts"]["passive_forces"], 0);
}

TEST(Product, SettingsAreRefusedWhenTheyAreSubmitted) {
  const TemporaryFolder folder;
  ProductService service(folder);
  const json request{{"trial", service.uploadSample()}, {"settings", {{"scael", 1}}}};
  const ClientReply reply = service.client().post("/v1/jobs", request.dump());
  EXPECT_EQ(reply.status, 422) << reply.body;
  EXPECT_EQ(reply.json()["code"], "settings.unknown_field");
}

struct CommandCase {
  std::vector<std::string> arguments;
  int exit_code;
};
class ProductExitCode : public ::testing::TestWithParam<CommandCase> {};
TEST_P(ProductExitCode, IsAsDocumented) {
  std::vector<std::string> command = {GAITMILL};
  command.insert(command.end(), GetParam().arguments.begin(), GetParam().arguments.end());
  ChildProcess process(command);
  EXPECT_EQ(process.wait(), GetParam().exit_code) << ::testing::PrintToString(command);
}
INSTANTIATE_TEST_SUITE_P(
    Table,
    ProductExitCode,
    ::testing::Values(
        CommandCase{{"version"}, kExitSuccess},
        CommandCase{{"--help"}, kExitSuccess},
        CommandCase{{"model", "--help"}, kExitSuccess},
        CommandCase{{"model", "CMakeLists.txt"}, kExitFailed},
        CommandCase{{"run", "--mass", "70", "--height", "1.7", "--settings", "none", "--out", "x"},
                    kExitFailed},
        CommandCase{{}, kExitUsage},
        CommandCase{{"run", "--out", "x"}, kExitUsage},
        CommandCase{{"serve", "--port", "x"}, kExitUsage},
        CommandCase{{"serve", "--port", "0", "--db", "/proc/absent/a.db"}, kExitInternal}));

}  // namespace
}  // namespace gaitmill
