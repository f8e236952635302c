#pragma once

#include <string>

#include "api/ports.h"
#include "service/pipeline_functions.h"
#include "service/settings_catalog.h"
#include "service/storage/job_store.h"
#include "service/storage/trial_store.h"
#include "service/workers.h"

namespace gaitmill {

/// Jobs behind the API. The settings of a job are fixed when it is submitted: the named or given
/// document over the trial's own options, checked before it is stored.
class JobService : public api::JobPort {
 public:
  JobService(TrialStore& trials,
             JobStore& jobs,
             Workers& workers,
             SettingsCatalog settings,
             SettingsCheck check_settings);

  api::JobView submit(const api::JobRequest& request) override;
  api::JobView find(const std::string& job_id) override;
  api::JobView cancel(const std::string& job_id) override;

 private:
  InputFile composeSettings(const api::JobRequest& request);

  TrialStore& trials_;
  JobStore& jobs_;
  Workers& workers_;
  SettingsCatalog settings_;
  SettingsCheck check_settings_;
};

}  // namespace gaitmill
