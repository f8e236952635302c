#include "core/io/number_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace gaitmill {

namespace {

char toLower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

// What the Microsoft C runtime printed for non-numbers before 2015.
std::optional<double> parseOldRuntimeToken(std::string_view token) {
  if (!token.empty() && token.front() == '-') {
    const std::optional<double> value = parseOldRuntimeToken(token.substr(1));
    return value ? std::optional<double>(-*value) : std::nullopt;
  }
  if (equalsIgnoringCase(token.substr(0, 5), "1.#QN") ||
      equalsIgnoringCase(token.substr(0, 5), "1.#IN") ||
      equalsIgnoringCase(token.substr(0, 5), "1.#SN")) {
    return equalsIgnoringCase(token.substr(0, 6), "1.#INF")
               ? std::numeric_limits<double>::infinity()
               : std::numeric_limits<double>::quiet_NaN();
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> parseNumber(std::string_view token) {
  if (!token.empty() && token.front() == '+') {
    token.remove_prefix(1);
    if (!token.empty() && (token.front() == '-' || token.front() == '+')) {
      return std::nullopt;
    }
  }
  double value = 0;
  const char* end = token.data() + token.size();
  const auto [stop, status] = std::from_chars(token.data(), end, value);
  if (stop == end && status == std::errc()) {
    return value;
  }
  if (stop == end && status == std::errc::result_out_of_range) {
    // Underflow is zero for our purposes; overflow is not a measurement.
    const std::size_t exponent = token.find_first_of("eE");
    const bool tiny = exponent != std::string_view::npos && exponent + 1 < token.size() &&
                      token[exponent + 1] == '-';
    return tiny ? std::optional<double>(0.0) : std::nullopt;
  }
  return parseOldRuntimeToken(token);
}

std::optional<long> parseInteger(std::string_view token) {
  if (!token.empty() && token.front() == '+') {
    token.remove_prefix(1);
  }
  long value = 0;
  const char* end = token.data() + token.size();
  const auto [stop, status] = std::from_chars(token.data(), end, value);
  return stop == end && status == std::errc() ? std::optional<long>(value) : std::nullopt;
}

std::optional<bool> parseBoolean(std::string_view token) {
  if (token == "1" || equalsIgnoringCase(token, "true") || equalsIgnoringCase(token, "yes")) {
    return true;
  }
  if (token == "0" || equalsIgnoringCase(token, "false") || equalsIgnoringCase(token, "no")) {
    return false;
  }
  return std::nullopt;
}

void appendNumber(std::string& text, double value) {
  if (std::isnan(value)) {
    text += "NaN";
    return;
  }
  if (std::isinf(value)) {
    text += value > 0 ? "Inf" : "-Inf";
    return;
  }
  std::array<char, 32> buffer = {};
  const auto written = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  text.append(buffer.data(), written.ptr);
}

std::string formatNumber(double value) {
  std::string text;
  appendNumber(text, value);
  return text;
}

std::string_view trim(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n\v\f";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) {
    return text.substr(0, 0);
  }
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

bool equalsIgnoringCase(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) {
           return toLower(x) == toLower(y);
         });
}

}  // namespace gaitmill
