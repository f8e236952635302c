#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/dto/job.h"
#include "api/dto/page.h"
#include "api/dto/result.h"
#include "core/base/error.h"
#include "service/storage/database.h"
#include "service/storage/trial_store.h"
#include "service/storage/usage.h"

namespace gaitmill {

struct JobStanding;

/// The right to write about a running job: its id and the number of the claim. Once another claim
/// exists, the job has been given back, or it has left the running state, nothing can be written
/// with this one.
struct JobTicket {
  std::string job_id;
  std::int64_t claim = 0;
};

struct NewJob {
  std::string tenant;
  std::string key_id;
  std::string trial_id;
  std::string model_id;  ///< "mod_…", a shipped model's name, or empty
  std::string label;
  std::string settings_name;  ///< empty if the job brought its own document
  std::string settings_json;  ///< the whole document
  std::string provenance;     ///< SHA-256, hex
  std::int64_t frames = 0;    ///< counted against the quota
  std::int64_t pixels = 0;    ///<
  /// Not empty: the job that this tenant submitted under the same key is returned instead of a
  /// second one, so that a request repeated after a crash changes nothing.
  std::string submission_key;
};

struct ClaimedJob {
  JobTicket ticket;
  std::string tenant;
  std::string trial_id;
  std::string model_id;
  std::string settings_json;
  std::string provenance;
  int deaths = 0;                        ///< of earlier attempts
  std::vector<api::StageTiming> stages;  ///< that earlier attempts finished, in order; their
                                         ///< checkpoints are there
};

/// How a ticket stands.
struct TicketStanding {
  bool is_held = false;  ///< false: the job is somebody else's, drop the work
  bool cancel_requested = false;
};

enum class ResultKind { kFile, kTime, kCycle, kSummary };

/// One thing a job produced, as bytes.
struct ResultItem {
  ResultKind kind;
  std::string name;
  std::string bytes;
  std::string stage{};  ///< that made it; empty = the finished stage, or the job as a whole
};

struct ResultInfo {
  ResultKind kind = ResultKind::kFile;
  std::string name;
  std::string stage;
  std::int64_t size = 0;  ///< [bytes]
  std::string sha256;     ///< hex
};

struct StoredResult {
  ResultInfo info;
  std::string bytes;
};

/// A stage that has ended: everything about it is stored in one transaction.
struct FinishedStage {
  std::string stage;
  std::string checkpoint;                ///< opaque bytes from which the next stage goes on
  std::vector<ResultItem> results;       ///< that it made or replaced
  std::vector<api::StageTiming> stages;  ///< all begun so far, as in saveProgress
  std::vector<std::string> new_warnings;
};

/// What became of a job whose attempt has died.
enum class DeathOutcome { kGivenBack, kFailed, kCancelled, kTicketVoid };

/// What became of the jobs of a process that is gone.
struct Recovery {
  int given_back = 0;
  int cancelled = 0;
  int abandoned = 0;
};

/// A job that has changed, for those who wait for it.
struct JobChange {
  std::int64_t change = 0;  ///< ascends over all jobs
  std::string job_id;
  std::string study_id;  ///< empty if it has none
};
using JobListener = std::function<void(const JobChange&)>;

struct QueueStatistics {
  std::map<std::string, std::int64_t> jobs;  ///< number by state, all five states
  std::int64_t depth = 0;                    ///< jobs that wait for a worker, given-back ones too
  std::optional<std::int64_t> oldest_queued_at;  ///< [ms since 1970 UTC] of the queued jobs
};

/// How long a stage has taken in the jobs that succeeded last.
struct StageEstimate {
  std::string stage;
  double seconds = 0;            ///< [s] mean
  double seconds_per_frame = 0;  ///< [s] mean over jobs that say their frames, else 0
};

/// Jobs, their events, checkpoints and results. States only move forward:
///
///   queued  -> running     a worker claims it
///   queued  -> cancelled   the user, before it began
///   running -> succeeded, failed, cancelled
///
/// A claim is a lease: the worker renews it by heartbeats. A running job whose lease has lapsed or
/// was given back can be claimed again and goes on after its last finished stage. Writers with a
/// ticket get false back when it is void; they then drop their work. Each call is one transaction,
/// durable when it returns. Every call may throw Error kStorage and kStorageFull; nothing has then
/// changed. Another tenant's job does not exist: kJobNotFound.
///
/// Events: each visible change adds one to `version` and one event with that id. Data by kind:
///   state     {"state": "running", "attempt": 1}; {"state": "failed", …} likewise
///   stage     {"stage": "ik", "status": "started" | "finished", "seconds": 1.2}
///   progress  {"stage": "ik", "fraction": 0.4, "seconds": 0.7}; only the last one is kept
///   warning   {"message": "…"}
class JobStore {
 public:
  /// A job whose attempts have died this often in the same stage has caused it, most likely. A
  /// finished stage counts from zero again: a service that is killed again and again must not give
  /// up jobs that move on.
  static constexpr int kMaxDeaths = 3;

  explicit JobStore(Database& database) : database_(database) {}

  /// Called after every durable change that this object makes, from the thread that made it, with
  /// nothing locked. Set it before the first use. Changes by other processes: listChanges().
  void setListener(JobListener listener) { listener_ = std::move(listener); }
  /// Tells the listener. For stores that change jobs, after their commit.
  void announce(const std::vector<JobChange>& changes) const;

  /// @throws Error kTrialNotFound, kModelNotFound, kQuotaExceeded
  std::string submit(const NewJob& job, const Quota& quota = {});

  /// With its settings. `seconds_left` is for the caller to fill. @throws Error kJobNotFound
  api::JobView find(const std::string& tenant, const std::string& job_id);
  /// Without settings, newest first. @throws Error kRequestField for a cursor that is no job's id
  ///         and for an unknown state
  api::Page<api::JobView> list(const std::string& tenant,
                               const api::ListFilter& filter,
                               const api::PageRequest& page);
  /// With events and results. @throws Error kJobNotFound; kJobState if it is not final
  void remove(const std::string& tenant, const std::string& job_id);
  /// Cancels a queued job at once; marks a running one for its worker, or cancels it if nobody
  /// holds it.
  /// @throws Error kJobNotFound; kJobState if it has succeeded or failed
  void requestCancel(const std::string& tenant, const std::string& job_id);
  /// After `after`, oldest first, at most `limit`. @throws Error kJobNotFound
  std::vector<api::JobEvent> listEvents(const std::string& tenant,
                                        const std::string& job_id,
                                        std::int64_t after,
                                        int limit = 1000);

  /// The oldest job that waits, now running and the caller's until `lease` is over. A lease that
  /// lapsed under another owner counts as a death.
  /// @param owner  of the process: "serve:<random>", "work:<random>"
  std::optional<ClaimedJob> claimNext(const std::string& owner, std::chrono::milliseconds lease);
  /// Renews the lease from now on, also one that has lapsed if nobody has claimed the job since.
  TicketStanding heartbeat(const JobTicket& ticket, std::chrono::milliseconds lease);
  /// The same question without writing: cheap enough to ask every 50 ms.
  TicketStanding findStanding(const JobTicket& ticket);

  /// Stages as they stand, and warnings to add.
  bool saveProgress(const JobTicket& ticket,
                    const std::vector<api::StageTiming>& stages,
                    const std::vector<std::string>& new_warnings);
  bool saveStage(const JobTicket& ticket, const FinishedStage& finished);
  /// Of the stages finished so far, in their order. @throws Error kStorage if one is damaged
  std::vector<std::string> readCheckpoints(const std::string& job_id);

  /// @param verdict  "pass", "warn" or "fail"
  bool succeed(const JobTicket& ticket,
               const std::vector<ResultItem>& results,
               const std::string& verdict);
  bool fail(const JobTicket& ticket, const Error& error);
  bool cancelRunning(const JobTicket& ticket);
  /// Without blame: the service is stopping. The job stays running and anybody may claim it.
  bool giveBack(const JobTicket& ticket);
  /// The attempt's process crashed, hung, or ran out of memory. The third death fails the job with
  /// this reason's code; a job to be cancelled is cancelled.
  DeathOutcome recordDeath(const JobTicket& ticket, const Error& reason);
  /// For the start of the service: the processes whose owner begins with the prefix are gone; each
  /// of their jobs has died with them.
  Recovery lapseLeases(const std::string& owner_prefix);

  /// What the job has so far, by kind and name. @throws Error kJobNotFound
  std::vector<ResultInfo> listResults(const std::string& tenant, const std::string& job_id);
  /// Verified. As soon as its stage has finished.
  /// @throws Error kJobNotFound; kResultNotReady while it may still come; kResultNotFound
  StoredResult readResult(const std::string& tenant,
                          const std::string& job_id,
                          ResultKind kind,
                          const std::string& name);
  std::vector<api::FileView> listFiles(const std::string& tenant, const std::string& job_id);
  api::FileContent readFile(const std::string& tenant,
                            const std::string& job_id,
                            const std::string& name);

  /// Adds pixels of an image to what the job's key has used. Where the quota has no limit for them
  /// nothing is counted, so that looking at images writes nothing.
  /// @throws Error kJobNotFound, kQuotaExceeded
  void chargePixels(const std::string& tenant,
                    const std::string& job_id,
                    std::int64_t pixels,
                    const Quota& quota);

  /// The number of the last change of any job: one indexed read.
  std::int64_t lastChange();
  /// Changed after `since`, in the order of change, each job once, at most 1000.
  std::vector<JobChange> listChanges(std::int64_t since);

  QueueStatistics calcStatistics();
  /// From the last 50 jobs that succeeded, of all tenants.
  std::vector<StageEstimate> calcStageEstimates();
  /// Final jobs that ended before `time` [ms since 1970 UTC], oldest first, of all tenants: for
  /// retention.
  std::vector<OwnedId> listFinished(std::int64_t time, int limit);

 private:
  enum class Size { kSmall, kBulk };
  using Changes = std::vector<JobChange>;
  using TicketWork = std::function<void(Connection&, const JobStanding&, Changes&)>;

  /// Does the work within a write if the ticket is good, and announces the changes.
  bool writeAs(const JobTicket& ticket, Size size, const TicketWork& work);

  Database& database_;
  JobListener listener_;
};

}  // namespace gaitmill
