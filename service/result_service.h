#pragma once

#include <string>
#include <vector>

#include "api/ports.h"
#include "service/job_archive.h"
#include "service/pipeline_functions.h"
#include "service/stores.h"

namespace gaitmill {

/// Results behind the API, each readable as soon as its stage has finished.
class ResultService : public api::ResultPort {
 public:
  ResultService(Stores& stores, JobArchive& archive, StoEncoder encode_sto);

  std::vector<api::ResultView> list(const api::Identity& who, const std::string& job_id) override;
  api::ResultTable findTable(const api::Identity& who,
                             const std::string& job_id,
                             const std::string& name,
                             api::TableAxis axis) override;
  std::string findQuality(const api::Identity& who, const std::string& job_id) override;
  std::string encodeSto(const TimeSeries& table, api::AngleUnit angles) override;
  std::vector<api::FileView> listFiles(const api::Identity& who,
                                       const std::string& job_id) override;
  api::FileContent findFile(const api::Identity& who,
                            const std::string& job_id,
                            const std::string& name) override;
  api::FileContent makeArchive(const api::Identity& who, const std::string& job_id) override;

 private:
  Stores& stores_;
  JobArchive& archive_;
  StoEncoder encode_sto_;
};

}  // namespace gaitmill
