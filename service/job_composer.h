#pragma once

#include <string>

#include "api/dto/job.h"
#include "api/identity.h"
#include "service/pipeline_functions.h"
#include "service/provenance.h"
#include "service/settings_catalog.h"
#include "service/shipped_catalog.h"
#include "service/stores.h"

namespace gaitmill {

/// Turns what a client asks for into a job that can be queued: its settings fixed (the named or
/// given document over the trial's own options), checked against the trial, and its provenance
/// known. Stores nothing. Safe from any thread.
class JobComposer {
 public:
  JobComposer(Stores& stores,
              const ShippedCatalog& shipped,
              SettingsCatalog settings,
              const PipelineFunctions& functions);

  /// @throws Error kTrialNotFound, kModelNotFound, kMarkerSetNotFound, kSettings..., kInputMissing,
  ///         kInputValue
  NewJob compose(const api::Identity& who, const api::JobRequest& request);

  /// What the numbers of a stored job depend on, with this binary's code version.
  Provenance findProvenance(const std::string& tenant, const api::JobView& job);

 private:
  InputFile composeSettings(const api::JobRequest& request, const api::TrialSubject& subject) const;
  Provenance collectProvenance(const std::string& tenant,
                               const api::TrialView& trial,
                               const std::string& model_id,
                               const std::string& settings_json);
  std::string findModelHash(const std::string& tenant,
                            const api::TrialView& trial,
                            const std::string& model_id);
  std::string findMarkerSetHash(const std::string& tenant, const std::string& marker_set);
  void checkInput(const api::TrialView& trial,
                  const std::string& model_id,
                  const InputFile& settings) const;

  Stores& stores_;
  const ShippedCatalog& shipped_;
  SettingsCatalog settings_;
  InputCheck check_input_;
  std::string default_settings_;
};

}  // namespace gaitmill
