#pragma once

#include <string>

namespace gaitmill {

/// SHA-256 of the bytes as 64 lower-case hex digits.
std::string calcSha256(const std::string& bytes);

}  // namespace gaitmill
