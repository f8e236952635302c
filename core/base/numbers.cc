#include "core/base/numbers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/base/text.h"

namespace gaitmill {

double roundSignificant(double value, int digits) {
  if (!std::isfinite(value)) {
    return value;
  }
  std::array<char, 40> text{};
  const auto end = std::to_chars(
      text.data(), text.data() + text.size(), value, std::chars_format::scientific, digits - 1);
  double rounded = value;
  std::from_chars(text.data(), end.ptr, rounded);
  return rounded;
}

std::string formatShort(double value) {
  if (value == 0 || !std::isfinite(value)) {
    return formatFixed(value, 0);
  }
  const double rounded = roundSignificant(value, 3);
  const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(rounded))));
  std::string text = formatFixed(rounded, std::max(0, 2 - magnitude));
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') {
      text.pop_back();
    }
  }
  return text;
}

}  // namespace gaitmill
