#pragma once

#include <memory>
#include <string>
#include <vector>

#include "service/port_services.h"
#include "service/storage/database.h"
#include "service/stores.h"
#include "tests/support/temporary_folder.h"

namespace gaitmill {

/// The ports over a real database with the fake pipeline, and jobs that run when the test says so.
class PortFixture {
 public:
  explicit PortFixture(const Quota& quota = {});

  api::Ports ports() { return services_->ports(status_); }
  PortServices& services() { return *services_; }
  Stores& stores() { return *stores_; }
  Database& database() { return *database_; }
  const TemporaryFolder& folder() const { return folder_; }
  /// As after a restart of the process.
  void reopen();

  std::string addTrial(const api::Identity& who, const std::string& marker_bytes = "the bytes");
  std::string addJob(const api::Identity& who,
                     const std::string& trial_id,
                     const std::string& settings_json = "{}");
  /// Claims the oldest job and runs its stages up to and with `last`; after the last of all the job
  /// has succeeded. @returns its ticket
  JobTicket runNextJob(const std::string& last = "cmc");
  /// A trial and a succeeded job of it.
  std::string addFinishedJob(const api::Identity& who, const std::string& settings_json = "{}");

  std::vector<std::string> cancelled;  ///< jobs that workers were told to stop
  int woken = 0;                       ///< times that workers were told of new jobs

 private:
  struct Status : api::StatusPort {
    std::string findUnreadiness() override { return ""; }
    std::string renderMetrics() override { return ""; }
  };
  void open();

  TemporaryFolder folder_;
  Quota quota_;
  Status status_;
  std::unique_ptr<Database> database_;
  std::unique_ptr<Stores> stores_;
  std::unique_ptr<PortServices> services_;
  int openings_ = 0;
};

/// Someone of this tenant who may do everything.
api::Identity makeMember(const std::string& tenant, const std::string& key_id = "");

/// An upload of markers for a subject of 75 kg.
api::TrialUpload makeUpload(const std::string& marker_bytes);

/// All of it.
std::string readSource(const api::ByteSource& source);

}  // namespace gaitmill
