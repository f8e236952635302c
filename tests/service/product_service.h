#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/http/http_client.h"
#include "tests/service/child_process.h"
#include "tests/support/temporary_folder.h"

namespace gaitmill {

inline const std::string kSample = "models/sample/";

inline std::string readBytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

// gaitmill serve on its own database; may be killed and started again.
class ProductService {
 public:
  explicit ProductService(const TemporaryFolder& folder,
                          const std::string& workers = "1",
                          const std::vector<std::string>& more = {})
      : process_(makeCommand(folder, workers, more)) {
    const std::string address = process_.readLine();
    client_ = HttpClient(std::stoi(address.substr(address.rfind(':') + 1)));
  }
  ChildProcess& process() { return process_; }
  const HttpClient& client() const { return client_; }

  std::string uploadSample() const {
    const ClientReply reply =
        client_.upload("/v1/trials",
                       {{"trial", "", readBytes(kSample + "trial.json")},
                        {"static", "static.trc", readBytes(kSample + "static.trc")},
                        {"markers", "markers.trc", readBytes(kSample + "markers.trc")},
                        {"grf", "grf.mot", readBytes(kSample + "grf.mot")},
                        {"emg", "emg.sto", readBytes(kSample + "emg.sto")}});
    EXPECT_EQ(reply.status, 201) << reply.body;
    return reply.json()["id"];
  }
  std::string submit(const std::string& trial) const {
    const ClientReply reply = client_.post("/v1/jobs", nlohmann::json{{"trial", trial}}.dump());
    EXPECT_EQ(reply.status, 202) << reply.body;
    return reply.json()["id"];
  }

 private:
  static std::vector<std::string> makeCommand(const TemporaryFolder& folder,
                                              const std::string& workers,
                                              const std::vector<std::string>& more) {
    std::vector<std::string> command = {GAITMILL,
                                        "serve",
                                        "--port",
                                        "0",
                                        "--db",
                                        folder / "mill.db",
                                        "--workers",
                                        workers,
                                        "--models",
                                        "models",
                                        "--stop-limit-s",
                                        "0",
                                        "--log-level",
                                        "error"};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }

  ChildProcess process_;
  HttpClient client_{0};
};

}  // namespace gaitmill
