#include "service/status_service.h"

#include <algorithm>
#include <utility>

#include "core/base/error.h"
#include "service/observe/log.h"
#include "service/storage/clock.h"

namespace gaitmill {

namespace {

void declareMetrics(Metrics& metrics) {
  metrics.declareGauge("gaitmill_jobs", "Jobs in the database, by state.");
  metrics.declareGauge("gaitmill_queue_depth", "Jobs that wait for a worker.");
  metrics.declareGauge("gaitmill_queue_oldest_age_seconds", "How long the oldest of them waits.");
  metrics.declareGauge("gaitmill_database_bytes", "Size of the database with its log.");
  metrics.declareGauge("gaitmill_ready", "1 if jobs can be taken.");
  metrics.declareHistogram(
      "gaitmill_http_request_seconds",
      "From a request's first byte to its answer's last, by route, method and status.",
      {0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 1, 5, 30});
  metrics.declareCounter("gaitmill_http_request_bytes_total", "Bytes of bodies received.");
  metrics.declareCounter("gaitmill_http_reply_bytes_total", "Bytes of answers sent.");
  metrics.declareGauge("gaitmill_http_connections", "Open connections.");
  metrics.declareGauge("gaitmill_http_event_streams", "Open event streams.");
  metrics.declareGauge("gaitmill_http_parked", "Requests that wait for a change.");
  metrics.declareGauge("gaitmill_http_queued", "Requests that wait for a thread.");
}

}  // namespace

StatusService::StatusService(Stores& stores, Metrics& metrics)
    : stores_(stores), metrics_(metrics) {
  declareMetrics(metrics);
  metrics.addCollector([this](Metrics& collected) { collectQueue(collected); });
  metrics.addCollector([this](Metrics& collected) { collectLoad(collected); });
}

void StatusService::setLoad(std::function<api::ServerLoad()> load) {
  load_ = std::move(load);
}

// A request that no route has taken counts under one name, whatever path it asked for.
void StatusService::count(const api::RequestRecord& record) {
  const std::string route = record.pattern.empty() ? "none" : record.pattern;
  const std::string method = record.pattern.empty() ? "any" : record.method;
  metrics_.observe(
      "gaitmill_http_request_seconds",
      {{"route", route}, {"method", method}, {"status", std::to_string(record.status)}},
      record.seconds);
  metrics_.add("gaitmill_http_request_bytes_total", {}, static_cast<double>(record.request_bytes));
  metrics_.add("gaitmill_http_reply_bytes_total", {}, static_cast<double>(record.reply_bytes));
  logEvent(record.status >= 500 ? Severity::kWarn : Severity::kDebug,
           "http.request",
           {{"request_id", record.id},
            {"method", record.method},
            {"path", record.path},
            {"status", record.status},
            {"seconds", record.seconds},
            {"client", record.client},
            {"tenant", record.tenant},
            {"key_id", record.key_id}});
}

std::string StatusService::findUnreadiness() {
  if (stopping_) {
    return "the service is stopping";
  }
  return stores_.database.findShortage();
}

std::string StatusService::renderMetrics() {
  return metrics_.render();
}

void StatusService::collectQueue(Metrics& metrics) {
  const QueueStatistics queue = stores_.jobs.calcStatistics();
  for (const auto& [state, count] : queue.jobs) {
    metrics.set("gaitmill_jobs", {{"state", state}}, static_cast<double>(count));
  }
  const std::int64_t now = nowMilliseconds();
  const std::int64_t age = now - std::min(now, queue.oldest_queued_at.value_or(now));
  metrics.set("gaitmill_queue_depth", {}, static_cast<double>(queue.depth));
  metrics.set("gaitmill_queue_oldest_age_seconds", {}, static_cast<double>(age) / 1000.0);
  metrics.set("gaitmill_database_bytes", {}, static_cast<double>(stores_.database.findSize()));
  metrics.set("gaitmill_ready", {}, findUnreadiness().empty() ? 1 : 0);
}

void StatusService::collectLoad(Metrics& metrics) {
  if (load_) {
    const api::ServerLoad load = load_();
    metrics.set("gaitmill_http_connections", {}, static_cast<double>(load.connections));
    metrics.set("gaitmill_http_event_streams", {}, static_cast<double>(load.event_streams));
    metrics.set("gaitmill_http_parked", {}, static_cast<double>(load.parked));
    metrics.set("gaitmill_http_queued", {}, static_cast<double>(load.queued));
  }
}

}  // namespace gaitmill
