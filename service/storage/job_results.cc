#include <array>
#include <utility>

#include "api/http.h"
#include "service/storage/compression.h"
#include "service/storage/job_rows.h"
#include "service/storage/job_store.h"
#include "service/storage/result_kinds.h"
#include "service/storage/sql/jobs.h"
#include "service/storage/sql/results.h"
#include "service/storage/usage_rows.h"

namespace gaitmill {

namespace {

constexpr std::array<std::pair<ResultKind, const char*>, 4> kKinds{
    {{ResultKind::kFile, "file"},
     {ResultKind::kTime, "time"},
     {ResultKind::kCycle, "cycle"},
     {ResultKind::kSummary, "summary"}}};

Error missingResult(api::JobState state, const std::string& name) {
  if (api::isFinal(state)) {
    return {ErrorCode::kResultNotFound,
            std::string("this job has ") + api::jobStateName(state) + " without a result '" + name +
                "' of this kind",
            {"", 0, 0, name}};
  }
  return {ErrorCode::kResultNotReady,
          "the job is " + std::string(api::jobStateName(state)) + " and has no result '" + name +
              "' yet; results come with the end of their stage",
          {"", 0, 0, name}};
}

}  // namespace

const char* resultKindName(ResultKind kind) {
  for (const auto& [known, name] : kKinds) {
    if (known == kind) {
      return name;
    }
  }
  return "";
}

ResultKind findResultKind(std::string_view name) {
  for (const auto& [kind, known] : kKinds) {
    if (known == name) {
      return kind;
    }
  }
  throw Error(ErrorCode::kStorage, "a stored result is of an unknown kind", {"", 0, 0, "kind"});
}

std::vector<ResultInfo> JobStore::listResults(const std::string& tenant,
                                              const std::string& job_id) {
  const ReadTransaction db = database_.read();
  if (!db->prepare(sql::kJobExists).bind(1, job_id).bind(2, tenant).step()) {
    throw jobNotFound(job_id);
  }
  std::vector<ResultInfo> results;
  Statement rows = db->prepare(sql::kListResults);
  rows.bind(1, job_id);
  while (rows.step()) {
    results.push_back(
        {findResultKind(rows.text(0)), rows.text(1), rows.text(2), rows.integer(3), rows.text(4)});
  }
  return results;
}

StoredResult JobStore::readResult(const std::string& tenant,
                                  const std::string& job_id,
                                  ResultKind kind,
                                  const std::string& name) {
  StoredResult result;
  PackedBytes packed;
  {
    const ReadTransaction db = database_.read();
    Statement job = db->prepare(sql::kJobExists);
    if (!job.bind(1, job_id).bind(2, tenant).step()) {
      throw jobNotFound(job_id);
    }
    Statement row = db->prepare(sql::kReadResult);
    row.bind(1, job_id).bind(2, resultKindName(kind)).bind(3, name);
    if (!row.step()) {
      throw missingResult(api::findJobState(job.text(0)), name);
    }
    packed = {findEncoding(row.text(3)), row.integer(1), row.text(2), row.bytes(4)};
    result.info = {kind, name, row.text(0), packed.size, packed.sha256};
  }
  result.bytes = unpack(packed, "the result '" + name + "'");
  return result;
}

void JobStore::chargePixels(const std::string& tenant,
                            const std::string& job_id,
                            std::int64_t pixels,
                            const Quota& quota) {
  if (quota.pixels == 0) {
    return;
  }
  database_.write([&](Connection& db) {
    const JobStanding standing = requireJob(db, tenant, job_id);
    db.prepare(sql::kAddPixels).bind(1, job_id).bind(2, pixels).run();
    chargeUsage(db, tenant, standing.key_id, {0, 0, 0, 0, pixels}, quota);
  });
}

std::vector<api::FileView> JobStore::listFiles(const std::string& tenant,
                                               const std::string& job_id) {
  std::vector<api::FileView> files;
  for (const ResultInfo& info : listResults(tenant, job_id)) {
    if (info.kind == ResultKind::kFile) {
      files.push_back({info.name, info.size, info.sha256});
    }
  }
  return files;
}

api::FileContent JobStore::readFile(const std::string& tenant,
                                    const std::string& job_id,
                                    const std::string& name) {
  StoredResult result = readResult(tenant, job_id, ResultKind::kFile, name);
  return {{name, result.info.size, result.info.sha256},
          api::makeByteSource(std::move(result.bytes))};
}

}  // namespace gaitmill
