#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace gaitmill {

/// Told after each piece: pages copied so far, and pages in all.
using BackupProgress = std::function<void(std::int64_t done, std::int64_t all)>;

/// Copies a database, in use or not, as it stands at one instant: everything acknowledged before
/// the call is in the copy. Writers go on meanwhile. The copy appears under `target` when it is
/// complete, checked and synced, never before; a file of that name is replaced.
/// @throws Error kStorage, kStorageFull, kStorageVersion
void backUpDatabase(const std::string& path,
                    const std::string& target,
                    const BackupProgress& progress = {});

enum class Existing { kKeep, kReplace };

/// Puts a backup in the place of a database, after checking its integrity and that this gaitmill
/// knows its version.
/// @throws Error kStorageInUse if a process uses the database, or if there is one and `existing`
///         says to keep it; kStorageVersion; kStorage; kStorageFull
void restoreDatabase(const std::string& backup, const std::string& path, Existing existing);

}  // namespace gaitmill
