#include "service/trial_service.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "service/storage/sha256.h"
#include "tests/service/expect_error.h"
#include "tests/service/port_fixture.h"

namespace gaitmill {
namespace {

class TrialServiceTest : public ::testing::Test {
 protected:
  api::TrialPort& trials() { return fixture_.ports().trials; }
  bool isOnDisk(const std::string& bytes) const {
    for (const auto& entry : std::filesystem::directory_iterator(fixture_.folder().path())) {
      if (!entry.is_regular_file()) {
        continue;
      }
      std::ifstream file(entry.path(), std::ios::binary);
      const std::string content{std::istreambuf_iterator<char>(file), {}};
      if (content.find(bytes) != std::string::npos) {
        return true;
      }
    }
    return false;
  }

  PortFixture fixture_;
  const api::Identity who_ = makeMember("gait lab");
};

TEST_F(TrialServiceTest, AnswerSaysWhatWasUnderstood) {
  const api::TrialView trial = trials().submit(who_, makeUpload("abc"));
  EXPECT_EQ(trial.id.rfind("tri_", 0), 0U);
  ASSERT_EQ(trial.files.size(), 1U);
  EXPECT_EQ(trial.files[0].frames, 3);
  EXPECT_EQ(trial.files[0].size, 3);
  EXPECT_EQ(trial.files[0].sha256, calcSha256("abc"));
  ASSERT_EQ(trial.files[0].marker_sets.size(), 2U);
  EXPECT_EQ(trial.files[0].marker_sets[0].marker_set, "lab_b") << "best match first";
  EXPECT_TRUE(trial.files[0].marker_sets[0].missing.empty());
  EXPECT_EQ(trial.files[0].marker_sets[1].missing, std::vector<std::string>{"RKNE"});
  const api::TrialView again = trials().find(who_, trial.id);
  EXPECT_EQ(again.files[0].marker_sets.size(), 2U);
  EXPECT_EQ(again.files[0].sha256, trial.files[0].sha256);
}

TEST_F(TrialServiceTest, OwnMarkerSetsAreKnownToTheirTenantOnly) {
  const std::string id =
      fixture_.ports().marker_sets.add(who_, "mine", R"({"markers": ["RASI"]})").id;
  const auto upload = makeUpload("abc");
  const auto mine = trials().validate(who_, upload).files[0].marker_sets;
  ASSERT_EQ(mine.size(), 3U);
  EXPECT_EQ(mine[1].marker_set, id);
  EXPECT_EQ(trials().validate(makeMember("other"), upload).files[0].marker_sets.size(), 2U);
}

TEST_F(TrialServiceTest, DryRunSaysTheSameAndStoresNothing) {
  const api::TrialView dry = trials().validate(who_, makeUpload("never stored bytes"));
  EXPECT_EQ(dry.id, "");
  EXPECT_EQ(dry.files[0].sha256, calcSha256("never stored bytes"));
  EXPECT_EQ(dry.files[0].size, 18);
  EXPECT_TRUE(trials().list(who_, {}, {}).items.empty());
  fixture_.reopen();
  EXPECT_FALSE(isOnDisk("never stored bytes"));
}

TEST_F(TrialServiceTest, RefusedFileStoresNothing) {
  EXPECT_ERROR(trials().submit(who_, makeUpload("")), ErrorCode::kFileEmpty);
  EXPECT_TRUE(trials().list(who_, {}, {}).items.empty());
}

TEST_F(TrialServiceTest, MovementIsNeededUnlessFilesComeLater) {
  api::TrialUpload upload = makeUpload("abc");
  upload.files["grf"] = upload.files["markers"];
  upload.files.erase("markers");
  EXPECT_ERROR(trials().submit(who_, upload), ErrorCode::kInputMissing);
  upload.files.clear();
  EXPECT_TRUE(trials().submit(who_, upload).files.empty());
}

TEST_F(TrialServiceTest, MarkerSetThatNobodyHasIsRefused) {
  api::TrialUpload upload = makeUpload("abc");
  upload.subject.marker_set = "lab_c";
  EXPECT_ERROR(trials().submit(who_, upload), ErrorCode::kMarkerSetNotFound);
  upload.subject.marker_set = "mks_00000000000000000000000000";
  EXPECT_ERROR(trials().submit(who_, upload), ErrorCode::kMarkerSetNotFound);
  upload.subject.marker_set = "lab_b";
  EXPECT_EQ(trials().submit(who_, upload).subject.marker_set, "lab_b");
}

TEST_F(TrialServiceTest, FilesAreAddedAndReplacedOneByOne) {
  api::TrialUpload empty;
  empty.subject = makeUpload("").subject;
  const std::string id = trials().submit(who_, empty).id;
  trials().putFile(who_, id, "markers", {"a.trc", api::makeByteSource("first")});
  trials().putFile(who_, id, "grf", {"a.mot", api::makeByteSource("force")});
  const api::TrialView trial =
      trials().putFile(who_, id, "markers", {"b.trc", api::makeByteSource("second")});
  ASSERT_EQ(trial.files.size(), 2U);
  EXPECT_EQ(trial.files[0].name, "b.trc");
  EXPECT_EQ(trial.files[0].sha256, calcSha256("second"));
  EXPECT_EQ(trial.files[1].sha256, calcSha256("force"));
  EXPECT_EQ(readSource(*trials().findFile(who_, id, "markers").bytes), "second");
  EXPECT_EQ(readSource(*trials().findFile(who_, id, "grf").bytes), "force");
}

TEST_F(TrialServiceTest, FileOfAnUnknownPartNamesTheNearest) {
  const std::string id = fixture_.addTrial(who_);
  try {
    trials().putFile(who_, id, "marker", {"a", api::makeByteSource("b")});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kRequestField);
    EXPECT_NE(error.message().find("'markers'"), std::string::npos);
  }
}

TEST_F(TrialServiceTest, TrialOfAJobNeitherChangesNorGoes) {
  const std::string id = fixture_.addTrial(who_);
  const std::string job = fixture_.addJob(who_, id);
  EXPECT_ERROR(trials().putFile(who_, id, "markers", {"a", api::makeByteSource("b")}),
               ErrorCode::kTrialInUse);
  EXPECT_ERROR(trials().remove(who_, id), ErrorCode::kTrialInUse);
  fixture_.runNextJob();
  fixture_.ports().jobs.remove(who_, job);
  trials().remove(who_, id);
  EXPECT_ERROR(trials().find(who_, id), ErrorCode::kTrialNotFound);
}

// Bytes that zstd leaves as they are, so that they can be searched for.
TEST_F(TrialServiceTest, RemovedTrialIsNotOnTheDiskAnyMore) {
  const std::string secret = "Jane Doe, born 1970-01-01";
  const std::string id = fixture_.addTrial(who_, secret);
  fixture_.database().wipeDeleted();
  EXPECT_TRUE(isOnDisk(secret));
  trials().remove(who_, id);
  EXPECT_FALSE(isOnDisk(secret));
}

TEST_F(TrialServiceTest, RepeatedSubmissionIsTheSameTrial) {
  api::TrialUpload upload = makeUpload("abc");
  upload.submission_key = "monday";
  const std::string id = trials().submit(who_, upload).id;
  EXPECT_EQ(trials().submit(who_, upload).id, id);
  EXPECT_NE(trials().submit(makeMember("gait lab", "key_2"), upload).id, id) << "another key's";
}

TEST(TrialServiceQuota, BytesBeyondTheQuotaAreRefusedAndGivenBackByRemoval) {
  Quota quota;
  quota.bytes = 10;
  PortFixture fixture(quota);
  const api::Identity who = makeMember("gait lab", "key_1");
  const std::string id = fixture.addTrial(who, "123456");
  EXPECT_ERROR(fixture.addTrial(who, "abcdef"), ErrorCode::kQuotaExceeded);
  fixture.addTrial(makeMember("gait lab", "key_2"), "abcdef");
  fixture.ports().trials.remove(who, id);
  fixture.addTrial(who, "abcdef");
}

}  // namespace
}  // namespace gaitmill
