#pragma once

#include <string>

#include "api/ports.h"
#include "service/byte_cache.h"
#include "service/catalog_service.h"
#include "service/compare_service.h"
#include "service/draw_process.h"
#include "service/figure_service.h"
#include "service/idempotency_service.h"
#include "service/image_service.h"
#include "service/job_archive.h"
#include "service/job_composer.h"
#include "service/job_estimates.h"
#include "service/job_service.h"
#include "service/key_cache.h"
#include "service/key_service.h"
#include "service/known_marker_sets.h"
#include "service/pipeline_functions.h"
#include "service/report_service.h"
#include "service/result_service.h"
#include "service/settings_service.h"
#include "service/shipped_catalog.h"
#include "service/stores.h"
#include "service/study_service.h"
#include "service/trial_service.h"
#include "service/validation_service.h"

namespace gaitmill {

/// How images are drawn.
struct DrawOptions {
  std::string program = "/proc/self/exe";  ///< that draws as "<program> draw ..."
  std::string geometry;                    ///< folder of meshes; empty = stylised bones
  DrawLimits limits;
  std::int64_t max_pixels = 250'000'000;
  std::size_t cache_bytes = 64U << 20U;
};

struct PortOptions {
  std::string models;                     ///< folder
  std::string spool_folder = "/var/tmp";  ///< for archives
  KeyPolicy keys = KeyPolicy::kOpenWithoutKeys;
  Quota quota;      ///< of each API key
  int workers = 1;  ///< jobs computed at a time, for estimates
  DrawOptions draw;
};

/// Everything behind the API's ports over one set of stores, and who may use it.
class PortServices {
 public:
  /// @param stores  outlives this
  PortServices(Stores& stores,
               const PipelineFunctions& functions,
               WorkerSignals workers,
               const PortOptions& options);
  PortServices(const PortServices&) = delete;
  PortServices& operator=(const PortServices&) = delete;

  api::Ports ports(api::StatusPort& status);
  /// For the transport: whom an Authorization header speaks for.
  KeyCache& keyCache() { return key_cache_; }
  const ShippedCatalog& shipped() const { return shipped_; }
  const ByteCache& imageCache() const { return image_cache_; }
  DrawProcess& drawing() { return drawing_; }

 private:
  ShippedCatalog shipped_;
  KnownMarkerSets known_marker_sets_;
  JobComposer composer_;
  JobEstimates estimates_;
  KeyCache key_cache_;
  CatalogService models_;
  CatalogService marker_sets_;
  DrawProcess drawing_;
  ByteCache image_cache_;
  FigureService figures_;
  ImageService images_;
  ReportService reports_;
  CompareService comparisons_;
  ValidationService validations_;
  JobArchive archive_;
  TrialService trials_;
  JobService jobs_;
  StudyService studies_;
  ResultService results_;
  SettingsService settings_;
  KeyService keys_;
  IdempotencyService idempotency_;
};

}  // namespace gaitmill
