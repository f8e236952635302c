#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gaitmill {

/// A whole token as a number, independent of locale: decimal or exponent form with an optional
/// sign, "nan", "inf" and "infinity" in any case and sign, and the old C runtime's "1.#QNAN",
/// "1.#IND", "1.#INF". Nullopt if anything else stands in the token, or if the token is empty.
std::optional<double> parseNumber(std::string_view token);

/// A whole token as an integer, or nullopt.
std::optional<long> parseInteger(std::string_view token);

/// true/false in any case (and 1/0, yes/no, as table headers write), or nullopt.
std::optional<bool> parseBoolean(std::string_view token);

/// The shortest text that reads back as the same double; "NaN", "Inf", "-Inf" for the rest.
std::string formatNumber(double value);

/// Appends formatNumber(value) without a temporary string.
void appendNumber(std::string& text, double value);

/// `text` without blanks, tabs and line ends at either side.
std::string_view trim(std::string_view text);

/// Same letters, upper and lower case alike (ASCII).
bool equalsIgnoringCase(std::string_view a, std::string_view b);

}  // namespace gaitmill
