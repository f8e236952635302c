#pragma once

#include <string>
#include <vector>

#include "api/ports.h"
#include "service/pipeline_functions.h"
#include "service/storage/job_store.h"

namespace gaitmill {

/// Results behind the API.
class ResultService : public api::ResultPort {
 public:
  ResultService(JobStore& store, StoEncoder encode_sto);

  TimeSeries findTable(const std::string& job_id,
                       const std::string& name,
                       api::TableAxis axis) override;
  std::string findQuality(const std::string& job_id) override;
  std::string encodeSto(const TimeSeries& table, api::AngleUnit angles) override;
  std::vector<api::FileView> listFiles(const std::string& job_id) override;
  api::FileContent findFile(const std::string& job_id, const std::string& name) override;

 private:
  JobStore& store_;
  StoEncoder encode_sto_;
};

/// Everything of a result that is kept, as bytes. "quality" is cut out of the summary.
std::vector<ResultItem> makeResultItems(const PipelineResult& result);

}  // namespace gaitmill
