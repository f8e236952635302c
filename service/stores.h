#pragma once

#include <string>
#include <utility>

#include "service/storage/catalog_store.h"
#include "service/storage/database.h"
#include "service/storage/idempotency_store.h"
#include "service/storage/job_store.h"
#include "service/storage/key_store.h"
#include "service/storage/study_store.h"
#include "service/storage/trial_store.h"

namespace gaitmill {

/// Everything that one process keeps in a database.
struct Stores {
  /// @param owner_name  of the process, as JobStore::claimNext takes it
  Stores(Database& opened, std::string owner_name)
      : owner(std::move(owner_name)),
        database(opened),
        trials(opened),
        jobs(opened),
        studies(opened, jobs),
        models(opened, CatalogKind::kModel),
        marker_sets(opened, CatalogKind::kMarkerSet),
        keys(opened),
        idempotency(opened, owner) {}
  Stores(const Stores&) = delete;
  Stores& operator=(const Stores&) = delete;

  std::string owner;
  Database& database;
  TrialStore trials;
  JobStore jobs;
  StudyStore studies;
  CatalogStore models;
  CatalogStore marker_sets;
  KeyStore keys;
  IdempotencyStore idempotency;
};

}  // namespace gaitmill
