#pragma once

#include <string>
#include <vector>

namespace gaitmill {

/// One #include that points the wrong way.
struct IncludeViolation {
  std::string file;     ///< relative to the top: "core/ik/ik_solver.cc"
  std::string include;  ///< as written: "core/id/id_solver.h"
  std::string rule;     ///< the sentence that it breaks
};

/// Room of a path relative to the top: "core/ik", "service/storage", "api"; "" outside the rooms.
std::string findRoom(const std::string& path);

/// Headers that a source text includes, in order, without quotes or brackets. Directives inside
/// comments count too: the test would rather be strict.
std::vector<std::string> findIncludes(const std::string& source);

/// Checks the includes of one file against the include table.
/// @param file  relative to the top; it decides the room and whether it is a header
std::vector<IncludeViolation> checkIncludes(const std::string& file,
                                            const std::vector<std::string>& includes);

}  // namespace gaitmill
