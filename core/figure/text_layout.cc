#include "core/figure/text_layout.h"

#include <sstream>

namespace gaitmill {

double estimateTextWidth(const std::string& text, double size) {
  constexpr double kMeanWidth = 0.55;  // of a letter, in font sizes: Helvetica, Arial, DejaVu Sans
  std::size_t letters = 0;
  for (const char byte : text) {
    letters += (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U ? 1 : 0;
  }
  return kMeanWidth * size * static_cast<double>(letters);
}

std::vector<std::string> wrapText(const std::string& text, double size, double width) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  std::string word;
  while (words >> word) {
    const bool fits = !lines.empty() && estimateTextWidth(lines.back() + " " + word, size) <= width;
    if (fits) {
      lines.back() += " " + word;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

}  // namespace gaitmill
