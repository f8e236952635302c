#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "core/data/marker_set.h"
#include "core/pipeline/json_fields.h"
#include "core/pipeline/settings.h"

namespace gaitmill {

// A settings document is read and written by one list of its fields: functions of the form
//   template <class Fields>
//   void visitIk(Fields& fields, PipelineSettings& settings)
// that name every field once, with its limits and the value that it stands for. Two classes serve
// as Fields: SettingsReader sets the values that a document holds and leaves the others at their
// defaults; SettingsWriter writes them all.

/// A number with its limits, inclusive.
struct Limits {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

/// Words and what they stand for.
template <class Enum>
using Choices = std::vector<std::pair<const char*, Enum>>;

/// Fields that are absent, or null where a value must be, keep what they have; null empties what
/// may be empty. Every function throws Error kSettingsValue naming the field if it does not fit.
class SettingsReader {
 public:
  explicit SettingsReader(JsonFields fields) : fields_(std::move(fields)) {}

  void text(const std::string& name, std::string& value);
  void number(const std::string& name, Limits limits, double& value);
  void number(const std::string& name, Limits limits, std::optional<double>& value);
  /// A number, null for none, or the word "auto".
  void numberOrAuto(const std::string& name,
                    Limits limits,
                    std::optional<double>& value,
                    bool& automatic);
  void count(const std::string& name, Limits limits, int& value);
  void flag(const std::string& name, bool& value);
  void point(const std::string& name, std::optional<Eigen::Vector3d>& value);
  /// Two increasing times; null = all there is.
  void range(const std::string& name, TimeRange& value);
  void range(const std::string& name, std::optional<TimeRange>& value);
  /// Numbers >= 0 by coordinate.
  void values(const std::string& name, CoordinateValues& value);
  void stage(const std::string& name, Stage& value);
  void stages(const std::string& name, std::vector<Stage>& value);
  /// Two increasing frequencies [low, high].
  void band(const std::string& name, Limits limits, std::optional<FrequencyBand>& value);
  /// Lists of words by name.
  void lists(const std::string& name, std::map<std::string, std::vector<std::string>>& value);
  /// Landmarks by measured marker. @throws also Error kMarkerNames
  void landmarks(const std::string& name, MarkerOverrides& value);

  template <class Enum>
  void choice(const std::string& name, const Choices<Enum>& choices, Enum& value) {
    if (fields_.has(name)) {
      std::vector<std::string> words;
      for (const auto& [word, meaning] : choices) {
        words.emplace_back(word);
      }
      value = choices[findWord(name, words)].second;
    }
  }
  template <class Enum>
  void choice(const std::string& name, const Choices<Enum>& choices, std::optional<Enum>& value) {
    if (isNull(name)) {
      value.reset();
    } else if (fields_.has(name)) {
      choice(name, choices, value.emplace());
    }
  }

  template <class Visit>
  void object(const std::string& name, const Visit& visit) {
    SettingsReader inner(fields_.object(name));
    visit(inner);
    inner.fields_.finish();
  }
  template <class Value, class Visit>
  void object(const std::string& name, std::optional<Value>& value, const Visit& visit) {
    if (isNull(name)) {
      value.reset();
    } else if (fields_.has(name)) {
      value = value.value_or(Value{});
      object(name, [&](SettingsReader& inner) { visit(inner, *value); });
    }
  }
  /// A list replaces the whole list.
  template <class Value, class Visit>
  void list(const std::string& name, std::vector<Value>& value, const Visit& visit) {
    if (!fields_.has(name)) {
      return;
    }
    value.clear();
    for (JsonFields& entry : fields_.objects(name)) {
      SettingsReader inner(std::move(entry));
      visit(inner, value.emplace_back());
      inner.fields_.finish();
    }
  }

  /// Whether the document has a value there.
  bool isGiven(const std::string& name) { return fields_.has(name); }
  /// @throws Error kInputMissing if a field that has no default is absent
  void need(const std::string& name);
  [[noreturn]] void refuse(const std::string& name, const std::string& message) {
    fields_.refuse(name, message);
  }
  /// @throws Error kSettingsUnknownField
  void finish() { fields_.finish(); }

 private:
  bool isNull(const std::string& name);
  std::size_t findWord(const std::string& name, const std::vector<std::string>& words);

  JsonFields fields_;
};

class SettingsWriter {
 public:
  using Json = nlohmann::ordered_json;

  void text(const std::string& name, const std::string& value) { json_[name] = value; }
  void number(const std::string& name, Limits, double value) { json_[name] = value; }
  void number(const std::string& name, Limits, const std::optional<double>& value) {
    json_[name] = value ? Json(*value) : Json(nullptr);
  }
  void numberOrAuto(const std::string& name,
                    Limits limits,
                    const std::optional<double>& value,
                    bool automatic) {
    number(name, limits, value);
    if (automatic) {
      json_[name] = "auto";
    }
  }
  void count(const std::string& name, Limits, int value) { json_[name] = value; }
  void flag(const std::string& name, bool value) { json_[name] = value; }
  void point(const std::string& name, const std::optional<Eigen::Vector3d>& value);
  void range(const std::string& name, const TimeRange& value);
  void range(const std::string& name, const std::optional<TimeRange>& value);
  void values(const std::string& name, const CoordinateValues& value);
  void stage(const std::string& name, Stage value) { json_[name] = stageName(value); }
  void stages(const std::string& name, const std::vector<Stage>& value);
  void band(const std::string& name, Limits, const std::optional<FrequencyBand>& value);
  void lists(const std::string& name, const std::map<std::string, std::vector<std::string>>& value);
  void landmarks(const std::string& name, const MarkerOverrides& value);

  template <class Enum>
  void choice(const std::string& name, const Choices<Enum>& choices, const Enum& value) {
    for (const auto& [word, meaning] : choices) {
      if (meaning == value) {
        json_[name] = word;
      }
    }
  }
  template <class Enum>
  void choice(const std::string& name,
              const Choices<Enum>& choices,
              const std::optional<Enum>& value) {
    json_[name] = nullptr;
    if (value) {
      choice(name, choices, *value);
    }
  }

  template <class Visit>
  void object(const std::string& name, const Visit& visit) {
    SettingsWriter inner;
    visit(inner);
    json_[name] = std::move(inner.json_);
  }
  template <class Value, class Visit>
  void object(const std::string& name, std::optional<Value>& value, const Visit& visit) {
    json_[name] = nullptr;
    if (value) {
      object(name, [&](SettingsWriter& inner) { visit(inner, *value); });
    }
  }
  template <class Value, class Visit>
  void list(const std::string& name, std::vector<Value>& value, const Visit& visit) {
    json_[name] = Json::array();
    for (Value& entry : value) {
      SettingsWriter inner;
      visit(inner, entry);
      json_[name].push_back(std::move(inner.json_));
    }
  }

  bool isGiven(const std::string&) const { return false; }
  void need(const std::string&) const {}
  void refuse(const std::string&, const std::string&) const {}

  const Json& json() const { return json_; }

 private:
  Json json_ = Json::object();
};

}  // namespace gaitmill
