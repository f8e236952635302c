#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "api/dto/job.h"
#include "core/base/error.h"
#include "service/storage/connection.h"
#include "service/storage/job_store.h"

namespace gaitmill {

inline constexpr const char* kJobPrefix = "job_";

Error jobNotFound(const std::string& job_id);

/// What decides about the next change of a job.
struct JobStanding {
  api::JobState state = api::JobState::kQueued;
  std::int64_t claim = 0;
  std::int64_t lease_until = 0;
  bool cancel_requested = false;
  std::int64_t deaths = 0;
  std::string owner;
  std::string study_id;
  std::string tenant;
  std::string key_id;
  std::int64_t frames = 0;
  std::int64_t pixels = 0;

  /// Whether the ticket with this claim may write.
  bool isHeldWith(std::int64_t ticket_claim) const;
};

std::optional<JobStanding> findJobStanding(Connection& db, const std::string& job_id);
/// @throws Error kJobNotFound if the tenant has no such job
JobStanding requireJob(Connection& db, const std::string& tenant, const std::string& job_id);

/// The next row of a SELECT with the columns of sql::kSelectJobs, without stages and warnings.
api::JobView readJobRow(const Statement& row);
/// Adds stages and warnings.
void completeJob(Connection& db, api::JobView& job);

struct EventText {
  const char* kind;
  std::string data;  ///< JSON object
};
EventText makeStateEvent(api::JobState state, std::int64_t attempt);

/// Within a write: counts one visible change per event and keeps the events.
JobChange recordEvents(Connection& db,
                       const std::string& job_id,
                       const std::vector<EventText>& events);

struct AddedJob {
  std::string id;
  std::vector<JobChange> changes;  ///< empty if it had been submitted before
};
/// Within a write. @param study_id  may be empty
AddedJob addJob(Connection& db, const NewJob& job, const std::string& study_id, const Quota& quota);

struct JobEnd {
  api::JobState state;
  std::optional<std::string> error;
  std::string verdict;
};
/// Within a write: to a final state; checkpoints go, the event is kept.
JobChange endJob(Connection& db,
                 const std::string& job_id,
                 const JobStanding& standing,
                 const JobEnd& end);

/// Within a write: an attempt has died, by this reason.
struct DeathRecord {
  DeathOutcome outcome;
  std::vector<JobChange> changes;
};
DeathRecord recordJobDeath(Connection& db,
                           const std::string& job_id,
                           const JobStanding& standing,
                           const Error& reason);

/// Within a write: cancels a job that nobody runs, marks one that is running.
/// @returns whether it is marked, so that its worker must be told
bool cancelJob(Connection& db,
               const std::string& job_id,
               const JobStanding& standing,
               std::vector<JobChange>& changes);

/// Within a write: with everything that belongs to it.
void dropJob(Connection& db, const std::string& job_id, const JobStanding& standing);

}  // namespace gaitmill
