#pragma once

#include <functional>
#include <string>
#include <vector>

#include "api/ports.h"
#include "service/job_composer.h"
#include "service/job_estimates.h"
#include "service/stores.h"

namespace gaitmill {

/// What the workers of this process are told, beside what is stored. Quick, from any thread.
struct WorkerSignals {
  std::function<void()> wake = [] {
  };  ///< a job has been queued
  std::function<void(const std::string& job_id)> cancel = [](const std::string&) {
  };
};

/// Jobs behind the API. Everything about a job is fixed and checked when it is submitted.
class JobService : public api::JobPort {
 public:
  /// @param quota  of each API key
  JobService(Stores& stores,
             JobComposer& composer,
             JobEstimates& estimates,
             WorkerSignals workers,
             const Quota& quota);

  api::JobView submit(const api::Identity& who, const api::JobRequest& request) override;
  api::Page<api::JobView> list(const api::Identity& who,
                               const api::ListFilter& filter,
                               const api::PageRequest& page) override;
  api::JobView find(const api::Identity& who, const std::string& job_id) override;
  api::JobView cancel(const api::Identity& who, const std::string& job_id) override;
  void remove(const api::Identity& who, const std::string& job_id) override;
  std::vector<api::JobEvent> listEvents(const api::Identity& who,
                                        const std::string& job_id,
                                        std::int64_t after) override;

 private:
  Stores& stores_;
  JobComposer& composer_;
  JobEstimates& estimates_;
  WorkerSignals workers_;
  Quota quota_;
};

}  // namespace gaitmill
