#include "service/service.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <system_error>

#include "api/routes.h"
#include "core/base/error.h"
#include "service/inspection_process.h"
#include "service/observe/log.h"
#include "service/storage/ids.h"
#include "service/version.h"

namespace gaitmill {

namespace {

using std::chrono::milliseconds;

constexpr std::uint64_t kKibi = 1024;
constexpr std::uint64_t kMebi = 1024 * 1024;
constexpr milliseconds kTick{100};  // between two looks for a cancellation by another process
constexpr const char* kServeOwner = "serve:";
constexpr const char* kWorkOwner = "work:";

milliseconds toMilliseconds(double seconds) {
  return milliseconds(static_cast<std::int64_t>(seconds * 1000.0));
}

std::uint64_t toSize(int value) {
  return static_cast<std::uint64_t>(value);
}

api::ServerOptions makeServerOptions(const ServeConfig& config) {
  api::ServerOptions options;
  options.host = config.host;
  options.port = config.port;
  options.threads = toSize(config.request_threads);
  options.max_queued = toSize(config.max_queued_requests);
  options.max_connections = toSize(config.max_connections);
  options.max_per_address = toSize(config.max_per_address);
  options.max_event_streams = toSize(config.max_event_streams);
  options.max_upload_bytes = toSize(config.max_upload_mb) * kMebi;
  options.max_json_bytes = toSize(config.max_json_kb) * kKibi;
  options.spool_folder = config.spool;
  options.spool_free_bytes = toSize(config.min_free_mb) * kMebi;
  return options;
}

DatabaseOptions makeDatabaseOptions(const ServeConfig& config, DatabaseUse use) {
  DatabaseOptions options;
  options.path = config.db;
  options.use = use;
  options.max_size = static_cast<std::int64_t>(toSize(config.max_db_mb) * kMebi);
  options.free_floor = static_cast<std::int64_t>(toSize(config.min_free_mb) * kMebi);
  return options;
}

int countWorkers(const ServeConfig& config) {
  const auto hardware = static_cast<int>(std::thread::hardware_concurrency());
  return config.workers > 0 ? config.workers : std::max(hardware, 1);
}

ChildLimits makeChildLimits(const ServeConfig& config) {
  return {config.job_memory_mb, config.nice};
}

WorkersOptions makeWorkersOptions(const ServeConfig& config,
                                  const std::string& program,
                                  const std::string& owner) {
  WorkersOptions options;
  options.count = countWorkers(config);
  options.runs.owner = owner;
  options.runs.lease = toMilliseconds(config.lease_s);
  // Five beats per lease: four may be late or lost.
  options.runs.heartbeat = options.runs.lease / 5;
  options.runs.park_limit = toMilliseconds(config.park_limit_s);
  options.runs.solver = {program, "solve", "--models", config.models};
  options.runs.limits.stage = toMilliseconds(config.stage_timeout_s);
  options.runs.limits.silence = toMilliseconds(config.hang_timeout_s);
  options.runs.limits.tick = std::min(kTick, options.runs.heartbeat);
  options.runs.limits.child = makeChildLimits(config);
  return options;
}

PipelineFunctions withLargeInspectionInChild(PipelineFunctions functions,
                                             const ServeConfig& config,
                                             const std::string& program) {
  InspectionLimits limits;
  limits.in_process = toSize(config.inspect_in_child_mb) * kMebi;
  limits.silence = toMilliseconds(config.hang_timeout_s);
  limits.child = makeChildLimits(config);
  functions.inspect = inspectLargeInChild(
      {program, "inspect", "--models", config.models}, functions.inspect, limits);
  return functions;
}

DrawOptions makeDrawOptions(const ServeConfig& config, const std::string& program) {
  constexpr std::int64_t kMega = 1'000'000;
  DrawOptions options;
  options.program = program;
  options.geometry = config.geometry;
  options.limits.deadline = toMilliseconds(config.draw_timeout_s);
  options.limits.idle = toMilliseconds(config.draw_idle_s);
  options.limits.child = {config.draw_memory_mb, config.nice};
  options.max_pixels = config.max_image_mpx * kMega;
  options.cache_bytes = toSize(config.image_cache_mb) * kMebi;
  return options;
}

PortOptions makePortOptions(const ServeConfig& config, const std::string& program) {
  PortOptions options;
  options.models = config.models;
  options.spool_folder = config.spool;
  options.keys = isLoopback(config.host) ? KeyPolicy::kOpenWithoutKeys : KeyPolicy::kKeysRequired;
  options.quota.bytes = static_cast<std::int64_t>(config.quota_mb * static_cast<double>(kMebi));
  options.quota.jobs = static_cast<std::int64_t>(config.quota_jobs);
  options.quota.frames = static_cast<std::int64_t>(config.quota_frames);
  options.quota.pixels = static_cast<std::int64_t>(config.quota_pixels);
  options.workers = countWorkers(config);
  options.draw = makeDrawOptions(config, program);
  return options;
}

void logTransport(api::LogLevel level, const std::string& line) {
  logEvent(level == api::LogLevel::kError ? Severity::kError : Severity::kDebug,
           "http.transport",
           {{"message", line}});
}

// The stop signals are blocked in every thread and waited for, so that nothing runs inside a signal
// handler.
sigset_t blockStopSignals() {
  sigset_t signals{};
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is a full disk, not the end
  return signals;
}

void waitForStop(const sigset_t& signals) {
  int received = 0;
  sigwait(&signals, &received);
  logEvent(Severity::kInfo, "service.stops", {{"signal", received}});
  std::thread([signals] {
    int again = 0;
    sigwait(&signals, &again);
    logEvent(Severity::kWarn, "service.stops_at_once", {{"signal", again}});
    std::_Exit(128 + again);
  }).detach();
}

}  // namespace

Service::Service(const ServeConfig& config,
                 const PipelineFunctions& functions,
                 const std::string& program)
    : config_(config),
      database_(makeDatabaseOptions(config, DatabaseUse::kServe)),
      stores_(database_, makeId(kServeOwner)),
      status_(stores_, metrics_),
      ports_(stores_,
             withLargeInspectionInChild(functions, config, program),
             {[this] { workers_->wake(); },
              [this](const std::string& job_id) {
                workers_->cancel(job_id);
              }},
             makePortOptions(config, program)),
      retention_(stores_, config.keep_days),
      server_(api::makeRoutes(ports_.ports(status_), kVersion),
              makeHookedServerOptions(config),
              logTransport),
      changes_(
          stores_.jobs,
          [this](const JobChange& change) { notify(change); },
          [this] {
            const api::ServerLoad load = server_.load();
            return load.parked + load.event_streams > 0;
          }) {
  requireKeys();
  requireGeometry();
  declareJobMetrics(metrics_);
  addProcessMetrics(metrics_);
  status_.setLoad([this] { return server_.load(); });
  stores_.jobs.setListener([this](const JobChange& change) { notify(change); });
  workers_ = std::make_unique<Workers>(
      stores_, ports_.shipped(), metrics_, makeWorkersOptions(config, program, stores_.owner));
  stores_.trials.removeUnfinishedUploads();
  const Recovery recovery = stores_.jobs.lapseLeases(kServeOwner);
  logEvent(Severity::kInfo,
           "service.opened",
           {{"database", config.db},
            {"given_back", recovery.given_back},
            {"cancelled", recovery.cancelled},
            {"abandoned", recovery.abandoned}});
}

api::ServerOptions Service::makeHookedServerOptions(const ServeConfig& config) {
  api::ServerOptions options = makeServerOptions(config);
  options.authenticate = [this](const std::string& header) {
    return ports_.keyCache().authenticate(header);
  };
  options.on_request = [this](const api::RequestRecord& record) {
    status_.count(record);
  };
  return options;
}

// Handlers speak to the workers, and workers to the server.
Service::~Service() {
  stopRequests();
  workers_.reset();
}

void Service::requireKeys() {
  require(isLoopback(config_.host) || stores_.keys.hasKeys(),
          ErrorCode::kConfig,
          "the service has no API keys, so it listens on a loopback address only; make a key with "
          "'gaitmill keys create' to listen on " +
              config_.host,
          {"", 0, 0, "host"});
}

void Service::requireGeometry() const {
  std::error_code absent;
  require(config_.geometry.empty() || std::filesystem::is_directory(config_.geometry, absent),
          ErrorCode::kConfig,
          "'" + config_.geometry + "' is no folder",
          {"", 0, 0, "geometry"});
}

int Service::start() {
  const int port = server_.bind();
  workers_->start();
  retention_.start();
  changes_.start();
  requests_ = std::thread([this] { server_.run(); });
  return port;
}

bool Service::stop() {
  status_.beginStop();
  const bool have_ended = workers_->stop(toMilliseconds(config_.stop_limit_s));
  stopRequests();
  return have_ended;
}

void Service::stopRequests() {
  if (requests_.joinable()) {
    ports_.drawing().stop();  // nobody waits for an image any more
    server_.stop();
    requests_.join();
  }
}

void Service::notify(const JobChange& change) {
  server_.notify(change.job_id);
  if (!change.study_id.empty()) {
    server_.notify(change.study_id);
  }
}

int runService(const ServeConfig& config,
               const PipelineFunctions& functions,
               const std::string& program) {
  const sigset_t signals = blockStopSignals();
  Service service(config, functions, program);
  const int port = service.start();
  std::cout << "gaitmill listens on http://" << config.host << ":" << port << std::endl;
  waitForStop(signals);
  if (!service.stop()) {
    std::_Exit(EXIT_SUCCESS);
  }
  return EXIT_SUCCESS;
}

int runWork(const ServeConfig& config,
            const PipelineFunctions& functions,
            const std::string& program) {
  const sigset_t signals = blockStopSignals();
  Database database(makeDatabaseOptions(config, DatabaseUse::kWork));
  Stores stores(database, makeId(kWorkOwner));
  Metrics metrics;
  declareJobMetrics(metrics);
  const ShippedCatalog shipped(config.models, functions);
  Workers workers(stores, shipped, metrics, makeWorkersOptions(config, program, stores.owner));
  workers.start();
  std::cout << "gaitmill works on " << config.db << std::endl;
  waitForStop(signals);
  if (!workers.stop(toMilliseconds(config.stop_limit_s))) {
    std::_Exit(EXIT_SUCCESS);
  }
  return EXIT_SUCCESS;
}

}  // namespace gaitmill
