#include "core/pipeline/settings_fields.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/pipeline/marker_names_json.h"

namespace gaitmill {

bool SettingsReader::isNull(const std::string& name) {
  return fields_.contains(name) && fields_.raw(name).is_null();
}

void SettingsReader::need(const std::string& name) {
  if (!fields_.has(name)) {
    throw Error(ErrorCode::kInputMissing,
                "the field is needed",
                {fields_.file(), 0, 0, fields_.pathOf(name)});
  }
}

std::size_t SettingsReader::findWord(const std::string& name,
                                     const std::vector<std::string>& words) {
  const std::string word = fields_.text(name);
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) {
    std::string known;
    for (const std::string& one : words) {
      known += (known.empty() ? "" : ", ") + one;
    }
    fields_.refuse(name, "found '" + word + "', expected one of " + known);
  }
  return static_cast<std::size_t>(found - words.begin());
}

void SettingsReader::text(const std::string& name, std::string& value) {
  value = fields_.text(name, value);
}

void SettingsReader::number(const std::string& name, Limits limits, double& value) {
  if (!fields_.has(name)) {
    return;
  }
  const double found = fields_.number(name);
  if (!(found >= limits.low && found <= limits.high)) {
    fields_.refuse(name,
                   "found " + std::to_string(found) + ", expected a number from " +
                       std::to_string(limits.low) + " to " + std::to_string(limits.high));
  }
  value = found;
}

void SettingsReader::number(const std::string& name, Limits limits, std::optional<double>& value) {
  if (isNull(name)) {
    value.reset();
  } else if (fields_.has(name)) {
    number(name, limits, value.emplace(limits.low));
  }
}

void SettingsReader::numberOrAuto(const std::string& name,
                                  Limits limits,
                                  std::optional<double>& value,
                                  bool& automatic) {
  if (fields_.has(name) && fields_.raw(name).is_string()) {
    findWord(name, {"auto"});
    automatic = true;
    return;
  }
  automatic = automatic && !fields_.contains(name);
  number(name, limits, value);
}

void SettingsReader::count(const std::string& name, Limits limits, int& value) {
  double found = value;
  number(name, limits, found);
  if (found != std::floor(found)) {
    fields_.refuse(name, "found " + std::to_string(found) + ", expected a whole number");
  }
  value = static_cast<int>(found);
}

void SettingsReader::flag(const std::string& name, bool& value) {
  value = fields_.flag(name, value);
}

void SettingsReader::point(const std::string& name, std::optional<Eigen::Vector3d>& value) {
  if (isNull(name)) {
    value.reset();
  } else if (fields_.has(name)) {
    value = fields_.vector3(name);
  }
}

void SettingsReader::range(const std::string& name, TimeRange& value) {
  std::optional<TimeRange> found = value;
  range(name, found);
  value = found.value_or(TimeRange{});
}

void SettingsReader::range(const std::string& name, std::optional<TimeRange>& value) {
  if (isNull(name)) {
    value.reset();
  }
  if (!fields_.has(name)) {
    return;
  }
  const std::vector<double> ends = fields_.numbers(name);
  if (ends.size() != 2 || !(ends[0] < ends[1])) {
    fields_.refuse(name, "expected two increasing times [start, end] in seconds");
  }
  value = TimeRange{ends[0], ends[1]};
}

void SettingsReader::values(const std::string& name, CoordinateValues& value) {
  if (!fields_.has(name)) {
    return;
  }
  value.clear();
  JsonFields entries = fields_.object(name);
  for (const std::string& coordinate : entries.names()) {
    const double found = entries.number(coordinate);
    if (!std::isfinite(found) || found < 0) {
      entries.refuse(coordinate, "expected a number >= 0");
    }
    value[coordinate] = found;
  }
}

void SettingsReader::stage(const std::string& name, Stage& value) {
  if (fields_.has(name)) {
    try {
      value = parseStage(fields_.text(name));
    } catch (const Error& error) {
      fields_.refuse(name, error.message());
    }
  }
}

void SettingsReader::stages(const std::string& name, std::vector<Stage>& value) {
  if (!fields_.has(name)) {
    return;
  }
  value.clear();
  for (const std::string& word : fields_.texts(name)) {
    try {
      value.push_back(parseStage(word));
    } catch (const Error& error) {
      fields_.refuse(name, error.message());
    }
  }
}

void SettingsReader::band(const std::string& name,
                          Limits limits,
                          std::optional<FrequencyBand>& value) {
  if (isNull(name)) {
    value.reset();
  }
  if (!fields_.has(name)) {
    return;
  }
  const std::vector<double> edges = fields_.numbers(name);
  if (edges.size() != 2 || !(edges[0] < edges[1]) || edges[0] < limits.low ||
      edges[1] > limits.high) {
    fields_.refuse(name,
                   "expected two increasing frequencies [low, high] from " +
                       std::to_string(limits.low) + " to " + std::to_string(limits.high));
  }
  value = FrequencyBand{edges[0], edges[1]};
}

void SettingsReader::lists(const std::string& name,
                           std::map<std::string, std::vector<std::string>>& value) {
  if (!fields_.has(name)) {
    return;
  }
  value.clear();
  JsonFields entries = fields_.object(name);
  for (const std::string& entry : entries.names()) {
    value[entry] = entries.texts(entry);
  }
}

void SettingsReader::landmarks(const std::string& name, MarkerOverrides& value) {
  if (fields_.has(name)) {
    value = readMarkerOverrides(fields_.object(name));
  }
}

void SettingsWriter::point(const std::string& name, const std::optional<Eigen::Vector3d>& value) {
  json_[name] = value ? Json{value->x(), value->y(), value->z()} : Json(nullptr);
}

void SettingsWriter::range(const std::string& name, const TimeRange& value) {
  range(name,
        std::isfinite(value.start) && std::isfinite(value.end) ? std::optional<TimeRange>(value)
                                                               : std::nullopt);
}

void SettingsWriter::range(const std::string& name, const std::optional<TimeRange>& value) {
  json_[name] = value ? Json{value->start, value->end} : Json(nullptr);
}

void SettingsWriter::values(const std::string& name, const CoordinateValues& value) {
  json_[name] = Json::object();
  for (const auto& [coordinate, number] : value) {
    json_[name][coordinate] = number;
  }
}

void SettingsWriter::band(const std::string& name,
                          Limits,
                          const std::optional<FrequencyBand>& value) {
  json_[name] = value ? Json{value->low, value->high} : Json(nullptr);
}

void SettingsWriter::lists(const std::string& name,
                           const std::map<std::string, std::vector<std::string>>& value) {
  json_[name] = Json::object();
  for (const auto& [entry, words] : value) {
    json_[name][entry] = words;
  }
}

void SettingsWriter::stages(const std::string& name, const std::vector<Stage>& value) {
  json_[name] = Json::array();
  for (const Stage stage : value) {
    json_[name].push_back(stageName(stage));
  }
}

void SettingsWriter::landmarks(const std::string& name, const MarkerOverrides& value) {
  json_[name] = Json::object();
  for (const auto& [measured, landmark] : value) {
    json_[name][measured] = landmark ? Json(*landmark) : Json(nullptr);
  }
}

}  // namespace gaitmill
