#pragma once

#include <cstdint>
#include <string>

namespace gaitmill {

/// A new id such as "job_01hf3v6k9e2m8xw7p0q4t5r6s1": the prefix, then 48 bits of milliseconds
/// since 1970 and 80 random bits in base 32 without i, l, o and u, so that ids sort by time of
/// creation. Ids made by one process within one millisecond still ascend. Safe from any thread.
std::string makeId(const std::string& prefix);

/// Whether the text has the form of such an id.
bool isId(const std::string& text, const std::string& prefix);

/// When an id was made [ms since 1970 UTC]; 0 if it is none.
std::int64_t findTimeOfId(const std::string& id);

/// The smallest text that ids made at this time [ms since 1970 UTC] or later can have: lists are
/// narrowed by time through the ids themselves.
std::string makeIdBound(const std::string& prefix, std::int64_t milliseconds);

}  // namespace gaitmill
