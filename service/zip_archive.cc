#include "service/zip_archive.h"

#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <utility>

#include "core/base/error.h"
#include "service/storage/sha256.h"
#include "service/unlinked_file.h"

namespace gaitmill {

namespace {

constexpr std::size_t kPiece = std::size_t{256} << 10;  // [bytes] read at a time
// The archive of the sample, 39 MB of numbers: 1.5 s instead of 6.7 s of level 6, 7 % more bytes.
constexpr const char* kLevel = "1";
constexpr int kFileMode = 0644;
constexpr std::time_t kFileTime = 315'532'800;  // [s] 1980-01-01 UTC, the first that zip can say

using ArchivePointer = std::unique_ptr<archive, int (*)(archive*)>;
using EntryPointer = std::unique_ptr<archive_entry, void (*)(archive_entry*)>;

void requireOk(archive* zip, la_int64_t result) {
  if (result < ARCHIVE_OK) {
    const bool is_full = archive_errno(zip) == ENOSPC;
    const char* reason = archive_error_string(zip);
    throw Error(is_full ? ErrorCode::kStorageFull : ErrorCode::kStorage,
                std::string("an archive cannot be written: ") + (reason ? reason : "unknown"),
                {"results.zip"});
  }
}

ArchivePointer openZip(int descriptor) {
  ArchivePointer zip(archive_write_new(), archive_write_free);
  check(zip != nullptr, "no memory for an archive");
  requireOk(zip.get(), archive_write_set_format_zip(zip.get()));
  requireOk(zip.get(),
            archive_write_set_format_option(zip.get(), "zip", "compression-level", kLevel));
  requireOk(zip.get(), archive_write_set_bytes_in_last_block(zip.get(), 1));
  requireOk(zip.get(), archive_write_open_fd(zip.get(), descriptor));
  return zip;
}

void beginEntry(archive* zip, const std::string& name, std::uint64_t size) {
  const EntryPointer entry(archive_entry_new(), archive_entry_free);
  archive_entry_set_pathname(entry.get(), name.c_str());
  archive_entry_set_size(entry.get(), static_cast<la_int64_t>(size));
  archive_entry_set_filetype(entry.get(), AE_IFREG);
  archive_entry_set_perm(entry.get(), kFileMode);
  archive_entry_set_mtime(entry.get(), kFileTime, 0);
  requireOk(zip, archive_write_header(zip, entry.get()));
}

// @returns the hash of what was written
std::string writeEntry(archive* zip, const std::string& name, const api::ByteSource& bytes) {
  const std::uint64_t size = bytes.size();
  beginEntry(zip, name, size);
  Sha256 hash;
  for (std::uint64_t offset = 0; offset < size;) {
    const std::string piece = bytes.read(offset, kPiece);
    check(!piece.empty(), "a file of an archive ends early");
    hash.update(piece);
    requireOk(zip, archive_write_data(zip, piece.data(), piece.size()));
    offset += piece.size();
  }
  return hash.finish();
}

}  // namespace

std::shared_ptr<const api::ByteSource> makeZip(std::vector<ZipEntry> entries,
                                               const std::string& folder) {
  std::sort(entries.begin(), entries.end(), [](const ZipEntry& a, const ZipEntry& b) {
    return a.name < b.name;
  });
  auto file = std::make_shared<UnlinkedFile>(folder);
  const ArchivePointer zip = openZip(file->descriptor());
  std::string sums;
  for (const ZipEntry& entry : entries) {
    sums += writeEntry(zip.get(), entry.name, *entry.open()) + "  " + entry.name + "\n";
  }
  writeEntry(zip.get(), "SHA256SUMS", *api::makeByteSource(sums));
  requireOk(zip.get(), archive_write_close(zip.get()));
  return file;
}

std::string makeArchiveName(const std::string& file_name) {
  constexpr std::size_t kLongest = 100;
  std::string name;
  for (const char letter : file_name.substr(0, kLongest)) {
    const bool is_plain = (std::isalnum(static_cast<unsigned char>(letter)) != 0) ||
                          letter == '.' || letter == '_' || letter == '-';
    name += is_plain ? letter : '_';
  }
  const bool is_only_dots = name.find_first_not_of('.') == std::string::npos;
  return is_only_dots ? "file" : name;
}

}  // namespace gaitmill
