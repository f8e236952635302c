#pragma once

#include <string>

#include "api/ports.h"
#include "service/catalog_service.h"
#include "service/idempotency_service.h"
#include "service/job_archive.h"
#include "service/job_composer.h"
#include "service/job_estimates.h"
#include "service/job_service.h"
#include "service/key_cache.h"
#include "service/key_service.h"
#include "service/known_marker_sets.h"
#include "service/pipeline_functions.h"
#include "service/result_service.h"
#include "service/settings_service.h"
#include "service/shipped_catalog.h"
#include "service/stores.h"
#include "service/study_service.h"
#include "service/trial_service.h"

namespace gaitmill {

struct PortOptions {
  std::string models;                     ///< folder
  std::string spool_folder = "/var/tmp";  ///< for archives
  KeyPolicy keys = KeyPolicy::kOpenWithoutKeys;
  Quota quota;      ///< of each API key
  int workers = 1;  ///< jobs computed at a time, for estimates
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

 private:
  ShippedCatalog shipped_;
  KnownMarkerSets known_marker_sets_;
  JobComposer composer_;
  JobEstimates estimates_;
  KeyCache key_cache_;
  JobArchive archive_;
  TrialService trials_;
  JobService jobs_;
  StudyService studies_;
  ResultService results_;
  CatalogService models_;
  CatalogService marker_sets_;
  SettingsService settings_;
  KeyService keys_;
  IdempotencyService idempotency_;
};

}  // namespace gaitmill
