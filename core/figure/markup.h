#pragma once

#include <string>

namespace gaitmill {

/// The text with the five letters that mean something in XML and HTML written as entities. What a
/// document does not allow at all, such as control characters, is the caller's to take out.
std::string escapeMarkup(const std::string& text);

}  // namespace gaitmill
