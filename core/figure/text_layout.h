#pragma once

#include <string>
#include <vector>

namespace gaitmill {

/// About how wide a text is in a sans-serif font of this size [px].
double estimateTextWidth(const std::string& text, double size);

/// Text broken between words into lines that fit.
std::vector<std::string> wrapText(const std::string& text, double size, double width);

}  // namespace gaitmill
