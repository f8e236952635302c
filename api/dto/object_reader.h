#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace gaitmill::api {

/// JSON text to a value. Nesting beyond 64 levels is refused, so that nothing downstream recurses
/// deeply. @throws Error kRequestMalformed with line and column
nlohmann::json parseJson(const std::string& text, const std::string& what);

/// Serializes, replacing bytes that are not UTF-8, so that a strange file name cannot fail a reply.
std::string dumpJson(const nlohmann::json& json);

/// 1 to 200 bytes without control characters: what a name or a label of the user's may be.
bool isName(const std::string& text);

/// The text of a JSON value that is a name. @throws Error kRequestField with this field
std::string toText(const nlohmann::json& value, const std::string& field);

struct NumberRange {
  double low;
  double high;
  const char* unit;
};

/// Reads the fields of one JSON object. Every complaint names the field; finish() refuses fields
/// that nobody asked for and names the nearest known one.
class ObjectReader {
 public:
  /// @throws Error kRequestField if `object` is not an object
  ObjectReader(const nlohmann::json& object, std::string name);

  double number(const std::string& field, NumberRange range);
  std::string text(const std::string& field);
  std::optional<std::string> optionalText(const std::string& field);
  /// Any value, nullptr if absent.
  const nlohmann::json* value(const std::string& field);
  void finish() const;

 private:
  const nlohmann::json& require(const std::string& field);

  const nlohmann::json& object_;
  std::string name_;
  std::vector<std::string> known_;
};

}  // namespace gaitmill::api
