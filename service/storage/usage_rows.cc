#include "service/storage/usage_rows.h"

#include "core/base/error.h"
#include "service/storage/sql/usage.h"

namespace gaitmill {

namespace {

struct Limit {
  std::int64_t change;
  std::int64_t after;
  std::int64_t most;  ///< 0 = no limit
  const char* name;
};

void requireWithin(const Limit& limit) {
  if (limit.change <= 0 || limit.most == 0 || limit.after <= limit.most) {
    return;
  }
  throw Error(ErrorCode::kQuotaExceeded,
              "this key would have " + std::to_string(limit.after) + " " + limit.name +
                  " stored, its quota is " + std::to_string(limit.most),
              {"", 0, 0, limit.name});
}

}  // namespace

void chargeUsage(Connection& db,
                 const std::string& tenant,
                 const std::string& key_id,
                 const Usage& change,
                 const Quota& quota) {
  Statement row = db.prepare(sql::kCharge);
  row.bind(1, tenant)
      .bind(2, key_id)
      .bind(3, change.bytes)
      .bind(4, change.trials)
      .bind(5, change.jobs)
      .bind(6, change.frames)
      .bind(7, change.pixels)
      .step();
  requireWithin({change.bytes, row.integer(0), quota.bytes, "bytes"});
  requireWithin({change.jobs, row.integer(2), quota.jobs, "jobs"});
  requireWithin({change.frames, row.integer(3), quota.frames, "frames"});
  requireWithin({change.pixels, row.integer(4), quota.pixels, "pixels"});
}

std::int64_t nextCount(Connection& db, const char* counter) {
  Statement row = db.prepare(sql::kCount);
  row.bind(1, counter).step();
  return row.integer(0);
}

}  // namespace gaitmill
