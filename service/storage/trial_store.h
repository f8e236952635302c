#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "api/dto/page.h"
#include "api/dto/result.h"
#include "api/dto/trial.h"
#include "service/storage/database.h"
#include "service/storage/usage.h"

namespace gaitmill {

struct NewTrial {
  std::string tenant;
  std::string key_id;
  api::TrialSubject subject;
  std::map<std::string, api::UploadedFile> files;  ///< by part
  /// What was understood: files (without sizes and hashes, which the store fills in), events,
  /// warnings.
  api::TrialView understanding;
  /// Not empty: the trial that this tenant stored under the same key is returned instead of a
  /// second one, so that a request repeated after a crash changes nothing.
  std::string submission_key;
};

/// Changes a trial's view to what is understood with a file added. Quick, without side effects: it
/// runs within a transaction on the trial as it is then.
using TrialUpdate = std::function<void(api::TrialView&)>;

struct OwnedId {
  std::string tenant;
  std::string id;
};

/// Trials and their files. Bytes are kept by their hash, compressed and in pieces, so that the same
/// file is stored once and a large one never stands in memory. Another tenant's trial does not
/// exist: every look-up throws kTrialNotFound for it.
class TrialStore {
 public:
  explicit TrialStore(Database& database) : database_(database) {}

  /// Stores the trial durably; fills in id, time, sizes and hashes of the view.
  /// @throws Error kQuotaExceeded, kStorageFull
  api::TrialView add(const NewTrial& trial, const Quota& quota = {});
  /// Adds or replaces one part; `understood` describes it, `update` does the rest of the view.
  /// @throws Error kTrialNotFound; kTrialInUse if a job refers to the trial; kQuotaExceeded;
  ///         kStorageFull
  api::TrialView putFile(const std::string& tenant,
                         const std::string& trial_id,
                         const api::UploadedFile& file,
                         const api::UnderstoodFile& understood,
                         const TrialUpdate& update,
                         const Quota& quota = {});

  /// @throws Error kTrialNotFound
  api::TrialView find(const std::string& tenant, const std::string& trial_id);
  api::TrialSubject findSubject(const std::string& tenant, const std::string& trial_id);
  /// By subject, label and time. A cursor that is no id of a trial is refused.
  /// @throws Error kRequestField
  api::Page<api::TrialView> list(const std::string& tenant,
                                 const api::ListFilter& filter,
                                 const api::PageRequest& page);

  /// The bytes come piece by piece when they are read, each verified.
  /// @throws Error kTrialNotFound; kResultNotFound if it has no such part
  api::FileContent readFile(const std::string& tenant,
                            const std::string& trial_id,
                            const std::string& part);
  /// All parts. The sources need the database as long as they live.
  std::map<std::string, api::UploadedFile> readFiles(const std::string& tenant,
                                                     const std::string& trial_id);

  /// Takes the bytes off the disk, unless another trial has the same.
  /// @throws Error kTrialNotFound; kTrialInUse if jobs refer to it
  void remove(const std::string& tenant, const std::string& trial_id);

  /// Trials made before `time` [ms since 1970 UTC] that no job refers to, oldest first, of all
  /// tenants: for retention.
  std::vector<OwnedId> listUnused(std::int64_t time, int limit);
  /// For the start of the service: what uploads cut off by a crash have left. @returns how many
  int removeUnfinishedUploads();

 private:
  Database& database_;
};

}  // namespace gaitmill
