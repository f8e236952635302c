#include "api/dto/timestamp.h"

#include <array>
#include <cctype>
#include <ctime>
#include <string_view>

namespace gaitmill::api {

namespace {

constexpr std::int64_t kSecondsPerHour = 3600;
constexpr std::int64_t kSecondsPerMinute = 60;

bool isDigit(char letter) {
  return std::isdigit(static_cast<unsigned char>(letter)) != 0;
}

// Takes `count` digits off the front of `rest`; -1 if they are not there.
int takeNumber(std::string_view& rest, std::size_t count) {
  if (rest.size() < count) {
    return -1;
  }
  int number = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!isDigit(rest[i])) {
      return -1;
    }
    number = 10 * number + (rest[i] - '0');
  }
  rest.remove_prefix(count);
  return number;
}

bool takeOneOf(std::string_view& rest, std::string_view letters) {
  if (rest.empty() || letters.find(rest.front()) == std::string_view::npos) {
    return false;
  }
  rest.remove_prefix(1);
  return true;
}

int countDays(int year, int month) {
  constexpr std::array<int, 12> kDays{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool is_leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  return kDays[static_cast<std::size_t>(month - 1)] + (month == 2 && is_leap ? 1 : 0);
}

// Seconds since 1970 of "YYYY-MM-DDTHH:MM:SS", which is taken off the front.
std::optional<std::int64_t> takeDateAndTime(std::string_view& rest) {
  const int year = takeNumber(rest, 4);
  const bool has_month = takeOneOf(rest, "-");
  const int month = takeNumber(rest, 2);
  const bool has_day = takeOneOf(rest, "-");
  const int day = takeNumber(rest, 2);
  const bool has_time = takeOneOf(rest, "Tt ");
  const int hour = takeNumber(rest, 2);
  const bool has_minute = takeOneOf(rest, ":");
  const int minute = takeNumber(rest, 2);
  const bool has_second = takeOneOf(rest, ":");
  const int second = takeNumber(rest, 2);
  const bool is_complete = has_month && has_day && has_time && has_minute && has_second;
  if (!is_complete || year < 1970 || month < 1 || month > 12 || day < 1 ||
      day > countDays(year, month) || hour < 0 || hour > 23 || minute < 0 || minute > 59 ||
      second < 0 || second > 60) {
    return std::nullopt;
  }
  std::tm utc{};
  utc.tm_year = year - 1900;
  utc.tm_mon = month - 1;
  utc.tm_mday = day;
  return static_cast<std::int64_t>(timegm(&utc)) + kSecondsPerHour * hour +
         kSecondsPerMinute * minute + second;
}

// Milliseconds of ".25", which may be absent.
std::optional<std::int64_t> takeFraction(std::string_view& rest) {
  if (!takeOneOf(rest, ".")) {
    return 0;
  }
  std::int64_t fraction = 0;
  std::int64_t weight = 100;
  if (rest.empty() || !isDigit(rest.front())) {
    return std::nullopt;
  }
  for (; !rest.empty() && isDigit(rest.front()); rest.remove_prefix(1)) {
    fraction += weight * (rest.front() - '0');
    weight /= 10;
  }
  return fraction;
}

// Seconds that the local time is ahead of UTC, of "Z" or "+01:00".
std::optional<std::int64_t> takeOffset(std::string_view& rest) {
  if (takeOneOf(rest, "Zz")) {
    return 0;
  }
  const bool is_behind = !rest.empty() && rest.front() == '-';
  const bool has_sign = takeOneOf(rest, "+- ");
  const int hours = takeNumber(rest, 2);
  const bool has_minutes = takeOneOf(rest, ":");
  const int minutes = takeNumber(rest, 2);
  if (!has_sign || !has_minutes || hours < 0 || hours > 23 || minutes < 0 || minutes > 59) {
    return std::nullopt;
  }
  return (is_behind ? -1 : 1) * (kSecondsPerHour * hours + kSecondsPerMinute * minutes);
}

}  // namespace

std::string formatTimestamp(std::int64_t milliseconds) {
  const auto seconds = static_cast<std::time_t>(milliseconds / 1000);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &utc);
  const std::string fraction = std::to_string(1000 + milliseconds % 1000);
  return std::string(text.data()) + "." + fraction.substr(1) + "Z";
}

std::optional<std::int64_t> parseTimestamp(const std::string& text) {
  std::string_view rest = text;
  const std::optional<std::int64_t> local = takeDateAndTime(rest);
  const std::optional<std::int64_t> fraction = local ? takeFraction(rest) : std::nullopt;
  const std::optional<std::int64_t> offset = fraction ? takeOffset(rest) : std::nullopt;
  if (!offset || !rest.empty() || *local < *offset) {
    return std::nullopt;
  }
  return 1000 * (*local - *offset) + *fraction;
}

}  // namespace gaitmill::api
