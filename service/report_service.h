#pragma once

#include <string>
#include <vector>

#include "api/ports.h"
#include "service/byte_cache.h"
#include "service/pipeline_functions.h"
#include "service/stored_results.h"
#include "service/stores.h"

namespace gaitmill {

/// An image of the report with the name that its file has in the archive.
struct NamedImage {
  std::string file_name;  ///< "right_heel_strike.png"
  ReportImage image;
};

/// The verdict on a job and its report, behind the API.
class ReportService : public api::ReportPort {
 public:
  /// @param images, cache  outlive this
  ReportService(Stores& stores,
                FigureFunctions functions,
                api::ImagePort& images,
                ByteCache& cache);

  std::string findTag(const api::Identity& who, const std::string& job_id) override;
  std::string findQuality(const api::Identity& who, const std::string& job_id) override;
  std::string render(const api::Identity& who, const std::string& job_id) override;

  /// The body at heel strike, mid-stance, toe-off and mid-swing. @throws as api::ImagePort::paint
  std::vector<NamedImage> paintInstants(const api::Identity& who, const std::string& job_id);

 private:
  api::JobView requireSucceeded(const api::Identity& who, const std::string& job_id);
  ReportProvenance collectProvenance(const api::Identity& who, const api::JobView& job);

  Stores& stores_;
  FigureFunctions functions_;
  api::ImagePort& images_;
  ByteCache& cache_;
};

}  // namespace gaitmill
