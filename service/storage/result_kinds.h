#pragma once

#include <string_view>

#include "service/storage/job_store.h"

namespace gaitmill {

/// "file", "time", "cycle", "summary", as they stand in the database.
const char* resultKindName(ResultKind kind);
/// @throws Error kStorage for another word
ResultKind findResultKind(std::string_view name);

}  // namespace gaitmill
