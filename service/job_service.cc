#include "service/job_service.h"

#include <utility>

#include "core/base/error.h"

namespace gaitmill {

JobService::JobService(TrialStore& trials,
                       JobStore& jobs,
                       Workers& workers,
                       SettingsCatalog settings,
                       SettingsCheck check_settings)
    : trials_(trials),
      jobs_(jobs),
      workers_(workers),
      settings_(std::move(settings)),
      check_settings_(std::move(check_settings)) {}

// A trial's options hold over the settings by name, and under a document that the job brings.
InputFile JobService::composeSettings(const api::JobRequest& request) {
  const api::TrialSubject subject = trials_.findSubject(request.trial_id);
  InputFile options{"trial.options", subject.options};
  if (subject.marker_set) {
    options = mergeSettings(makeMarkerSetSettings(*subject.marker_set), options);
  }
  return request.settings_name.empty()
             ? mergeSettings(options, {"settings", request.settings_json})
             : mergeSettings(settings_.find(request.settings_name), options);
}

api::JobView JobService::submit(const api::JobRequest& request) {
  const InputFile settings = composeSettings(request);
  check_settings_(settings);
  const std::string id = jobs_.submit(request.trial_id, request.settings_name, settings.bytes);
  workers_.wake();
  return jobs_.find(id);
}

api::JobView JobService::find(const std::string& job_id) {
  return jobs_.find(job_id);
}

// Stored first, so that a restart in between does not forget it; then the worker is told.
api::JobView JobService::cancel(const std::string& job_id) {
  jobs_.requestCancel(job_id);
  workers_.cancel(job_id);
  return jobs_.find(job_id);
}

}  // namespace gaitmill
