#include "api/dto/image.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <system_error>

#include "api/dto/csv.h"
#include "core/base/error.h"

namespace gaitmill::api {

namespace {

using Names = std::vector<std::string>;

[[noreturn]] void refuse(const std::string& name, const std::string& expected) {
  throw Error(
      ErrorCode::kRequestField, "parameter '" + name + "' must be " + expected, {"", 0, 0, name});
}

std::string writeNumber(double value) {
  std::string text;
  appendNumber(text, value);
  return text;
}

// A number of plain digits with its range; texts such as "nan" and "1e999" are no numbers here.
std::optional<double> parseNumber(const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  const bool is_number = parsed.ec == std::errc() && parsed.ptr == end && std::isfinite(value);
  return is_number ? std::optional<double>(value) : std::nullopt;
}

struct Span {
  double low;
  double high;
  const char* unit;  ///< with a leading blank, or empty
};

// Any recording is within this of its clock's zero. [s]
constexpr double kMaxTime = 1e6;
constexpr Span kTime{-kMaxTime, kMaxTime, " s"};
constexpr Span kPercent{0, 100, " percent"};
constexpr Span kPixels{16, 4096, " pixels"};
constexpr Span kPoses{1, 24, ""};
constexpr Span kRate{1, 60, " frames per second"};
constexpr Span kSlowDown{0.1, 100, ""};

// Reads parameters one after the other.
class Reader {
 public:
  explicit Reader(const Query& query) : query_(query) {}

  void number(const char* name, const Span& span, std::optional<double>& value) const {
    const std::optional<std::string> text = query_(name);
    if (!text) {
      return;
    }
    value = parseNumber(*text);
    if (!value || *value < span.low || *value > span.high) {
      refuse(name, "a number from " + describe(span));
    }
  }
  void number(const char* name, const Span& span, double& value) const {
    std::optional<double> given;
    number(name, span, given);
    value = given.value_or(value);
  }
  void count(const char* name, const Span& span, int& value) const {
    std::optional<double> given;
    number(name, span, given);
    if (given && *given != std::floor(*given)) {
      refuse(name, "a whole number from " + describe(span));
    }
    value = given ? static_cast<int>(*given) : value;
  }
  void flag(const char* name, bool& value) const {
    const std::optional<std::string> text = query_(name);
    if (!text) {
      return;
    }
    const bool is_on = *text == "true" || *text == "1" || *text == "on";
    if (!is_on && *text != "false" && *text != "0" && *text != "off") {
      refuse(name, "true or false");
    }
    value = is_on;
  }
  void word(const char* name, const Names& words, std::string& value) const {
    const std::optional<std::string> text = query_(name);
    if (!text) {
      return;
    }
    if (std::find(words.begin(), words.end(), *text) == words.end()) {
      std::string list;
      for (const std::string& word : words) {
        list.append(list.empty() ? "" : ", ").append(word);
      }
      const std::string nearest = findNearestName(*text, words);
      refuse(name, "one of " + list + (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
    }
    value = *text;
  }
  void text(const char* name, std::string& value) const { value = query_(name).value_or(value); }

 private:
  static std::string describe(const Span& span) {
    return writeNumber(span.low) + " to " + writeNumber(span.high) + span.unit;
  }

  const Query& query_;
};

void readPose(const Reader& read, ImageRequest& request) {
  read.number("time", kTime, request.time);
  read.number("percent", kPercent, request.percent);
  if (request.time && request.percent) {
    refuse("percent", "left out where there is a time");
  }
}

void readSpan(const Reader& read, ImageRequest& request) {
  read.number("start", kTime, request.start);
  read.number("end", kTime, request.end);
  if (request.start && request.end && *request.end <= *request.start) {
    refuse("end", "later than the start");
  }
}

}  // namespace

const std::vector<std::string>& imageColors() {
  static const Names colors = {"activation", "force", "fiber_length", "none"};
  return colors;
}

std::vector<std::string> imageParameters(ImageKind kind) {
  Names names = {"width",
                 "height",
                 "view",
                 "color",
                 "bones",
                 "muscles",
                 "markers",
                 "forces",
                 "ground",
                 "legend"};
  const Names own = kind == ImageKind::kPose    ? Names{"time", "percent"}
                    : kind == ImageKind::kStrip ? Names{"start", "end", "poses"}
                                                : Names{"start", "end", "rate", "slow_down"};
  names.insert(names.end(), own.begin(), own.end());
  return names;
}

ImageRequest parseImageRequest(ImageKind kind, const Query& query) {
  const Reader read(query);
  ImageRequest request;
  request.kind = kind;
  if (kind == ImageKind::kPose) {
    readPose(read, request);
  } else {
    // Poses of a strip stand beside each other, frames of an animation add up.
    request.width = kind == ImageKind::kStrip ? 320 : 640;
    request.height = kind == ImageKind::kStrip ? 480 : 360;
    readSpan(read, request);
  }
  read.count("poses", kPoses, request.poses);
  read.number("rate", kRate, request.rate);
  read.number("slow_down", kSlowDown, request.slow_down);
  read.count("width", kPixels, request.width);
  read.count("height", kPixels, request.height);
  read.text("view", request.view);
  read.word("color", imageColors(), request.color);
  read.flag("bones", request.bones);
  read.flag("muscles", request.muscles);
  read.flag("markers", request.markers);
  read.flag("forces", request.forces);
  read.flag("ground", request.ground);
  read.flag("legend", request.legend);
  return request;
}

std::string describeImage(const ImageRequest& request) {
  std::string text = std::to_string(static_cast<int>(request.kind));
  const auto add = [&text](const char* name, const std::string& value) {
    text.append(";").append(name).append("=").append(value);
  };
  const auto addTime = [&](const char* name, const std::optional<double>& value) {
    add(name, value ? writeNumber(*value) : "");
  };
  addTime("time", request.time);
  addTime("percent", request.percent);
  addTime("start", request.start);
  addTime("end", request.end);
  add("poses", std::to_string(request.poses));
  add("rate", writeNumber(request.rate));
  add("slow_down", writeNumber(request.slow_down));
  add("width", std::to_string(request.width));
  add("height", std::to_string(request.height));
  add("view", request.view);
  add("color", request.color);
  for (const bool flag : {request.bones,
                          request.muscles,
                          request.markers,
                          request.forces,
                          request.ground,
                          request.legend}) {
    text += flag ? '1' : '0';
  }
  return text;
}

}  // namespace gaitmill::api
