#pragma once

#include <map>
#include <string>

#include "api/dto/trial.h"
#include "service/shipped_catalog.h"
#include "service/stores.h"

namespace gaitmill {

/// What the pipeline computes a job from, besides its settings. Bytes are read from the database
/// when they are asked for.
struct JobInput {
  double mass = 0;    ///< [kg]
  double height = 0;  ///< [m]
  /// By part: those of api::trialParts(), "model" replaced by the one that the job names, and
  /// "marker_set" where the settings name one of the tenant's own.
  std::map<std::string, api::UploadedFile> parts;
};

/// The input of a job of this tenant. @throws Error kTrialNotFound, kModelNotFound,
/// kMarkerSetNotFound, kStorage
JobInput readJobInput(Stores& stores, const ShippedCatalog& shipped, const ClaimedJob& job);

/// The marker set that settings ask for: a shipped set's name, or "mks_…".
/// @param default_settings  what holds where the document says nothing
std::string findMarkerSet(const std::string& settings_json, const std::string& default_settings);

/// Whether an id names something of a catalog's own: "mod_…", "mks_…".
bool isUploadedId(const std::string& id);

/// As the pipeline takes it. @throws Error kRequestTooLarge for a part beyond kMaximumFileSize
TrialInput makeTrialInput(const JobInput& input);

}  // namespace gaitmill
