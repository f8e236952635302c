#pragma once

#include <memory>
#include <string>
#include <thread>

#include "api/server.h"
#include "service/config.h"
#include "service/job_service.h"
#include "service/pipeline_functions.h"
#include "service/result_service.h"
#include "service/storage/database.h"
#include "service/trial_service.h"
#include "service/workers.h"

namespace gaitmill {

/// The whole service in one object: storage, workers and the listening socket.
class Service {
 public:
  /// Opens the database and puts orphaned jobs back into the queue.
  /// @throws Error kStorage…, kServicePort
  Service(const ServeConfig& config, const PipelineFunctions& functions);
  ~Service();
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  /// Starts workers and requests in threads of their own. @returns the port
  int start();
  /// No new requests, no new work, running jobs back to the queue.
  /// @returns false if a solver did not stop in time; the process must then end without destroying
  ///          this object
  bool stop();

 private:
  ServeConfig config_;
  Database database_;
  TrialStore trial_store_;
  JobStore job_store_;
  Workers workers_;
  TrialService trials_;
  JobService jobs_;
  ResultService results_;
  api::Server server_;
  std::thread requests_;
};

/// Runs the service until SIGTERM or SIGINT. Prints the address on standard output.
/// @returns the exit code of the process
int runService(const ServeConfig& config, const PipelineFunctions& functions);

}  // namespace gaitmill
