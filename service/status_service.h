#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "api/ports.h"
#include "api/server.h"
#include "service/observe/metrics.h"
#include "service/stores.h"

namespace gaitmill {

/// What operators ask: readiness and metrics.
class StatusService : public api::StatusPort {
 public:
  /// @param stores, metrics  outlive this
  StatusService(Stores& stores, Metrics& metrics);

  /// Not ready from now on.
  void beginStop() { stopping_ = true; }
  /// Where the load of the transport is asked, once there is one.
  void setLoad(std::function<api::ServerLoad()> load);
  /// For ServerOptions::on_request.
  void count(const api::RequestRecord& record);

  std::string findUnreadiness() override;
  std::string renderMetrics() override;

 private:
  void collectQueue(Metrics& metrics);
  void collectLoad(Metrics& metrics);

  Stores& stores_;
  Metrics& metrics_;
  std::atomic<bool> stopping_{false};
  std::function<api::ServerLoad()> load_;
};

}  // namespace gaitmill
