#pragma once

#include <map>
#include <string>

#include "api/dto/trial.h"
#include "service/storage/database.h"

namespace gaitmill {

/// Trials and their files. Bytes are kept by their hash, so the same file is stored once.
class TrialStore {
 public:
  explicit TrialStore(Database& database) : database_(database) {}

  /// Stores the trial durably; fills in id, time, sizes and hashes of `view`.
  api::TrialView add(const api::TrialUpload& upload, api::TrialView view);

  /// @throws Error kTrialNotFound
  api::TrialView find(const std::string& trial_id);
  api::TrialSubject findSubject(const std::string& trial_id);
  std::map<std::string, api::UploadedFile> readFiles(const std::string& trial_id);

 private:
  Database& database_;
};

}  // namespace gaitmill
