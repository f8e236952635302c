// gaitmill_soak FAKE_SERVICE JOBS: many tiny jobs in a row through one service; its memory and open
// files must not grow after the first tenth.

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/chaos/mill.h"
#include "tests/support/temporary_folder.h"

namespace gaitmill {
namespace {

using nlohmann::json;

constexpr int kBatch = 100;
constexpr double kMayGrow = 8e6;  // [bytes] caches of the allocator and the database, not per job
constexpr double kFilesMayVary = 4;  // channels of the solvers that run at the moment

struct Use {
  double memory = 0;  ///< [bytes] resident
  double files = 0;
};

double findSample(const std::string& metrics, const std::string& name) {
  std::istringstream lines(metrics);
  std::string line;
  while (std::getline(lines, line)) {
    if (line.rfind(name + " ", 0) == 0) {
      return std::stod(line.substr(name.size() + 1));
    }
  }
  throw std::runtime_error("there is no metric " + name);
}

Use readUse(const HttpClient& client) {
  const std::string metrics = client.get("/metrics").body;
  return {findSample(metrics, "process_resident_memory_bytes"),
          findSample(metrics, "process_open_fds")};
}

std::string addTrial(const HttpClient& client) {
  return client
      .upload("/v1/trials",
              {{"markers", "walk.trc", "the bytes"},
               {"trial", "", R"({"mass_kg": 75.3, "height_m": 1.7})"}})
      .json()
      .at("id");
}

void runBatch(const HttpClient& client, const std::string& trial) {
  std::vector<std::string> ids;
  for (int i = 0; i < kBatch; ++i) {
    const ClientReply reply = client.post("/v1/jobs", json{{"trial", trial}}.dump());
    if (reply.status != 202) {
      throw std::runtime_error("a submission was refused: " + reply.body);
    }
    ids.push_back(reply.json().at("id"));
  }
  for (const std::string& id : ids) {
    const json job = client.waitForState(id, {"succeeded", "failed", "cancelled"});
    if (job.at("state") != "succeeded") {
      throw std::runtime_error("a job has failed: " + job.dump());
    }
  }
}

int soak(const std::string& program, int jobs) {
  const TemporaryFolder folder;
  folder.write("models/settings/default.json", "{}");
  const Mill mill(program, folder / "mill.db", folder / "models", 2);
  const std::string trial = addTrial(mill.client());
  const auto begin = std::chrono::steady_clock::now();
  Use early;
  Use late;
  for (int done = 0; done < jobs; done += kBatch) {
    runBatch(mill.client(), trial);
    late = readUse(mill.client());
    early = done + kBatch <= std::max(jobs / 10, kBatch) ? late : early;
    if ((done / kBatch) % 5 == 4) {
      std::cout << done + kBatch << " jobs, " << late.memory / 1e6 << " MB, " << late.files
                << " files" << std::endl;
    }
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  std::cout << jobs << " jobs in " << seconds.count() << " s; resident memory "
            << early.memory / 1e6 << " MB after a tenth, " << late.memory / 1e6
            << " MB at the end; files " << early.files << " and " << late.files << std::endl;
  const bool is_flat =
      late.memory - early.memory <= kMayGrow && late.files - early.files <= kFilesMayVary;
  return is_flat ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace gaitmill

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: gaitmill_soak FAKE_SERVICE JOBS\n";
    return EXIT_FAILURE;
  }
  try {
    return gaitmill::soak(argv[1], std::atoi(argv[2]));
  } catch (const std::exception& error) {
    std::cerr << "gaitmill_soak: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
