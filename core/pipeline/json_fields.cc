#include "core/pipeline/json_fields.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/base/error.h"

namespace gaitmill {

namespace {

using Json = nlohmann::json;

const Json& emptyObject() {
  static const Json empty = Json::object();
  return empty;
}

// Our documents have 5 levels; whatever walks through a document may recurse.
constexpr int kMaximumNesting = 64;

const Json& nullValue() {
  static const Json null;
  return null;
}

Where locate(const InputFile& file, std::size_t byte) {
  Where where{file.name, 1, 1, {}};
  const std::size_t end = std::min(byte > 0 ? byte - 1 : 0, file.bytes.size());
  for (std::size_t i = 0; i < end; ++i) {
    where.column = file.bytes[i] == '\n' ? 1 : where.column + 1;
    where.line += file.bytes[i] == '\n' ? 1 : 0;
  }
  return where;
}

}  // namespace

Json parseJson(const InputFile& file) {
  const auto limitNesting = [&](int depth, Json::parse_event_t event, Json&) {
    const bool opens =
        event == Json::parse_event_t::array_start || event == Json::parse_event_t::object_start;
    require(!opens || depth < kMaximumNesting,
            ErrorCode::kSettingsJson,
            "not a settings document: nested deeper than " + std::to_string(kMaximumNesting) +
                " levels",
            {file.name, 1, 1, {}});
    return true;
  };
  try {
    return Json::parse(file.bytes, limitNesting);
  } catch (const Json::parse_error& fault) {
    std::string message = fault.what();
    // "[json.exception.parse_error.101] parse error at line 1, column 2: ...": keep the last part.
    const std::size_t colon = message.find(": ");
    message = colon == std::string::npos ? message : message.substr(colon + 2);
    throw Error(
        ErrorCode::kSettingsJson, "not a JSON document: " + message, locate(file, fault.byte));
  } catch (const Json::out_of_range&) {
    throw Error(
        ErrorCode::kSettingsJson, "a number is too large for a double", {file.name, 0, 0, {}});
  }
}

JsonFields::JsonFields(const Json& value, std::string path, std::string file)
    : value_(&value), path_(std::move(path)), file_(std::move(file)) {
  require(value.is_object(),
          ErrorCode::kSettingsValue,
          std::string("expected an object, found ") + value.type_name(),
          {file_, 0, 0, path_});
}

std::string JsonFields::pathOf(const std::string& name) const {
  return path_.empty() ? name : path_ + "." + name;
}

void JsonFields::refuse(const std::string& name, const std::string& message) const {
  throw Error(ErrorCode::kSettingsValue, message, {file_, 0, 0, pathOf(name)});
}

const Json& JsonFields::raw(const std::string& name) {
  known_.push_back(name);
  const auto found = value_->find(name);
  return found == value_->end() ? nullValue() : *found;
}

bool JsonFields::has(const std::string& name) {
  return !raw(name).is_null();
}

bool JsonFields::contains(const std::string& name) {
  known_.push_back(name);
  return value_->contains(name);
}

const Json& JsonFields::need(const std::string& name) {
  const Json& value = raw(name);
  require(!value.is_null(),
          ErrorCode::kInputMissing,
          "the field is needed",
          {file_, 0, 0, pathOf(name)});
  return value;
}

double JsonFields::number(const std::string& name) {
  const Json& value = need(name);
  if (!value.is_number()) {
    refuse(name, std::string("expected a number, found ") + value.type_name());
  }
  return value.get<double>();
}

double JsonFields::number(const std::string& name, double absent) {
  return has(name) ? number(name) : absent;
}

bool JsonFields::flag(const std::string& name, bool absent) {
  const Json& value = raw(name);
  if (value.is_null()) {
    return absent;
  }
  if (!value.is_boolean()) {
    refuse(name, std::string("expected true or false, found ") + value.type_name());
  }
  return value.get<bool>();
}

std::string JsonFields::text(const std::string& name) {
  const Json& value = need(name);
  if (!value.is_string()) {
    refuse(name, std::string("expected a string, found ") + value.type_name());
  }
  return value.get<std::string>();
}

std::string JsonFields::text(const std::string& name, const std::string& absent) {
  return has(name) ? text(name) : absent;
}

std::vector<double> JsonFields::numbers(const std::string& name) {
  const Json& value = need(name);
  const auto is_number = [](const Json& entry) {
    return entry.is_number();
  };
  if (!value.is_array() || !std::all_of(value.begin(), value.end(), is_number)) {
    refuse(name, "expected a list of numbers");
  }
  return value.get<std::vector<double>>();
}

std::vector<std::string> JsonFields::texts(const std::string& name) {
  const Json& value = need(name);
  const auto is_text = [](const Json& entry) {
    return entry.is_string();
  };
  if (!value.is_array() || !std::all_of(value.begin(), value.end(), is_text)) {
    refuse(name, "expected a list of strings");
  }
  return value.get<std::vector<std::string>>();
}

Eigen::Vector3d JsonFields::vector3(const std::string& name) {
  const std::vector<double> values = numbers(name);
  if (values.size() != 3) {
    refuse(name, "expected 3 numbers, found " + std::to_string(values.size()));
  }
  return {values[0], values[1], values[2]};
}

JsonFields JsonFields::object(const std::string& name) {
  const Json& value = raw(name);
  return {value.is_null() ? emptyObject() : value, pathOf(name), file_};
}

std::vector<JsonFields> JsonFields::objects(const std::string& name) {
  std::vector<JsonFields> list;
  const Json& value = raw(name);
  if (value.is_null()) {
    return list;
  }
  if (!value.is_array()) {
    refuse(name, std::string("expected a list, found ") + value.type_name());
  }
  for (std::size_t i = 0; i < value.size(); ++i) {
    list.emplace_back(value[i], pathOf(name) + "[" + std::to_string(i) + "]", file_);
  }
  return list;
}

std::vector<std::string> JsonFields::names() const {
  std::vector<std::string> list;
  for (const auto& item : value_->items()) {
    list.push_back(item.key());
  }
  return list;
}

void JsonFields::finish() const {
  for (const std::string& name : names()) {
    if (std::find(known_.begin(), known_.end(), name) != known_.end()) {
      continue;
    }
    const std::string nearest = findNearestName(name, known_);
    throw Error(ErrorCode::kSettingsUnknownField,
                "unknown field '" + name + "'" +
                    (nearest.empty() ? "" : ", did you mean '" + nearest + "'?"),
                {file_, 0, 0, pathOf(name)});
  }
}

}  // namespace gaitmill
