#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "api/dto/object_reader.h"
#include "api/errors.h"
#include "service/storage/compression.h"
#include "service/storage/job_rows.h"
#include "service/storage/job_store.h"
#include "service/storage/result_kinds.h"
#include "service/storage/sql/jobs.h"
#include "service/storage/sql/results.h"

namespace gaitmill {

namespace {

using api::JobState;

// More than this gets a transaction of its own.
constexpr std::size_t kBulkSize = std::size_t{1} << 20;

struct PackedResult {
  ResultKind kind;
  std::string name;
  std::string stage;
  PackedBytes packed;
};

std::vector<PackedResult> packResults(const std::vector<ResultItem>& items,
                                      const std::string& stage) {
  std::vector<PackedResult> results;
  results.reserve(items.size());
  for (const ResultItem& item : items) {
    results.push_back(
        {item.kind, item.name, item.stage.empty() ? stage : item.stage, pack(item.bytes)});
  }
  return results;
}

std::size_t sumPacked(const std::vector<PackedResult>& results) {
  std::size_t size = 0;
  for (const PackedResult& result : results) {
    size += result.packed.bytes.size();
  }
  return size;
}

void putResults(Connection& db,
                const std::string& job_id,
                const std::vector<PackedResult>& results) {
  for (const PackedResult& result : results) {
    db.prepare(sql::kPutResult)
        .bind(1, job_id)
        .bind(2, resultKindName(result.kind))
        .bind(3, result.name)
        .bind(4, result.stage)
        .bind(5, result.packed.size)
        .bind(6, result.packed.sha256)
        .bind(7, encodingName(result.packed.encoding))
        .bindBytes(8, result.packed.bytes)
        .run();
  }
}

void putCheckpoint(Connection& db,
                   const std::string& job_id,
                   const std::string& stage,
                   const PackedBytes& packed) {
  db.prepare(sql::kPutCheckpoint)
      .bind(1, job_id)
      .bind(2, stage)
      .bind(3, packed.size)
      .bind(4, packed.sha256)
      .bind(5, encodingName(packed.encoding))
      .bindBytes(6, packed.bytes)
      .run();
}

EventText makeStageEvent(const api::StageTiming& stage, const char* status) {
  return {"stage",
          api::dumpJson({{"stage", stage.stage}, {"status", status}, {"seconds", stage.seconds}})};
}

EventText makeProgressEvent(const api::StageTiming& stage) {
  return {"progress",
          api::dumpJson(
              {{"stage", stage.stage}, {"fraction", stage.fraction}, {"seconds", stage.seconds}})};
}

// What a reader sees of the step from `before` to `now`.
std::vector<EventText> describeStep(const std::vector<api::StageTiming>& before,
                                    const std::vector<api::StageTiming>& now) {
  std::vector<EventText> events;
  for (const api::StageTiming& stage : now) {
    const auto old = std::find_if(before.begin(), before.end(), [&stage](const auto& other) {
      return other.stage == stage.stage;
    });
    const bool is_new = old == before.end();
    if (is_new) {
      events.push_back(makeStageEvent(stage, "started"));
    }
    const double fraction_before = is_new ? 0.0 : old->fraction;
    if (stage.fraction >= 1 && fraction_before < 1) {
      events.push_back(makeStageEvent(stage, "finished"));
    } else if (stage.fraction > fraction_before) {
      events.push_back(makeProgressEvent(stage));
    }
  }
  return events;
}

void putStages(Connection& db,
               const std::string& job_id,
               const std::vector<api::StageTiming>& stages) {
  std::int64_t position = 0;
  for (const api::StageTiming& stage : stages) {
    db.prepare(sql::kPutStage)
        .bind(1, job_id)
        .bind(2, position++)
        .bind(3, stage.stage)
        .bind(4, stage.seconds)
        .bind(5, stage.fraction)
        .run();
  }
}

std::vector<api::StageTiming> listStages(Connection& db, const std::string& job_id) {
  std::vector<api::StageTiming> stages;
  Statement rows = db.prepare(sql::kListStages);
  rows.bind(1, job_id);
  while (rows.step()) {
    stages.push_back({rows.text(0), rows.real(1), rows.real(2)});
  }
  return stages;
}

// Stages and warnings with their events; nothing if there is nothing new.
void recordStep(Connection& db,
                const std::string& job_id,
                const std::vector<api::StageTiming>& stages,
                const std::vector<std::string>& new_warnings,
                std::vector<JobChange>& changes) {
  std::vector<EventText> events = describeStep(listStages(db, job_id), stages);
  putStages(db, job_id, stages);
  for (const std::string& message : new_warnings) {
    db.prepare(sql::kAddWarning).bind(1, job_id).bind(2, message).run();
    events.push_back({"warning", api::dumpJson({{"message", message}})});
  }
  if (!events.empty()) {
    db.prepare(sql::kDropProgressEvents).bind(1, job_id).run();
    changes.push_back(recordEvents(db, job_id, events));
  }
}

}  // namespace

bool JobStore::writeAs(const JobTicket& ticket, Size size, const TicketWork& work) {
  Changes changes;
  const auto write = [&](Connection& db) {
    const auto standing = findJobStanding(db, ticket.job_id);
    if (!standing || !standing->isHeldWith(ticket.claim)) {
      return false;
    }
    work(db, *standing, changes);
    return true;
  };
  const bool held = size == Size::kBulk ? database_.writeBulk(write) : database_.write(write);
  announce(changes);
  return held;
}

bool JobStore::saveProgress(const JobTicket& ticket,
                            const std::vector<api::StageTiming>& stages,
                            const std::vector<std::string>& new_warnings) {
  return writeAs(ticket, Size::kSmall, [&](Connection& db, const JobStanding&, Changes& changes) {
    recordStep(db, ticket.job_id, stages, new_warnings, changes);
  });
}

bool JobStore::saveStage(const JobTicket& ticket, const FinishedStage& finished) {
  const PackedBytes checkpoint = pack(finished.checkpoint);
  const std::vector<PackedResult> results = packResults(finished.results, finished.stage);
  const bool is_bulk = checkpoint.bytes.size() + sumPacked(results) > kBulkSize;
  return writeAs(ticket,
                 is_bulk ? Size::kBulk : Size::kSmall,
                 [&](Connection& db, const JobStanding&, Changes& changes) {
                   putCheckpoint(db, ticket.job_id, finished.stage, checkpoint);
                   putResults(db, ticket.job_id, results);
                   recordStep(db, ticket.job_id, finished.stages, finished.new_warnings, changes);
                   db.prepare(sql::kSettleWarnings).bind(1, ticket.job_id).run();
                   db.prepare(sql::kForgiveDeaths).bind(1, ticket.job_id).run();
                 });
}

std::vector<std::string> JobStore::readCheckpoints(const std::string& job_id) {
  struct Stored {
    std::string stage;
    PackedBytes packed;
  };
  std::vector<Stored> stored;
  {
    const ReadTransaction db = database_.read();
    Statement rows = db->prepare(sql::kListCheckpoints);
    rows.bind(1, job_id);
    while (rows.step()) {
      stored.push_back(
          {rows.text(0),
           {findEncoding(rows.text(3)), rows.integer(1), rows.text(2), rows.bytes(4)}});
    }
  }
  std::vector<std::string> checkpoints;
  for (const Stored& one : stored) {
    checkpoints.push_back(unpack(one.packed, "the checkpoint of stage " + one.stage));
  }
  return checkpoints;
}

bool JobStore::succeed(const JobTicket& ticket,
                       const std::vector<ResultItem>& results,
                       const std::string& verdict) {
  const std::vector<PackedResult> packed = packResults(results, "");
  return writeAs(
      ticket,
      sumPacked(packed) > kBulkSize ? Size::kBulk : Size::kSmall,
      [&](Connection& db, const JobStanding& standing, Changes& changes) {
        putResults(db, ticket.job_id, packed);
        changes.push_back(endJob(db, ticket.job_id, standing, {JobState::kSucceeded, {}, verdict}));
      });
}

bool JobStore::fail(const JobTicket& ticket, const Error& error) {
  const std::string text = api::renderProblemObject(error);
  return writeAs(
      ticket, Size::kSmall, [&](Connection& db, const JobStanding& standing, Changes& changes) {
        changes.push_back(endJob(db, ticket.job_id, standing, {JobState::kFailed, text, ""}));
      });
}

bool JobStore::cancelRunning(const JobTicket& ticket) {
  return writeAs(
      ticket, Size::kSmall, [&](Connection& db, const JobStanding& standing, Changes& changes) {
        changes.push_back(endJob(db, ticket.job_id, standing, {JobState::kCancelled, {}, ""}));
      });
}

}  // namespace gaitmill
