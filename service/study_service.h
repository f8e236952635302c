#pragma once

#include <string>
#include <vector>

#include "api/ports.h"
#include "service/job_composer.h"
#include "service/job_service.h"
#include "service/stores.h"

namespace gaitmill {

/// Studies behind the API: many jobs, submitted, watched and removed as one.
class StudyService : public api::StudyPort {
 public:
  /// Jobs of one study: some hundred trials with a handful of settings.
  static constexpr std::size_t kMaxJobs = 1000;

  StudyService(Stores& stores, JobComposer& composer, WorkerSignals workers, const Quota& quota);

  api::StudyView submit(const api::Identity& who, const api::StudyRequest& request) override;
  api::Page<api::StudyView> list(const api::Identity& who,
                                 const api::ListFilter& filter,
                                 const api::PageRequest& page) override;
  api::StudyView find(const api::Identity& who, const std::string& study_id) override;
  std::vector<api::StudyRow> listRows(const api::Identity& who,
                                      const std::string& study_id) override;
  api::StudyView cancel(const api::Identity& who, const std::string& study_id) override;
  void remove(const api::Identity& who, const std::string& study_id) override;

 private:
  Stores& stores_;
  JobComposer& composer_;
  WorkerSignals workers_;
  Quota quota_;
};

}  // namespace gaitmill
