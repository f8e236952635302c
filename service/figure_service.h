#pragma once

#include <string>
#include <vector>

#include "api/ports.h"
#include "service/pipeline_functions.h"
#include "service/stores.h"

namespace gaitmill {

/// Figures of a job behind the API, from the tables that it has so far.
class FigureService : public api::FigurePort {
 public:
  FigureService(Stores& stores, FigureFunctions functions);

  std::string findTag(const api::Identity& who, const std::string& job_id) override;
  std::vector<FigureInfo> list(const api::Identity& who, const std::string& job_id) override;
  Figure find(const api::Identity& who,
              const std::string& job_id,
              const std::string& name) override;
  std::string encode(const Figure& figure, api::FigureForm form) override;

 private:
  Stores& stores_;
  FigureFunctions functions_;
};

}  // namespace gaitmill
