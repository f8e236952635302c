#include "service/zip_archive.h"

#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "service/storage/sha256.h"
#include "tests/service/zip_reader.h"
#include "tests/support/temporary_folder.h"

namespace gaitmill {
namespace {

ZipEntry makeEntry(const std::string& name, const std::string& bytes) {
  return {name, [bytes] {
            return api::makeByteSource(bytes);
          }};
}

std::string makeBytes(std::size_t size) {
  std::string bytes;
  unsigned int state = 1;
  while (bytes.size() < size) {
    state = state * 1664525U + 1013904223U;
    bytes += std::to_string(state % 1000U) + "\t";
  }
  bytes.resize(size);
  return bytes;
}

std::string makeExample(const TemporaryFolder& folder) {
  const auto zip = makeZip({makeEntry("results/moments.csv", "time\n0\n"),
                            makeEntry("inputs/markers/walk.trc", makeBytes(1'000'000)),
                            makeEntry("empty", "")},
                           folder.path());
  return zip->read(0, static_cast<std::size_t>(zip->size()));
}

TEST(ZipArchive, GivesBackItsFilesInAlphabeticalOrder) {
  const TemporaryFolder folder;
  const auto files = readZip(makeExample(folder));
  ASSERT_EQ(files.size(), 4U);
  EXPECT_EQ(files[0], std::make_pair(std::string("empty"), std::string()));
  EXPECT_EQ(files[1], std::make_pair(std::string("inputs/markers/walk.trc"), makeBytes(1'000'000)));
  EXPECT_EQ(files[2], std::make_pair(std::string("results/moments.csv"), std::string("time\n0\n")));
  EXPECT_EQ(files[3].first, "SHA256SUMS");
}

TEST(ZipArchive, ChecksumsHoldForEveryFile) {
  const TemporaryFolder folder;
  auto files = readZip(makeExample(folder));
  std::istringstream sums(files.back().second);
  files.pop_back();
  for (const auto& [name, bytes] : files) {
    std::string line;
    ASSERT_TRUE(std::getline(sums, line));
    EXPECT_EQ(line, calcSha256(bytes) + "  " + name);
  }
  std::string rest;
  EXPECT_FALSE(std::getline(sums, rest));
}

TEST(ZipArchive, EqualContentGivesEqualBytes) {
  const TemporaryFolder folder;
  const std::string first = makeExample(folder);
  EXPECT_EQ(makeExample(folder), first);
  EXPECT_LT(first.size(), 600'000U) << "not compressed";
}

TEST(ZipArchive, LeavesNothingInItsFolder) {
  const TemporaryFolder folder;
  const auto zip = makeZip({makeEntry("a", "b")}, folder.path());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(ZipArchive, ReadsOfItsBytesEndWithThem) {
  const TemporaryFolder folder;
  const auto zip = makeZip({makeEntry("a", "b")}, folder.path());
  EXPECT_EQ(zip->read(0, 1 << 20).size(), zip->size());
  EXPECT_EQ(zip->read(zip->size() - 1, 10).size(), 1U);
  EXPECT_EQ(zip->read(zip->size() + 5, 10), "");
}

TEST(ZipArchive, NamesOfClientsCannotLeaveTheirFolder) {
  EXPECT_EQ(makeArchiveName("walk 1.trc"), "walk_1.trc");
  EXPECT_EQ(makeArchiveName("../../etc/passwd"), ".._.._etc_passwd");
  EXPECT_EQ(makeArchiveName(".."), "file");
  EXPECT_EQ(makeArchiveName(""), "file");
  EXPECT_EQ(makeArchiveName(std::string(300, 'a')).size(), 100U);
}

}  // namespace
}  // namespace gaitmill
