#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "core/pipeline/pipeline.h"

namespace gaitmill {

/// Parses a JSON document. @throws Error kSettingsJson with file, line and column
nlohmann::json parseJson(const InputFile& file);

/// Reads one JSON object field by field. Remembers where it is for messages ("scale.manual[2].
/// factors") and which fields were asked for, so that finish() can name those nobody knows. Keeps
/// references to the document and to nothing else.
///
/// Every getter throws Error kSettingsValue naming the field when its type or value does not fit,
/// and kInputMissing when a field without default is absent.
class JsonFields {
 public:
  JsonFields(const nlohmann::json& value, std::string path, std::string file);

  /// Present and not null.
  bool has(const std::string& name);
  /// Present, be it null.
  bool contains(const std::string& name);

  double number(const std::string& name);
  double number(const std::string& name, double absent);
  bool flag(const std::string& name, bool absent);
  std::string text(const std::string& name);
  std::string text(const std::string& name, const std::string& absent);
  std::vector<double> numbers(const std::string& name);
  std::vector<std::string> texts(const std::string& name);
  Eigen::Vector3d vector3(const std::string& name);

  /// Object, or list of objects; an absent list is empty, an absent object has no fields.
  JsonFields object(const std::string& name);
  std::vector<JsonFields> objects(const std::string& name);
  /// The value as it is, for shapes of their own. Null if absent.
  const nlohmann::json& raw(const std::string& name);

  /// All names present, in document order.
  std::vector<std::string> names() const;
  /// Path of one field, for messages: "scale.manual[2].factors".
  std::string pathOf(const std::string& name) const;
  const std::string& file() const { return file_; }
  /// Throws Error kSettingsValue about one field.
  [[noreturn]] void refuse(const std::string& name, const std::string& message) const;

  /// @throws Error kSettingsUnknownField if a field was present that nobody asked for
  void finish() const;

 private:
  const nlohmann::json& need(const std::string& name);

  const nlohmann::json* value_;
  std::string path_;
  std::string file_;
  std::vector<std::string> known_;
};

}  // namespace gaitmill
