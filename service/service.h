#pragma once

#include <memory>
#include <string>
#include <thread>

#include "api/server.h"
#include "service/change_feed.h"
#include "service/config.h"
#include "service/pipeline_functions.h"
#include "service/port_services.h"
#include "service/retention.h"
#include "service/status_service.h"
#include "service/storage/database.h"
#include "service/stores.h"
#include "service/workers.h"

namespace gaitmill {

/// The program that children run: this one, unless a test has another.
inline constexpr const char* kThisProgram = "/proc/self/exe";

/// The whole service in one object: storage, workers and the listening socket.
class Service {
 public:
  /// Opens the database and frees the jobs of a service that was killed.
  /// @param program  that children run as "<program> solve …"
  /// @throws Error kStorage…; kConfig if others than this machine could reach a service without
  /// keys,
  ///         and for a geometry folder that is not there
  Service(const ServeConfig& config,
          const PipelineFunctions& functions,
          const std::string& program = kThisProgram);
  ~Service();
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  /// Starts workers and requests in threads of their own. @returns the port
  /// @throws Error kServicePort
  int start();
  /// Not ready and no new work from now on; jobs may end by themselves for the stop limit, then
  /// they are given back. Requests are answered until then.
  /// @returns false if a job could not even be given back in time; the process must then end
  /// without
  ///          destroying this object
  bool stop();

 private:
  api::ServerOptions makeHookedServerOptions(const ServeConfig& config);
  void requireKeys();
  void requireGeometry() const;
  void notify(const JobChange& change);
  void stopRequests();

  ServeConfig config_;
  Metrics metrics_;
  Database database_;
  Stores stores_;
  StatusService status_;
  std::unique_ptr<Workers> workers_;  ///< after the ports, whose catalog it reads
  PortServices ports_;
  Retention retention_;
  api::Server server_;
  ChangeFeed changes_;
  std::thread requests_;
};

/// Runs the service until SIGTERM or SIGINT; a second signal ends it at once. Prints the address on
/// standard output.
/// @returns the exit code of the process
int runService(const ServeConfig& config,
               const PipelineFunctions& functions,
               const std::string& program = kThisProgram);

/// Runs jobs of the database until SIGTERM or SIGINT, without requests.
int runWork(const ServeConfig& config,
            const PipelineFunctions& functions,
            const std::string& program = kThisProgram);

}  // namespace gaitmill
