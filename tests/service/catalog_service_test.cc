#include "service/catalog_service.h"

#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/io/files.h"
#include "service/catalog_readers.h"
#include "service/storage/sha256.h"
#include "tests/service/expect_error.h"
#include "tests/service/port_fixture.h"

namespace gaitmill {
namespace {

using nlohmann::json;

class CatalogServiceTest : public ::testing::Test {
 protected:
  api::CatalogPort& sets() { return fixture_.ports().marker_sets; }
  std::string add(const std::string& name) {
    return sets().add(who_, name, R"({"markers": ["RASI"]})").id;
  }
  std::vector<std::string> listPage(const std::string& cursor, int limit, std::string& next) {
    const auto page = sets().list(who_, {cursor, limit});
    std::vector<std::string> ids;
    for (const api::CatalogEntry& entry : page.items) {
      ids.push_back(entry.id);
    }
    next = page.next_cursor;
    return ids;
  }

  PortFixture fixture_;
  const api::Identity who_ = makeMember("gait lab");
};

TEST_F(CatalogServiceTest, OwnDocumentComesBackAsItWas) {
  const std::string document = R"({"markers": ["RASI", "LASI"], "more": 1})";
  const api::CatalogEntry entry = sets().add(who_, "mine", document);
  EXPECT_EQ(entry.id.rfind("mks_", 0), 0U);
  EXPECT_EQ(entry.sha256, calcSha256(document));
  EXPECT_FALSE(entry.shipped);
  EXPECT_EQ(json::parse(sets().find(who_, entry.id).summary_json)["markers"].size(), 2U);
  EXPECT_EQ(readSource(*sets().findDocument(who_, entry.id).bytes), document);
  sets().remove(who_, entry.id);
  EXPECT_ERROR(sets().find(who_, entry.id), ErrorCode::kMarkerSetNotFound);
}

TEST_F(CatalogServiceTest, ShippedDocumentsAreForEveryoneAndStay) {
  const api::CatalogEntry entry = sets().find(who_, "lab_b");
  EXPECT_TRUE(entry.shipped);
  EXPECT_EQ(readSource(*sets().findDocument(who_, "lab_b").bytes),
            R"({"markers": ["RASI", "LASI"]})");
  EXPECT_ERROR(sets().remove(who_, "lab_b"), ErrorCode::kCatalogInUse);
  EXPECT_ERROR(sets().find(who_, "lab_c"), ErrorCode::kMarkerSetNotFound);
  EXPECT_ERROR(fixture_.ports().models.find(who_, "lab_b"), ErrorCode::kModelNotFound);
}

TEST_F(CatalogServiceTest, RefusedDocumentStoresNothing) {
  EXPECT_ERROR(sets().add(who_, "bad", "not JSON"), ErrorCode::kModelXml);
  EXPECT_EQ(sets().list(who_, {}).items.size(), 2U) << "the shipped ones";
}

TEST_F(CatalogServiceTest, PagesOfAnySizeGiveOwnOnesFirstThenTheShippedEachOnce) {
  const std::string older = add("older");
  const std::string newer = add("newer");
  const std::vector<std::string> all = {newer, older, "lab_a", "lab_b"};
  for (int limit = 1; limit <= 5; ++limit) {
    std::vector<std::string> seen;
    std::string cursor;
    do {
      for (const std::string& id : listPage(cursor, limit, cursor)) {
        seen.push_back(id);
      }
      ASSERT_LE(seen.size(), all.size());
    } while (!cursor.empty());
    EXPECT_EQ(seen, all) << limit;
  }
}

TEST_F(CatalogServiceTest, DocumentThatATrialNamesStays) {
  const std::string id = add("mine");
  api::TrialUpload upload = makeUpload("abc");
  upload.subject.marker_set = id;
  const std::string trial = fixture_.ports().trials.submit(who_, upload).id;
  EXPECT_ERROR(sets().remove(who_, id), ErrorCode::kCatalogInUse);
  fixture_.ports().trials.remove(who_, trial);
  sets().remove(who_, id);
}

TEST(SummarizeModel, NamesWhatIsInTheShippedModel) {
  const std::string path = "models/rajagopal2016/rajagopal2016.osim";
  const json summary = json::parse(summarizeModel({"model.osim", readFile(path)}));
  EXPECT_EQ(summary["muscles"].size(), 80U);
  EXPECT_EQ(summary["counts"]["muscles"], 80);
  EXPECT_NEAR(summary["total_mass_kg"].get<double>(), 75.3, 1.0);
  EXPECT_TRUE(summary["warnings"].is_array());
}

TEST(SummarizeModel, RefusesWhatTheReaderRefuses) {
  EXPECT_ERROR(summarizeModel({"model.osim", "<a>"}), ErrorCode::kModelXml);
}

TEST(SummarizeMarkerSet, NamesTheMarkersThatInverseKinematicsFollows) {
  const std::string bytes = readFile("models/marker_sets/paper_walk.json");
  const json summary = json::parse(summarizeMarkerSet({"set.json", bytes}));
  std::set<std::string> followed;
  const json document = json::parse(bytes);
  for (const auto& [marker, weight] : document["ik"]["weights"].items()) {
    if (weight > 0) {
      followed.insert(marker);
    }
  }
  EXPECT_EQ(summary["name"], "paper_walk");
  EXPECT_EQ(summary["markers"].get<std::set<std::string>>(), followed);
}

}  // namespace
}  // namespace gaitmill
