#include <algorithm>
#include <utility>

#include "service/storage/clock.h"
#include "service/storage/dialect.h"
#include "service/storage/job_rows.h"
#include "service/storage/job_store.h"
#include "service/storage/sql/jobs.h"

namespace gaitmill {

namespace {

using api::JobState;

Error describeLapse(const std::string& owner) {
  return {ErrorCode::kJobAbandoned,
          "the process that ran it (" + owner + ") ended or stood still past its lease",
          {"", 0, 0, "attempt"}};
}

std::optional<std::string> firstId(Statement rows) {
  return rows.step() ? std::optional(rows.text(0)) : std::nullopt;
}

std::optional<std::string> findClaimable(Connection& db, std::int64_t now) {
  const auto queued = firstId(db.prepare(dialect::kFindOldestQueued));
  Statement lapsed_rows = db.prepare(dialect::kFindOldestLapsed);
  lapsed_rows.bind(1, now);
  const auto lapsed = firstId(std::move(lapsed_rows));
  if (queued && lapsed) {
    return std::min(*queued, *lapsed);
  }
  return queued ? queued : lapsed;
}

ClaimedJob readClaimed(Connection& db, const std::string& job_id) {
  ClaimedJob job;
  {
    Statement row = db.prepare(sql::kReadClaimed);
    row.bind(1, job_id).step();
    job.tenant = row.text(0);
    job.trial_id = row.text(1);
    job.model_id = row.text(2);
    job.provenance = row.text(3);
    job.deaths = static_cast<int>(row.integer(4));
    job.ticket = {job_id, row.integer(5)};
  }
  api::JobView view;
  view.id = job_id;
  completeJob(db, view);
  job.stages = std::move(view.stages);
  Statement settings = db.prepare(sql::kFindSettings);
  settings.bind(1, job_id).step();
  job.settings_json = settings.text(0);
  return job;
}

// Whether a job is free to be claimed. One whose lease lapsed under another owner has died with
// it; a process that claims what it held itself has only been slow, on a full disk for instance.
bool settleLapse(Connection& db,
                 const std::string& job_id,
                 const std::string& owner,
                 std::vector<JobChange>& changes) {
  const JobStanding standing = findJobStanding(db, job_id).value();
  if (standing.lease_until > 0 && standing.owner != owner) {
    DeathRecord death = recordJobDeath(db, job_id, standing, describeLapse(standing.owner));
    changes.insert(changes.end(), death.changes.begin(), death.changes.end());
    return death.outcome == DeathOutcome::kGivenBack;
  }
  if (standing.cancel_requested) {
    changes.push_back(endJob(db, job_id, standing, {JobState::kCancelled, {}, ""}));
    return false;
  }
  return true;
}

ClaimedJob claim(Connection& db,
                 const std::string& job_id,
                 const std::string& owner,
                 std::chrono::milliseconds lease,
                 std::vector<JobChange>& changes) {
  const std::int64_t now = nowMilliseconds();
  db.prepare(sql::kClaim)
      .bind(1, job_id)
      .bind(2, owner)
      .bind(3, now + lease.count())
      .bind(4, now)
      .run();
  db.prepare(sql::kDropUnfinishedStages).bind(1, job_id).run();
  db.prepare(sql::kDropUnsettledWarnings).bind(1, job_id).run();
  ClaimedJob job = readClaimed(db, job_id);
  changes.push_back(
      recordEvents(db, job_id, {makeStateEvent(JobState::kRunning, job.ticket.claim)}));
  return job;
}

}  // namespace

std::optional<ClaimedJob> JobStore::claimNext(const std::string& owner,
                                              std::chrono::milliseconds lease) {
  // Idle workers ask often; only a job that waits is worth a transaction.
  if (!findClaimable(*database_.read(), nowMilliseconds())) {
    return std::nullopt;
  }
  std::vector<JobChange> changes;
  const auto claimed = database_.write([&](Connection& db) -> std::optional<ClaimedJob> {
    while (const auto job_id = findClaimable(db, nowMilliseconds())) {
      if (settleLapse(db, *job_id, owner, changes)) {
        return claim(db, *job_id, owner, lease, changes);
      }
    }
    return std::nullopt;
  });
  announce(changes);
  return claimed;
}

TicketStanding JobStore::heartbeat(const JobTicket& ticket, std::chrono::milliseconds lease) {
  return database_.write([&](Connection& db) -> TicketStanding {
    const auto standing = findJobStanding(db, ticket.job_id);
    if (!standing || !standing->isHeldWith(ticket.claim)) {
      return {};
    }
    db.prepare(sql::kRenewLease)
        .bind(1, ticket.job_id)
        .bind(2, nowMilliseconds() + lease.count())
        .run();
    return {true, standing->cancel_requested};
  });
}

TicketStanding JobStore::findStanding(const JobTicket& ticket) {
  const auto standing = findJobStanding(*database_.read(), ticket.job_id);
  if (!standing || !standing->isHeldWith(ticket.claim)) {
    return {};
  }
  return {true, standing->cancel_requested};
}

bool JobStore::giveBack(const JobTicket& ticket) {
  return writeAs(ticket, Size::kSmall, [&](Connection& db, const JobStanding&, Changes&) {
    db.prepare(sql::kGiveBack)
        .bind(1, ticket.job_id)
        .bind(2, std::int64_t{0})
        .bind(3, std::optional<std::string>())
        .run();
  });
}

DeathOutcome JobStore::recordDeath(const JobTicket& ticket, const Error& reason) {
  DeathOutcome outcome = DeathOutcome::kTicketVoid;
  writeAs(ticket, Size::kSmall, [&](Connection& db, const JobStanding& standing, Changes& changes) {
    const DeathRecord death = recordJobDeath(db, ticket.job_id, standing, reason);
    outcome = death.outcome;
    changes = death.changes;
  });
  return outcome;
}

Recovery JobStore::lapseLeases(const std::string& owner_prefix) {
  Recovery recovery;
  std::vector<JobChange> changes;
  database_.write([&](Connection& db) {
    std::vector<std::string> orphans;
    {
      Statement rows = db.prepare(sql::kListHeldBy);
      rows.bind(1, owner_prefix);
      while (rows.step()) {
        orphans.push_back(rows.text(0));
      }
    }
    for (const std::string& job_id : orphans) {
      const JobStanding standing = findJobStanding(db, job_id).value();
      const DeathRecord death = recordJobDeath(db, job_id, standing, describeLapse(standing.owner));
      changes.insert(changes.end(), death.changes.begin(), death.changes.end());
      recovery.given_back += death.outcome == DeathOutcome::kGivenBack ? 1 : 0;
      recovery.cancelled += death.outcome == DeathOutcome::kCancelled ? 1 : 0;
      recovery.abandoned += death.outcome == DeathOutcome::kFailed ? 1 : 0;
    }
  });
  announce(changes);
  return recovery;
}

}  // namespace gaitmill
