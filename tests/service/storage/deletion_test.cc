// Deleted bytes are gone from the disk: every file of the database is searched for them.

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "service/storage/catalog_store.h"
#include "tests/service/storage/storage_fixture.h"

namespace gaitmill {
namespace {

class DeletionTest : public StorageTest {
 protected:
  bool isOnDisk(const std::string& marker) {
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      std::ifstream file(entry.path(), std::ios::binary);
      const std::string bytes((std::istreambuf_iterator<char>(file)), {});
      if (bytes.find(marker) != std::string::npos) {
        return true;
      }
    }
    return false;
  }
  // Noise stays as it is when it is stored, so that a part of it can be found.
  static std::string partOf(const std::string& noise) { return noise.substr(noise.size() / 2, 64); }
};

TEST_F(DeletionTest, TakesTheFilesOfATrialOffTheDisk) {
  for (const std::size_t size : {std::size_t{3'000}, std::size_t{5'000'000}}) {
    const std::string noise = makeNoise(size, 21);
    const std::string id = trials_.add(makeTrial({{"markers", noise}})).id;
    EXPECT_TRUE(isOnDisk(partOf(noise)));
    trials_.remove(kTenant, id);
    EXPECT_FALSE(isOnDisk(partOf(noise))) << size << " bytes";
  }
}

TEST_F(DeletionTest, TakesReplacedFilesOffTheDisk) {
  const std::string noise = makeNoise(30'000, 22);
  const std::string id = trials_.add(makeTrial({{"markers", noise}})).id;
  api::UnderstoodFile markers;
  markers.part = "markers";
  trials_.putFile(kTenant, id, {"n", api::makeByteSource("new")}, markers, [](auto&) {});
  EXPECT_FALSE(isOnDisk(partOf(noise)));
}

TEST_F(DeletionTest, KeepsBytesThatAnotherTrialHas) {
  const std::string noise = makeNoise(30'000, 23);
  const std::string first = trials_.add(makeTrial({{"markers", noise}})).id;
  const std::string second = trials_.add(makeTrial({{"markers", noise}}, "lab_b")).id;
  trials_.remove(kTenant, first);
  EXPECT_TRUE(isOnDisk(partOf(noise)));
  trials_.remove("lab_b", second);
  EXPECT_FALSE(isOnDisk(partOf(noise)));
}

TEST_F(DeletionTest, TakesResultsAndNamesOffTheDisk) {
  NewJob job = makeJob(trial_);
  job.label = "label-of-a-deleted-job";
  const std::string id = jobs_.submit(job);
  const std::string noise = makeNoise(100'000, 24);
  const std::string checkpoint = makeNoise(100'000, 25);
  const JobTicket ticket = claim();
  jobs_.saveStage(ticket, {"ik", checkpoint, {{ResultKind::kTime, "q", noise, ""}}, {}, {}});
  jobs_.succeed(ticket, {}, "pass");
  EXPECT_TRUE(isOnDisk(partOf(noise)));
  EXPECT_TRUE(isOnDisk(job.label));
  jobs_.remove(kTenant, id);
  EXPECT_FALSE(isOnDisk(partOf(noise)));
  EXPECT_FALSE(isOnDisk(partOf(checkpoint)));
  EXPECT_FALSE(isOnDisk(job.label));
}

TEST_F(DeletionTest, TakesCatalogDocumentsOffTheDisk) {
  CatalogStore models(database_, CatalogKind::kModel);
  const std::string noise = makeNoise(30'000, 26);
  NewCatalogEntry entry;
  entry.tenant = kTenant;
  entry.document = noise;
  entry.summary_json = "{}";
  const std::string id = models.add(entry).id;
  models.remove(kTenant, id);
  EXPECT_FALSE(isOnDisk(partOf(noise)));
}

// A reader of another process keeps the log; it is emptied as soon as the reader has gone.
TEST_F(DeletionTest, WaitsForReadersAndThenHappensByItself) {
  const std::string noise = makeNoise(30'000, 27);
  const std::string id = trials_.add(makeTrial({{"markers", noise}})).id;
  {
    const ReadTransaction reader = database_.read();
    reader->prepare("SELECT count(*) FROM trials").step();
    trials_.remove(kTenant, id);
    EXPECT_FALSE(database_.wipeDeleted());
  }
  EXPECT_TRUE(database_.wipeDeleted());
  EXPECT_FALSE(isOnDisk(partOf(noise)));
}

}  // namespace
}  // namespace gaitmill
