#pragma once

#include <string>

#include "api/ports.h"
#include "service/pipeline_functions.h"
#include "service/storage/trial_store.h"

namespace gaitmill {

/// Trials behind the API: every file is read before anything is stored.
class TrialService : public api::TrialPort {
 public:
  TrialService(TrialStore& store, TrialInspector inspect);

  api::TrialView submit(api::TrialUpload upload) override;
  api::TrialView find(const std::string& trial_id) override;

 private:
  TrialStore& store_;
  TrialInspector inspect_;
};

/// The trial as the pipeline takes it.
TrialInput readTrialInput(TrialStore& store, const std::string& trial_id);

}  // namespace gaitmill
