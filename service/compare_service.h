#pragma once

#include <memory>
#include <string>
#include <vector>

#include "api/ports.h"
#include "service/pipeline_functions.h"
#include "service/stored_results.h"
#include "service/stores.h"

namespace gaitmill {

/// Jobs held against the first of them, behind the API.
class CompareService : public api::ComparePort {
 public:
  CompareService(Stores& stores, FigureFunctions functions);

  std::string findTag(const api::Identity& who, const std::vector<std::string>& job_ids) override;
  api::ComparisonView compare(const api::Identity& who,
                              const std::vector<std::string>& job_ids) override;
  Figure find(const api::Identity& who,
              const std::vector<std::string>& job_ids,
              const std::string& name) override;

 private:
  struct Opened {
    std::vector<std::unique_ptr<StoredResults>> results;
    NamedResults jobs;
  };
  Opened open(const api::Identity& who, const std::vector<std::string>& job_ids);

  Stores& stores_;
  FigureFunctions functions_;
};

}  // namespace gaitmill
