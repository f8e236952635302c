#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "api/dto/job.h"
#include "api/dto/result.h"
#include "service/storage/database.h"

namespace gaitmill {

/// The right to write about a running job: its id and the number of the claim. Once another claim
/// exists, or the job has left the running state, nothing can be written with this one.
struct JobTicket {
  std::string job_id;
  std::int64_t claim = 0;
};

struct ClaimedJob {
  JobTicket ticket;
  std::string trial_id;
  std::string settings_json;
};

enum class ResultKind { kFile, kTime, kCycle, kSummary };

/// One thing a job produced, as bytes.
struct ResultItem {
  ResultKind kind;
  std::string name;
  std::string bytes;
};

/// What became of the jobs that were running when the last process ended.
struct Recovery {
  int requeued = 0;
  int cancelled = 0;
  int abandoned = 0;
};

/// Jobs and their results. Each change of state is one transaction and one of isAllowedChange().
/// Writers with a ticket get false back when it is void; they then drop their work.
class JobStore {
 public:
  /// A job whose attempts ended with the process this often has killed it, most likely.
  static constexpr int kMaxDeaths = 3;

  explicit JobStore(Database& database) : database_(database) {}

  /// Durable when it returns. @throws Error kTrialNotFound
  std::string submit(const std::string& trial_id,
                     const std::string& settings_name,
                     const std::string& settings_json);
  /// @throws Error kJobNotFound
  api::JobView find(const std::string& job_id);

  /// The oldest queued job, now running and the caller's.
  std::optional<ClaimedJob> claimNext();
  /// Stages as they stand, and warnings to add.
  bool saveProgress(const JobTicket& ticket,
                    const std::vector<api::StageTiming>& stages,
                    const std::vector<std::string>& new_warnings);

  bool succeed(const JobTicket& ticket, const std::vector<ResultItem>& results);
  bool fail(const JobTicket& ticket, const std::string& error_json);
  bool cancelRunning(const JobTicket& ticket);
  /// Back to the queue without blame: the service is stopping.
  bool requeue(const JobTicket& ticket);

  /// Cancels a queued job; marks a running one for its worker.
  /// @throws Error kJobNotFound; kJobState if it has succeeded or failed
  void requestCancel(const std::string& job_id);

  /// For the start of the process, before any worker: running jobs go back to the queue, or end if
  /// they were to be cancelled or have died kMaxDeaths times.
  Recovery recover();

  /// @throws Error kJobNotFound; kResultNotReady; kResultNotFound
  std::string readResult(const std::string& job_id, ResultKind kind, const std::string& name);
  std::vector<api::FileView> listFiles(const std::string& job_id);
  api::FileContent readFile(const std::string& job_id, const std::string& name);

 private:
  struct Change {
    api::JobState to;
    std::optional<std::string> error;
    bool died = false;
  };
  bool change(Connection& db, const JobTicket& ticket, const Change& change);
  bool changeAlone(const JobTicket& ticket, const Change& change);
  void requireSucceeded(const std::string& job_id);

  Database& database_;
};

}  // namespace gaitmill
