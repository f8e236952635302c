#pragma once

#include <chrono>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "service/storage/database.h"
#include "service/storage/job_store.h"
#include "service/storage/trial_store.h"
#include "tests/support/temporary_folder.h"

namespace gaitmill {

inline constexpr const char* kTenant = "lab_a";
inline constexpr std::chrono::milliseconds kLease{60'000};

/// The code of the Error that `call` throws; kInternal if it throws none.
template <class Call>
ErrorCode codeOf(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::kInternal;
}

inline NewTrial makeTrial(const std::map<std::string, std::string>& files,
                          const std::string& tenant = kTenant) {
  NewTrial trial;
  trial.tenant = tenant;
  trial.subject.mass = 75.3;
  trial.subject.height = 1.7;
  for (const auto& [part, bytes] : files) {
    trial.files[part] = {part + ".trc", api::makeByteSource(bytes)};
    api::UnderstoodFile understood;
    understood.part = part;
    understood.name = part + ".trc";
    understood.format = "trc";
    trial.understanding.files.push_back(understood);
  }
  return trial;
}

inline NewJob makeJob(const std::string& trial_id, const std::string& tenant = kTenant) {
  NewJob job;
  job.tenant = tenant;
  job.trial_id = trial_id;
  job.settings_name = "default";
  job.settings_json = R"({"a":1})";
  job.provenance = "abc";
  return job;
}

/// Bytes that no compression makes smaller and no other place of a database holds.
std::string makeNoise(std::size_t size, unsigned seed);

/// First column of the first row, as an integer or as a text.
std::int64_t queryInteger(Database& database, const char* sql);
std::string queryText(Database& database, const char* sql);
/// Runs statements that no store offers, to break what is stored.
void tamper(Database& database, const char* sql);

/// A database with one trial.
class StorageTest : public ::testing::Test {
 protected:
  StorageTest() : trial_(trials_.add(makeTrial({})).id) {}

  std::string submit() { return jobs_.submit(makeJob(trial_)); }
  JobTicket claim() { return jobs_.claimNext("serve:1", kLease).value().ticket; }
  api::JobView find(const std::string& id) { return jobs_.find(kTenant, id); }
  api::JobState stateOf(const std::string& id) { return find(id).state; }

  TemporaryFolder folder_;
  Database database_{{folder_ / "mill.db"}};
  TrialStore trials_{database_};
  JobStore jobs_{database_};
  std::string trial_;
};

}  // namespace gaitmill
