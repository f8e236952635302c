#include "tests/service/zip_reader.h"

#include <archive.h>
#include <archive_entry.h>

#include <memory>

#include <gtest/gtest.h>

namespace gaitmill {

std::vector<std::pair<std::string, std::string>> readZip(const std::string& zip) {
  const std::unique_ptr<archive, int (*)(archive*)> reader(archive_read_new(), archive_read_free);
  archive_read_support_format_zip(reader.get());
  EXPECT_EQ(archive_read_open_memory(reader.get(), zip.data(), zip.size()), ARCHIVE_OK);
  std::vector<std::pair<std::string, std::string>> files;
  std::vector<char> piece(std::size_t{1} << 16U);
  archive_entry* entry = nullptr;
  while (archive_read_next_header(reader.get(), &entry) == ARCHIVE_OK) {
    files.emplace_back(archive_entry_pathname(entry), "");
    la_ssize_t count = 0;
    while ((count = archive_read_data(reader.get(), piece.data(), piece.size())) > 0) {
      files.back().second.append(piece.data(), static_cast<std::size_t>(count));
    }
    EXPECT_EQ(count, 0) << archive_error_string(reader.get());
  }
  return files;
}

}  // namespace gaitmill
