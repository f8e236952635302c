// Lists, claims and polls step through an index, whatever they are narrowed to: no table is read
// from end to end, and nothing is sorted.

#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "service/storage/dialect.h"
#include "service/storage/list_query.h"
#include "service/storage/sql/blobs.h"
#include "service/storage/sql/catalog.h"
#include "service/storage/sql/jobs.h"
#include "service/storage/sql/keys.h"
#include "service/storage/sql/results.h"
#include "service/storage/sql/studies.h"
#include "service/storage/sql/trials.h"
#include "tests/service/storage/storage_fixture.h"

namespace gaitmill {
namespace {

class QueryPlanTest : public StorageTest {
 protected:
  std::string planOf(const std::string& sql) {
    std::string plan;
    const ReadTransaction db = database_.read();
    Statement rows = db->prepare("EXPLAIN QUERY PLAN " + sql);
    while (rows.step()) {
      plan += rows.text(3) + "\n";
    }
    return plan;
  }
  void expectIndexed(const std::string& sql) {
    const std::string plan = planOf(sql);
    EXPECT_EQ(plan.find("SCAN"), std::string::npos) << sql << "\n" << plan;
    EXPECT_EQ(plan.find("TEMP B-TREE"), std::string::npos) << sql << "\n" << plan;
  }
};

TEST_F(QueryPlanTest, EveryListIsARangeOfAnIndex) {
  for (unsigned choice = 0; choice < 128; ++choice) {
    const auto chosen = [choice](unsigned bit) {
      return (choice >> bit & 1U) != 0 ? std::string("x") : std::string();
    };
    const std::optional<std::int64_t> after =
        chosen(5).empty() ? std::nullopt : std::optional<std::int64_t>(1);
    ListQuery jobs(sql::kSelectJobs, kTenant, "job_");
    jobs.where("study_id =", chosen(0))
        .where("trial_id =", chosen(1))
        .whereNonEmpty("subject", chosen(2))
        .whereNonEmpty("label", chosen(3))
        .where("state =", chosen(4))
        .between(after, after)
        .page({chosen(6).empty() ? "" : "job_01hf3v6k9e2m8xw7p0q4t5r6s1", 50});
    expectIndexed(jobs.sql());
    ListQuery trials(sql::kSelectTrials, kTenant, "tri_");
    trials.whereNonEmpty("subject", chosen(2))
        .whereNonEmpty("label", chosen(3))
        .between(after, after)
        .page({});
    expectIndexed(trials.sql());
  }
}

TEST_F(QueryPlanTest, EveryStatementOfTheHotPathsUsesAnIndex) {
  const std::vector<std::string> statements = {dialect::kFindOldestQueued,
                                               dialect::kFindOldestLapsed,
                                               sql::kFindJob,
                                               sql::kFindSettings,
                                               sql::kListStages,
                                               sql::kListWarnings,
                                               sql::kCountAhead,
                                               sql::kListQueued,
                                               sql::kFindStanding,
                                               sql::kFindJobBySubmission,
                                               sql::kListHeldBy,
                                               sql::kListEvents,
                                               sql::kListChanges,
                                               sql::kCountLapsed,
                                               sql::kFindOldestQueuedTime,
                                               sql::kListFinished,
                                               sql::kListStudyJobs,
                                               sql::kListStudyStanding,
                                               sql::kFindTrial,
                                               sql::kFindTrialBySubmission,
                                               sql::kTrialHasJobs,
                                               sql::kListTrialFiles,
                                               sql::kFindTrialFile,
                                               sql::kFindBlob,
                                               sql::kReadChunk,
                                               sql::kListUnusedBlobs,
                                               sql::kListResults,
                                               sql::kReadResult,
                                               sql::kListCheckpoints,
                                               sql::kFindEntry,
                                               sql::kModelIsUsed,
                                               sql::kMarkerSetIsUsed,
                                               sql::kFindKeyByHash};
  for (const std::string& sql : statements) {
    if (sql != sql::kListUnusedBlobs) {  // a partial index that holds only these, read whole
      expectIndexed(sql);
    }
  }
  EXPECT_NE(planOf(sql::kListUnusedBlobs).find("blobs_unused"), std::string::npos);
}

}  // namespace
}  // namespace gaitmill
