#include "api/dto/csv.h"

#include <array>
#include <charconv>

namespace gaitmill::api {

void appendNumber(std::string& out, double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  out.append(digits.data(), end.ptr);
}

std::string quoteCsv(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char letter : text) {
    quoted += letter;
    if (letter == '"') {
      quoted += '"';
    }
  }
  return quoted + "\"";
}

std::string quoteUserCsv(const std::string& text) {
  const bool is_formula = text.find_first_of("=+-@\t") == 0;
  return quoteCsv(is_formula ? "'" + text : text);
}

}  // namespace gaitmill::api
