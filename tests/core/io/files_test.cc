#include "core/io/files.h"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace gaitmill {
namespace {

class Files : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() /
        ("gaitmill_files_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
         ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  ErrorCode codeOfReading(const std::string& name, std::size_t limit = kMaximumFileSize) const {
    try {
      readFile(path(name), limit);
    } catch (const Error& error) {
      EXPECT_EQ(error.where().file, path(name));
      return error.code();
    }
    return ErrorCode::kInternal;
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(Files, WrittenBytesAreReadBack) {
  const std::string bytes("a\0b\r\n", 5);
  writeFile(path("new/folder/a.bin"), bytes);
  EXPECT_EQ(readFile(path("new/folder/a.bin")), bytes);
}

TEST_F(Files, ReplacingLeavesNothingElseBehind) {
  writeFile(path("a.txt"), "first");
  writeFile(path("a.txt"), "second");
  EXPECT_EQ(readFile(path("a.txt")), "second");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path("")), {}), 1);
}

TEST_F(Files, WhatIsNotTheDataIsRefused) {
  EXPECT_EQ(codeOfReading("absent"), ErrorCode::kFileNotFound);
  std::filesystem::create_directories(path("folder"));
  EXPECT_EQ(codeOfReading("folder"), ErrorCode::kFileUnreadable);
  writeFile(path("empty"), "");
  EXPECT_EQ(codeOfReading("empty"), ErrorCode::kFileEmpty);
  writeFile(path("blank"), " \r\n\n");
  EXPECT_EQ(codeOfReading("blank"), ErrorCode::kFileEmpty);
  writeFile(path("pointer"), "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 1\n");
  EXPECT_EQ(codeOfReading("pointer"), ErrorCode::kFileNotTheData);
  writeFile(path("page"), "\n<!DOCTYPE html><html></html>");
  EXPECT_EQ(codeOfReading("page"), ErrorCode::kFileNotTheData);
  writeFile(path("large"), "0123456789");
  EXPECT_EQ(codeOfReading("large", 9), ErrorCode::kFileTooLarge);
}

TEST_F(Files, UnwritableTargetIsNamed) {
  writeFile(path("a"), "x");
  EXPECT_THROW(writeFile(path("a/b"), "x"), Error);
}

}  // namespace
}  // namespace gaitmill
