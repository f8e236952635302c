#pragma once

#include <list>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "api/dto/result.h"
#include "service/job_composer.h"
#include "service/pipeline_functions.h"
#include "service/report_service.h"
#include "service/shipped_catalog.h"
#include "service/stores.h"
#include "service/zip_archive.h"

namespace gaitmill {

/// Everything of one succeeded job as a zip:
///   inputs/<part>/<name>   what was uploaded, the named model and marker set included
///   results/<name>.csv .json .sto  tables, "<name>_cycle" on the cycle axis; quality.json
///   files/<name>           what the pipeline wrote: scaled_model.osim, ik.mot, …
///   plots/<name>.vl.json   figures as Vega-Lite
///   images/<name>.png      the body at four instants of the gait cycle
///   report.html  settings.json  provenance.json  CITATION  SHA256SUMS
/// Equal jobs give equal bytes, but for the report, which names the job and its times. The archives
/// asked for last are kept on disk, nameless, because downloads come in ranges. Safe from any
/// thread.
class JobArchive {
 public:
  /// Archives kept at a time.
  static constexpr std::size_t kKept = 4;

  /// @param folder  for the archives
  JobArchive(Stores& stores,
             const ShippedCatalog& shipped,
             JobComposer& composer,
             ReportService& reports,
             const PipelineFunctions& functions,
             std::string folder);

  /// @throws Error kJobNotFound; kResultNotReady unless the job has succeeded; kStorage; what
  ///         ReportService::render throws
  api::FileContent make(const api::Identity& who, const std::string& job_id);

 private:
  std::optional<api::FileContent> findKept(const std::string& job_id);
  api::FileContent build(const api::Identity& who, const api::JobView& job);
  void addViews(const api::Identity& who, const api::JobView& job, std::vector<ZipEntry>& entries);
  void addInputs(const std::string& tenant,
                 const api::JobView& job,
                 std::vector<ZipEntry>& entries);
  void addResults(const std::string& tenant,
                  const api::JobView& job,
                  std::vector<ZipEntry>& entries);
  void addTable(const std::string& tenant,
                const api::JobView& job,
                const ResultInfo& stored,
                std::vector<ZipEntry>& entries);
  api::ResultTable readTable(const std::string& tenant,
                             const api::JobView& job,
                             const ResultInfo& stored);
  std::string renderOrigin(const std::string& tenant, const api::JobView& job);

  Stores& stores_;
  const ShippedCatalog& shipped_;
  JobComposer& composer_;
  ReportService& reports_;
  StoEncoder encode_sto_;
  FigureFunctions figures_;
  std::string folder_;
  std::mutex guard_;
  std::list<std::pair<std::string, api::FileContent>> kept_;  ///< by job id, latest first
};

}  // namespace gaitmill
