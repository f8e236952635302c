#pragma once

#include <string>
#include <vector>

#include "api/dto/page.h"
#include "api/dto/study.h"
#include "service/storage/database.h"
#include "service/storage/job_store.h"
#include "service/storage/usage.h"

namespace gaitmill {

struct NewStudy {
  std::string tenant;
  std::string key_id;
  std::string name;
  std::string label;
  std::vector<NewJob> jobs;    ///< of the same tenant
  std::string submission_key;  ///< as in NewJob, for the whole study
};

/// Named sets of jobs that were submitted as one. Another tenant's study does not exist.
class StudyStore {
 public:
  /// @param jobs  whose listener hears of the changes made here
  StudyStore(Database& database, JobStore& jobs) : database_(database), jobs_(jobs) {}

  /// All jobs or none. @throws as JobStore::submit
  std::string submit(const NewStudy& study, const Quota& quota = {});
  /// @throws Error kStudyNotFound
  api::StudyView find(const std::string& tenant, const std::string& study_id);
  /// By label and time, newest first. @throws Error kRequestField for a bad cursor
  api::Page<api::StudyView> list(const std::string& tenant,
                                 const api::ListFilter& filter,
                                 const api::PageRequest& page);
  /// Rows in the order of submission; the quality figures are the result "quality" of kind summary.
  std::vector<api::StudyRow> listRows(const std::string& tenant, const std::string& study_id);
  /// Cancels queued jobs and marks running ones, in one transaction.
  /// @returns the jobs that are marked: their workers are to be told
  std::vector<std::string> requestCancel(const std::string& tenant, const std::string& study_id);
  /// With its jobs and their results.
  /// @throws Error kStudyNotFound; kJobState while one of its jobs is not final
  void remove(const std::string& tenant, const std::string& study_id);

 private:
  Database& database_;
  JobStore& jobs_;
};

}  // namespace gaitmill
