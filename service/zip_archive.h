#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "api/http.h"

namespace gaitmill {

/// One file of an archive. It is opened when its turn comes, so that only one is in memory.
struct ZipEntry {
  std::string name;  ///< with '/' between folders: "inputs/markers/walk1.trc"
  std::function<std::shared_ptr<const api::ByteSource>()> open;
};

/// A zip file of these entries in alphabetical order, and a last one, SHA256SUMS, that
/// `sha256sum -c` takes. Equal entries give equal bytes: there are no times, owners or comments of
/// this moment in it. Takes some 300 KiB of memory whatever the size.
/// @param folder  where the archive lies, nameless, as long as the answer lives
/// @throws Error kStorage if it cannot be written
std::shared_ptr<const api::ByteSource> makeZip(std::vector<ZipEntry> entries,
                                               const std::string& folder);

/// A client's file name as the last part of a path in an archive: letters, digits, '.', '_' and '-'
/// stay, everything else becomes '_'; never empty, never only dots.
std::string makeArchiveName(const std::string& file_name);

}  // namespace gaitmill
