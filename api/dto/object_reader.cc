#include "api/dto/object_reader.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/base/error.h"

namespace gaitmill::api {

namespace {

constexpr int kMaxNesting = 64;
constexpr std::size_t kMaxTextLength = 200;

// Line and column of the byte before which the parser stopped.
Where findPlace(const std::string& text, std::size_t byte, const std::string& what) {
  const std::size_t end = std::min(byte == 0 ? 0 : byte - 1, text.size());
  const auto stop = text.begin() + static_cast<std::ptrdiff_t>(end);
  const auto line = std::count(text.begin(), stop, '\n') + 1;
  const std::size_t line_start = end == 0 ? std::string::npos : text.rfind('\n', end - 1);
  const std::size_t column = line_start == std::string::npos ? end + 1 : end - line_start;
  return {what, static_cast<int>(line), static_cast<int>(column), ""};
}

// Line breaks and other control characters have no place in a name.
bool isPlain(const std::string& text) {
  return std::none_of(text.begin(), text.end(), [](unsigned char letter) {
    return letter < 0x20 || letter == 0x7f;
  });
}

std::string describeRange(const NumberRange& range) {
  return nlohmann::json(range.low).dump() + " to " + nlohmann::json(range.high).dump() + " " +
         range.unit;
}

}  // namespace

std::string toText(const nlohmann::json& value, const std::string& field) {
  gaitmill::require(value.is_string() && isName(value.get_ref<const std::string&>()),
                    ErrorCode::kRequestField,
                    "field '" + field + "' must be a text of 1 to " +
                        std::to_string(kMaxTextLength) + " bytes on one line",
                    {"", 0, 0, field});
  return value.get<std::string>();
}

bool isName(const std::string& text) {
  return !text.empty() && text.size() <= kMaxTextLength && isPlain(text);
}

nlohmann::json parseJson(const std::string& text, const std::string& what) {
  using Event = nlohmann::json::parse_event_t;
  const auto limit_nesting = [&](int depth, Event event, nlohmann::json&) {
    const bool opens = event == Event::array_start || event == Event::object_start;
    gaitmill::require(!opens || depth < kMaxNesting,
                      ErrorCode::kRequestMalformed,
                      "JSON is nested deeper than " + std::to_string(kMaxNesting) + " levels",
                      {what, 0, 0, ""});
    return true;
  };
  try {
    return nlohmann::json::parse(text, limit_nesting);
  } catch (const nlohmann::json::parse_error& error) {
    throw Error(ErrorCode::kRequestMalformed,
                "not valid JSON: the text breaks off or has an unexpected character here",
                findPlace(text, error.byte, what));
  } catch (const nlohmann::json::out_of_range&) {
    throw Error(
        ErrorCode::kRequestMalformed, "a number in the JSON is out of range", {what, 0, 0, ""});
  }
}

std::string dumpJson(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

ObjectReader::ObjectReader(const nlohmann::json& object, std::string name)
    : object_(object), name_(std::move(name)) {
  gaitmill::require(object.is_object(),
                    ErrorCode::kRequestField,
                    "expected a JSON object, found " + std::string(object.type_name()),
                    {"", 0, 0, name_});
}

const nlohmann::json& ObjectReader::require(const std::string& field) {
  const nlohmann::json* found = value(field);
  gaitmill::require(found != nullptr,
                    ErrorCode::kRequestField,
                    "field '" + field + "' is missing in '" + name_ + "'",
                    {"", 0, 0, name_ + "." + field});
  return *found;
}

double ObjectReader::number(const std::string& field, NumberRange range) {
  const nlohmann::json& found = require(field);
  const bool fits =
      found.is_number() && found.get<double>() >= range.low && found.get<double>() <= range.high;
  gaitmill::require(fits,
                    ErrorCode::kRequestField,
                    "field '" + field + "' must be a number from " + describeRange(range) +
                        ", found " + dumpJson(found).substr(0, kMaxTextLength),
                    {"", 0, 0, name_ + "." + field});
  return found.get<double>();
}

std::string ObjectReader::text(const std::string& field) {
  return toText(require(field), name_ + "." + field);
}

std::optional<std::string> ObjectReader::optionalText(const std::string& field) {
  if (value(field) == nullptr) {
    return std::nullopt;
  }
  return text(field);
}

const nlohmann::json* ObjectReader::value(const std::string& field) {
  known_.push_back(field);
  const auto found = object_.find(field);
  return found == object_.end() || found->is_null() ? nullptr : &*found;
}

void ObjectReader::finish() const {
  for (const auto& [field, unused] : object_.items()) {
    if (std::find(known_.begin(), known_.end(), field) != known_.end()) {
      continue;
    }
    const std::string nearest = findNearestName(field, known_);
    throw Error(ErrorCode::kRequestField,
                "'" + name_ + "' has no field '" + field.substr(0, kMaxTextLength) + "'" +
                    (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"),
                {"", 0, 0, name_ + "." + field.substr(0, kMaxTextLength)});
  }
}

}  // namespace gaitmill::api
