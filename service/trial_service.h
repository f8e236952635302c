#pragma once

#include <mutex>
#include <string>

#include "api/ports.h"
#include "service/known_marker_sets.h"
#include "service/pipeline_functions.h"
#include "service/stores.h"

namespace gaitmill {

/// Trials behind the API: every file is read before anything is stored.
class TrialService : public api::TrialPort {
 public:
  /// @param quota  of each API key
  TrialService(Stores& stores,
               const KnownMarkerSets& marker_sets,
               TrialInspector inspect,
               const Quota& quota);

  api::TrialView validate(const api::Identity& who, const api::TrialUpload& upload) override;
  api::TrialView submit(const api::Identity& who, const api::TrialUpload& upload) override;
  /// The whole trial is read again: what one file says may be told from another.
  api::TrialView putFile(const api::Identity& who,
                         const std::string& trial_id,
                         const std::string& part,
                         const api::UploadedFile& file) override;
  api::Page<api::TrialView> list(const api::Identity& who,
                                 const api::ListFilter& filter,
                                 const api::PageRequest& page) override;
  api::TrialView find(const api::Identity& who, const std::string& trial_id) override;
  api::FileContent findFile(const api::Identity& who,
                            const std::string& trial_id,
                            const std::string& part) override;
  void remove(const api::Identity& who, const std::string& trial_id) override;

 private:
  void checkUpload(const api::Identity& who, const api::TrialUpload& upload) const;
  api::TrialView inspect(const api::TrialUpload& upload) const;
  api::TrialView match(const api::Identity& who, api::TrialView view) const;

  Stores& stores_;
  const KnownMarkerSets& marker_sets_;
  TrialInspector inspect_;
  Quota quota_;
  std::mutex put_guard_;  ///< one file at a time is put into trials
};

}  // namespace gaitmill
