#include "service/storage/trial_store.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/temporary_folder.h"

namespace gaitmill {
namespace {

class TrialStoreTest : public ::testing::Test {
 protected:
  api::TrialView add(const std::string& markers) {
    api::TrialUpload upload;
    upload.subject = {75.3, 1.7, "lab_a", R"({"ik":{}})"};
    upload.files["markers"] = {"walk.trc", markers};
    api::TrialView view;
    view.warnings = {"one", "two"};
    api::UnderstoodFile file;
    file.part = "markers";
    file.name = "walk.trc";
    file.format = "trc";
    file.frames = 3;
    file.labels_kind = "markers";
    file.labels = {"RASI"};
    view.files = {file};
    return store_.add(upload, view);
  }
  std::int64_t countBlobs() {
    Statement row = database_.connection().prepare("SELECT count(*) FROM blobs");
    row.step();
    return row.integer(0);
  }

  TemporaryFolder folder_;
  Database database_{folder_ / "mill.db"};
  TrialStore store_{database_};
};

TEST_F(TrialStoreTest, FindsWhatWasAdded) {
  const api::TrialView added = add(std::string("by\0tes", 6));
  const api::TrialView found = store_.find(added.id);
  EXPECT_EQ(api::renderTrial(found), api::renderTrial(added));
  EXPECT_EQ(found.files[0].size, 6);
  EXPECT_EQ(found.subject.marker_set, "lab_a");
  EXPECT_EQ(store_.readFiles(added.id).at("markers").bytes, std::string("by\0tes", 6));
}

TEST_F(TrialStoreTest, SameBytesAreStoredOnce) {
  add("same");
  add("same");
  EXPECT_EQ(countBlobs(), 1);
  add("other");
  EXPECT_EQ(countBlobs(), 2);
}

TEST_F(TrialStoreTest, UnknownTrialIsNotFound) {
  try {
    store_.find("tri_none");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kTrialNotFound);
  }
}

TEST_F(TrialStoreTest, DamagedBytesAreNotHandedOut) {
  const std::string id = add("bytes").id;
  database_.connection().runScript("UPDATE blobs SET bytes = x'00'");
  EXPECT_THROW(store_.readFiles(id), Error);
}

}  // namespace
}  // namespace gaitmill
