#include "service/storage/trial_store.h"

#include <thread>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "service/storage/blob_store.h"
#include "service/storage/key_store.h"
#include "tests/service/storage/storage_fixture.h"

namespace gaitmill {
namespace {

using TrialStoreTest = StorageTest;

std::string readPart(TrialStore& trials, const std::string& id, const std::string& part) {
  return api::readAll(*trials.readFile(kTenant, id, part).bytes, 1U << 30U);
}

TEST_F(TrialStoreTest, FindsWhatWasAdded) {
  NewTrial trial = makeTrial({{"markers", std::string("by\0tes", 6)}});
  trial.subject.marker_set = "lab_a";
  trial.subject.options = R"({"ik":{}})";
  trial.subject.subject = "S01";
  trial.subject.label = "walk";
  trial.understanding.events = {{"foot_strike", "right", 0.5}};
  trial.understanding.warnings = {"one", "two"};
  const api::TrialView added = trials_.add(trial);
  const api::TrialView found = trials_.find(kTenant, added.id);
  EXPECT_EQ(api::renderTrial(found), api::renderTrial(added));
  EXPECT_EQ(found.files.at(0).size, 6);
  EXPECT_EQ(found.files.at(0).sha256.size(), 64U);
  EXPECT_EQ(found.subject.marker_set, "lab_a");
  EXPECT_EQ(found.subject.subject, "S01");
  EXPECT_EQ(found.warnings.size(), 2U);
  EXPECT_EQ(readPart(trials_, added.id, "markers"), std::string("by\0tes", 6));
  EXPECT_EQ(trials_.readFiles(kTenant, added.id).at("markers").name, "markers.trc");
}

TEST_F(TrialStoreTest, SameBytesAreStoredOnce) {
  const auto count = [this] {
    return queryInteger(database_, "SELECT count(*) FROM blobs");
  };
  const std::string first = trials_.add(makeTrial({{"markers", "same"}, {"static", "same"}})).id;
  const std::string second = trials_.add(makeTrial({{"markers", "same"}})).id;
  EXPECT_EQ(count(), 1);
  EXPECT_EQ(queryInteger(database_, "SELECT uses FROM blobs"), 3);
  trials_.add(makeTrial({{"markers", "other"}}));
  EXPECT_EQ(count(), 2);
  trials_.remove(kTenant, first);
  EXPECT_EQ(readPart(trials_, second, "markers"), "same");
  trials_.remove(kTenant, second);
  EXPECT_EQ(count(), 1);
  EXPECT_EQ(queryInteger(database_, "SELECT count(*) FROM blob_chunks"), 1);
}

TEST_F(TrialStoreTest, LargeFilesGoInChunks) {
  const std::string large =
      makeNoise(5 * BlobStore::kChunkSize / 2, 3) + std::string(BlobStore::kChunkSize, 'z');
  const std::string id = trials_.add(makeTrial({{"markers", large}})).id;
  EXPECT_EQ(queryInteger(database_, "SELECT count(*) FROM blob_chunks"), 4);
  EXPECT_EQ(queryText(database_, "SELECT encoding FROM blob_chunks ORDER BY begins LIMIT 1"), "raw")
      << "noise does not shrink";
  EXPECT_EQ(queryText(database_, "SELECT encoding FROM blob_chunks ORDER BY begins DESC LIMIT 1"),
            "zstd");
  const api::FileContent content = trials_.readFile(kTenant, id, "markers");
  EXPECT_EQ(content.bytes->size(), large.size());
  EXPECT_EQ(content.bytes->read(BlobStore::kChunkSize - 5, 10),
            large.substr(BlobStore::kChunkSize - 5, 10));
  EXPECT_EQ(content.bytes->read(large.size() - 3, 100), large.substr(large.size() - 3));
  EXPECT_EQ(content.bytes->read(large.size(), 10), "");
  EXPECT_TRUE(api::readAll(*content.bytes, 1U << 30U) == large);
  trials_.remove(kTenant, id);
  EXPECT_EQ(queryInteger(database_, "SELECT count(*) FROM blob_chunks"), 0);
  EXPECT_EQ(codeOf([&] { content.bytes->read(0, 1); }), ErrorCode::kStorage) << "deleted under us";
}

TEST_F(TrialStoreTest, SameLargeFileFromSeveralThreadsIsStoredOnce) {
  const std::string large = makeNoise(3 * BlobStore::kChunkSize, 4);
  std::vector<std::thread> uploads;
  for (int i = 0; i < 4; ++i) {
    uploads.emplace_back([&] { trials_.add(makeTrial({{"markers", large}})); });
  }
  for (std::thread& upload : uploads) {
    upload.join();
  }
  EXPECT_EQ(queryInteger(database_, "SELECT count(*) FROM blobs"), 1);
  EXPECT_EQ(queryInteger(database_, "SELECT uses FROM blobs"), 4);
  EXPECT_EQ(queryInteger(database_, "SELECT count(*) FROM blob_chunks"), 3);
}

// Uploading and deleting the same content at once: whoever has a trial can read it.
TEST_F(TrialStoreTest, ContentDeletedWhileItIsUploadedAgainStays) {
  const std::string bytes = makeNoise(3 * BlobStore::kChunkSize, 5);
  std::vector<std::thread> users;
  for (int i = 0; i < 4; ++i) {
    users.emplace_back([&] {
      for (int round = 0; round < 5; ++round) {
        const std::string id = trials_.add(makeTrial({{"markers", bytes}})).id;
        EXPECT_TRUE(readPart(trials_, id, "markers") == bytes);
        trials_.remove(kTenant, id);
      }
    });
  }
  for (std::thread& user : users) {
    user.join();
  }
  EXPECT_EQ(queryInteger(database_, "SELECT count(*) FROM blobs"), 0);
  EXPECT_EQ(database_.checkIntegrity(), "ok");
}

TEST_F(TrialStoreTest, UploadCutOffIsSweptAway) {
  tamper(database_,
         "INSERT INTO blobs (sha256, size, uses) VALUES ('a', 9000000, 0);"
         "INSERT INTO blob_chunks VALUES (last_insert_rowid(), 0, 1, 'raw', 'b', x'00')");
  EXPECT_EQ(trials_.removeUnfinishedUploads(), 1);
  EXPECT_EQ(queryInteger(database_, "SELECT count(*) FROM blob_chunks"), 0);
  EXPECT_EQ(trials_.removeUnfinishedUploads(), 0);
}

TEST_F(TrialStoreTest, FailingSourceLeavesNothing) {
  class FailingSource : public api::ByteSource {
   public:
    std::uint64_t size() const override { return 4 * BlobStore::kChunkSize; }
    std::string read(std::uint64_t offset, std::size_t size) const override {
      ++reads_;
      require(reads_ < 7, ErrorCode::kStorage, "the spool is gone");
      return std::string(std::min<std::size_t>(size, 4 * BlobStore::kChunkSize - offset), 'x');
    }

   private:
    mutable int reads_ = 0;
  };
  NewTrial trial = makeTrial({});
  trial.files["markers"] = {"w.trc", std::make_shared<FailingSource>()};
  EXPECT_EQ(codeOf([&] { trials_.add(trial); }), ErrorCode::kStorage);
  EXPECT_EQ(queryInteger(database_, "SELECT count(*) FROM blobs"), 0);
  EXPECT_EQ(queryInteger(database_, "SELECT count(*) FROM blob_chunks"), 0);
}

TEST_F(TrialStoreTest, AnotherTenantsTrialDoesNotExist) {
  const std::string id = trials_.add(makeTrial({{"markers", "bytes"}})).id;
  const auto expect_absent = [](auto call) {
    EXPECT_EQ(codeOf(call), ErrorCode::kTrialNotFound);
  };
  for (const std::string& other : {std::string("tri_none"), id}) {
    expect_absent([&] { trials_.find("lab_b", other); });
    expect_absent([&] { trials_.findSubject("lab_b", other); });
    expect_absent([&] { trials_.readFile("lab_b", other, "markers"); });
    expect_absent([&] { trials_.readFiles("lab_b", other); });
    expect_absent([&] { trials_.remove("lab_b", other); });
    expect_absent([&] {
      trials_.putFile("lab_b", other, {"a", api::makeByteSource("x")}, {}, [](auto&) {});
    });
  }
  EXPECT_TRUE(trials_.list("lab_b", {}, {}).items.empty());
  EXPECT_EQ(codeOf([&] { trials_.readFile(kTenant, id, "emg"); }), ErrorCode::kResultNotFound);
}

TEST_F(TrialStoreTest, DamagedBytesAreNotHandedOut) {
  const std::string id = trials_.add(makeTrial({{"markers", "bytes"}})).id;
  tamper(database_, "UPDATE blob_chunks SET bytes = 'bytez'");
  EXPECT_EQ(codeOf([&] { readPart(trials_, id, "markers"); }), ErrorCode::kStorage);
  const std::string large(3 * BlobStore::kChunkSize, 'a');
  const std::string gap = trials_.add(makeTrial({{"markers", large}})).id;
  tamper(database_, "DELETE FROM blob_chunks WHERE begins = 1048576");
  EXPECT_EQ(codeOf([&] { readPart(trials_, gap, "markers"); }), ErrorCode::kStorage);
}

TEST_F(TrialStoreTest, FilesArePutInOneByOneUntilAJobUsesThem) {
  const std::string id = trials_.add(makeTrial({})).id;
  api::UnderstoodFile grf;
  grf.part = "grf";
  api::UnderstoodFile markers;
  markers.part = "markers";
  const auto put = [&](const api::UnderstoodFile& file, const std::string& bytes) {
    return trials_.putFile(
        kTenant, id, {"f", api::makeByteSource(bytes)}, file, [](api::TrialView& view) {
          view.warnings = {std::to_string(view.files.size()) + " files"};
        });
  };
  put(grf, "forces");
  const api::TrialView both = put(markers, "old");
  ASSERT_EQ(both.files.size(), 2U);
  EXPECT_EQ(both.files[0].part, "markers") << "parts have an order of their own";
  EXPECT_EQ(both.files[0].size, 3);
  EXPECT_EQ(both.warnings, std::vector<std::string>{"2 files"});
  put(markers, "newer");
  EXPECT_EQ(readPart(trials_, id, "markers"), "newer");
  EXPECT_EQ(readPart(trials_, id, "grf"), "forces");
  EXPECT_EQ(api::renderTrial(trials_.find(kTenant, id)), api::renderTrial(put(markers, "newer")));
  EXPECT_EQ(queryInteger(database_, "SELECT count(*) FROM blobs"), 2);
  jobs_.submit(makeJob(id));
  EXPECT_EQ(codeOf([&] { put(markers, "late"); }), ErrorCode::kTrialInUse);
  EXPECT_EQ(codeOf([&] { trials_.remove(kTenant, id); }), ErrorCode::kTrialInUse);
}

TEST_F(TrialStoreTest, ListsNewestFirstInPages) {
  std::vector<std::string> ids;
  for (int i = 0; i < 5; ++i) {
    NewTrial trial = makeTrial({}, "lab_list");
    trial.subject.subject = i % 2 == 0 ? "even" : "odd";
    trial.subject.label = "label";
    ids.push_back(trials_.add(trial).id);
  }
  const auto page = trials_.list("lab_list", {}, {"", 2});
  ASSERT_EQ(page.items.size(), 2U);
  EXPECT_EQ(page.items[0].id, ids[4]);
  EXPECT_EQ(page.next_cursor, ids[3]);
  const auto next = trials_.list("lab_list", {}, {page.next_cursor, 50});
  ASSERT_EQ(next.items.size(), 3U);
  EXPECT_EQ(next.items[2].id, ids[0]);
  EXPECT_EQ(next.next_cursor, "");
  api::ListFilter odd;
  odd.subject = "odd";
  odd.label = "label";
  EXPECT_EQ(trials_.list("lab_list", odd, {}).items.size(), 2U);
  api::ListFilter late;
  late.created_after = page.items[0].created_at;
  EXPECT_TRUE(trials_.list("lab_list", late, {}).items.empty());
  late.created_after = page.items[0].created_at - 1;
  EXPECT_GE(trials_.list("lab_list", late, {}).items.size(), 1U);
  api::ListFilter early;
  early.created_before = trials_.find("lab_list", ids[0]).created_at;
  EXPECT_TRUE(trials_.list("lab_list", early, {}).items.empty());
  EXPECT_EQ(codeOf([&] {
              trials_.list("lab_list", {}, {"tri_'; --", 5});
            }),
            ErrorCode::kRequestField);
}

TEST_F(TrialStoreTest, QuotaOfAKeyHoldsAndDeletingGivesItBack) {
  NewTrial trial = makeTrial({{"markers", "12345"}});
  trial.key_id = "key_1";
  const Quota quota{8, 0, 0, 0};
  const std::string id = trials_.add(trial, quota).id;
  EXPECT_EQ(codeOf([&] { trials_.add(trial, quota); }), ErrorCode::kQuotaExceeded);
  EXPECT_EQ(KeyStore(database_).findUsage(kTenant, "key_1").bytes, 5);
  EXPECT_EQ(KeyStore(database_).findUsage(kTenant, "key_1").trials, 1);
  trials_.remove(kTenant, id);
  EXPECT_EQ(KeyStore(database_).findUsage(kTenant, "key_1").bytes, 0);
  EXPECT_NO_THROW(trials_.add(trial, quota));
}

TEST_F(TrialStoreTest, SubmissionRepeatedUnderItsKeyIsOneTrial) {
  NewTrial trial = makeTrial({{"markers", "bytes"}});
  trial.submission_key = "k1";
  const std::string id = trials_.add(trial).id;
  EXPECT_EQ(trials_.add(trial).id, id);
  EXPECT_EQ(queryInteger(database_, "SELECT uses FROM blobs"), 1);
  NewTrial other = makeTrial({{"markers", "bytes"}}, "lab_b");
  other.submission_key = "k1";
  EXPECT_NE(trials_.add(other).id, id);
}

TEST_F(TrialStoreTest, UnusedOnesAreListedForRetention) {
  const api::TrialView trial = trials_.add(makeTrial({}));
  submit();
  EXPECT_TRUE(trials_.listUnused(trial.created_at, 10).empty());
  const auto unused = trials_.listUnused(trial.created_at + 1, 10);
  ASSERT_EQ(unused.size(), 1U) << "the other has a job";
  EXPECT_EQ(unused[0].id, trial.id);
  EXPECT_EQ(unused[0].tenant, kTenant);
}

}  // namespace
}  // namespace gaitmill
