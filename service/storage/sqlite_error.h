#pragma once

#include <string>

struct sqlite3;

namespace gaitmill {

/// Throws what the last failed call on `handle` means: kStorageFull if there was no room on the
/// disk or under the size limit, else kStorage.
[[noreturn]] void throwSqliteError(sqlite3* handle, const std::string& step);

}  // namespace gaitmill
