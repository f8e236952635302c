#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "api/dto/job.h"

namespace gaitmill::api {

/// {"name", "trials": ["tri_…", …], "settings": ["default", {…}, …], "label", "model"}: one job for
/// every pair of a trial and settings, all or none.
struct StudyRequest {
  std::string name;
  std::vector<JobRequest> jobs;  ///< trials × settings, trial by trial
  std::string label;             ///< of the study and of its jobs
  std::string submission_key;    ///< not of the document: the request's Idempotency-Key, or empty
};

struct StudyView {
  std::string id;
  std::string name;
  std::int64_t created_at = 0;       ///< [ms since 1970 UTC]
  std::int64_t version = 0;          ///< grows with every change of one of its jobs
  std::map<std::string, int> jobs;   ///< number of jobs by state, all five states
  double progress = 0;               ///< mean over its jobs, in [0, 1]
  std::vector<std::string> job_ids;  ///< in the order of submission
};

/// One row of a study's table of results.
struct StudyRow {
  JobView job;
  std::string quality_json;  ///< quality figures of a succeeded job, else empty
};

/// @throws Error kRequestMalformed, kRequestField naming the field
StudyRequest parseStudyRequest(const std::string& json);
std::string renderStudy(const StudyView& study);
/// One row per job, in the order of submission. In JSON the quality figures as they are; in CSV one
/// column for every figure that any row has, named by its dotted path.
std::string renderStudyTable(const std::vector<StudyRow>& rows);
std::string renderStudyTableCsv(const std::vector<StudyRow>& rows);

}  // namespace gaitmill::api
