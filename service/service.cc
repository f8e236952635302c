#include "service/service.h"

#include <spdlog/spdlog.h>

#include <csignal>
#include <cstdlib>
#include <iostream>

#include "api/routes.h"
#include "service/version.h"

namespace gaitmill {

namespace {

api::ServerOptions makeServerOptions(const ServeConfig& config) {
  api::ServerOptions options;
  options.host = config.host;
  options.port = config.port;
  return options;
}

int countWorkers(const ServeConfig& config) {
  const auto hardware = static_cast<int>(std::thread::hardware_concurrency());
  return config.workers > 0 ? config.workers : std::max(hardware, 1);
}

void logRequest(api::LogLevel level, const std::string& line) {
  spdlog::log(
      level == api::LogLevel::kError ? spdlog::level::err : spdlog::level::debug, "http: {}", line);
}

sigset_t blockStopSignals() {
  sigset_t signals{};
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

}  // namespace

Service::Service(const ServeConfig& config, const PipelineFunctions& functions)
    : config_(config),
      database_(config.database),
      trial_store_(database_),
      job_store_(database_),
      workers_(trial_store_, job_store_, functions.run, countWorkers(config)),
      trials_(trial_store_, functions.inspect),
      jobs_(trial_store_,
            job_store_,
            workers_,
            SettingsCatalog(config.models),
            functions.check_settings),
      results_(job_store_, functions.encode_sto),
      server_(api::makeRoutes({trials_, jobs_, results_}, kVersion),
              makeServerOptions(config),
              logRequest) {
  const Recovery recovery = job_store_.recover();
  spdlog::info("database {}: {} jobs back to the queue, {} cancelled, {} given up",
               config.database,
               recovery.requeued,
               recovery.cancelled,
               recovery.abandoned);
}

Service::~Service() {
  if (requests_.joinable()) {
    server_.stop();
    requests_.join();
  }
}

int Service::start() {
  const int port = server_.bind();
  workers_.start();
  requests_ = std::thread([this] { server_.run(); });
  return port;
}

bool Service::stop() {
  server_.stop();
  if (requests_.joinable()) {
    requests_.join();
  }
  return workers_.stop(config_.stop_limit);
}

// The stop signals are blocked in every thread and waited for here, so that nothing runs inside a
// signal handler.
int runService(const ServeConfig& config, const PipelineFunctions& functions) {
  const sigset_t signals = blockStopSignals();
  std::signal(SIGPIPE, SIG_IGN);
  Service service(config, functions);
  const int port = service.start();
  std::cout << "gaitmill listens on http://" << config.host << ":" << port << std::endl;
  int received = 0;
  sigwait(&signals, &received);
  spdlog::info("stopping on signal {}", received);
  if (!service.stop()) {
    spdlog::shutdown();
    std::_Exit(EXIT_SUCCESS);
  }
  return EXIT_SUCCESS;
}

}  // namespace gaitmill
