#include "tests/http/json_schema.h"

#include <regex.h>

#include <algorithm>
#include <functional>
#include <map>

namespace gaitmill {

namespace {

using nlohmann::json;
using Faults = std::vector<std::string>;

// POSIX, because GCC 12 takes std::regex for uninitialized under the address sanitizer.
bool matches(const std::string& text, const std::string& pattern) {
  regex_t compiled{};
  if (::regcomp(&compiled, pattern.c_str(), REG_EXTENDED | REG_NOSUB) != 0) {
    return false;
  }
  const bool found = ::regexec(&compiled, text.c_str(), 0, nullptr, 0) == 0;
  ::regfree(&compiled);
  return found;
}

class Checker {
 public:
  explicit Checker(const json& root) : root_(root) {}

  void check(const json& value, const json& schema, const std::string& place) {
    static const std::map<std::string, Rule> rules = {
        {"$ref", &Checker::checkRef},
        {"type", &Checker::checkType},
        {"const", &Checker::checkConst},
        {"enum", &Checker::checkEnum},
        {"required", &Checker::checkRequired},
        {"properties", &Checker::checkProperties},
        {"additionalProperties", &Checker::checkClosed},
        {"items", &Checker::checkItems},
        {"minProperties", &Checker::checkSize},
        {"minimum", &Checker::checkMinimum},
        {"maximum", &Checker::checkMaximum},
        {"pattern", &Checker::checkPattern},
        {"anyOf", &Checker::checkAnyOf},
        {"not", &Checker::checkNot}};
    for (const auto& [keyword, argument] : schema.items()) {
      if (keyword == "description" || keyword == "default" || keyword == "format" ||
          keyword == "contentEncoding") {
        continue;
      }
      const auto rule = rules.find(keyword);
      if (rule == rules.end()) {
        faults.push_back(place + ": schema keyword " + keyword + " is not known to this test");
      } else {
        (this->*rule->second)(value, schema, argument, place);
      }
    }
  }

  Faults faults;

 private:
  using Rule = void (Checker::*)(const json&, const json&, const json&, const std::string&);

  bool fits(const json& value, const json& schema) const {
    return findSchemaFaults(value, schema, root_).empty();
  }

  void expect(bool ok, const std::string& place, const std::string& fault) {
    if (!ok) {
      faults.push_back(place + ": " + fault);
    }
  }

  static bool hasType(const json& value, const std::string& type) {
    return (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
           (type == "string" && value.is_string()) || (type == "number" && value.is_number()) ||
           (type == "integer" && value.is_number_integer()) ||
           (type == "boolean" && value.is_boolean()) || (type == "null" && value.is_null());
  }

  void checkRef(const json& value, const json&, const json& ref, const std::string& place) {
    check(value, root_.at(json::json_pointer(ref.get<std::string>().substr(1))), place);
  }
  void checkType(const json& value, const json&, const json& type, const std::string& place) {
    const json list = type.is_array() ? type : json::array({type});
    const bool ok =
        std::any_of(list.begin(), list.end(), [&](const json& t) { return hasType(value, t); });
    expect(ok, place, "is " + std::string(value.type_name()) + ", not " + type.dump());
  }
  void checkConst(const json& value, const json&, const json& wanted, const std::string& place) {
    expect(value == wanted, place, "is not " + wanted.dump());
  }
  void checkEnum(const json& value, const json&, const json& list, const std::string& place) {
    const bool ok = std::find(list.begin(), list.end(), value) != list.end();
    expect(ok, place, value.dump() + " is not one of " + list.dump());
  }
  // Of objects only: where null is allowed, it has no members.
  void checkRequired(const json& value, const json&, const json& list, const std::string& place) {
    if (!value.is_object()) {
      return;
    }
    for (const json& name : list) {
      expect(value.contains(name.get<std::string>()), place, "has no " + name.dump());
    }
  }
  void checkProperties(const json& value,
                       const json&,
                       const json& properties,
                       const std::string& place) {
    for (const auto& [name, schema] : properties.items()) {
      if (value.contains(name)) {
        check(value[name], schema, place + "." + name);
      }
    }
  }
  void checkClosed(const json& value, const json& schema, const json& open, const std::string& p) {
    for (const auto& [name, child] : value.items()) {
      if (schema.contains("properties") && schema["properties"].contains(name)) {
        continue;
      }
      expect(open != false, p, "has a field " + name);
      if (open.is_object()) {
        check(child, open, p + "." + name);
      }
    }
  }
  void checkItems(const json& value, const json&, const json& schema, const std::string& place) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      check(value[i], schema, place + "[" + std::to_string(i) + "]");
    }
  }
  void checkSize(const json& value, const json&, const json& low, const std::string& place) {
    expect(value.size() >= low, place, "has fewer than " + low.dump() + " fields");
  }
  void checkMinimum(const json& value, const json&, const json& low, const std::string& place) {
    expect(!value.is_number() || value >= low, place, "is below " + low.dump());
  }
  void checkMaximum(const json& value, const json&, const json& high, const std::string& place) {
    expect(!value.is_number() || value <= high, place, "is above " + high.dump());
  }
  void checkPattern(const json& value, const json&, const json& regex, const std::string& place) {
    const bool ok =
        !value.is_string() || matches(value.get<std::string>(), regex.get<std::string>());
    expect(ok, place, value.dump() + " does not match " + regex.dump());
  }
  void checkAnyOf(const json& value, const json&, const json& list, const std::string& place) {
    const bool ok =
        std::any_of(list.begin(), list.end(), [&](const json& s) { return fits(value, s); });
    expect(ok, place, "fits none of the alternatives");
  }
  void checkNot(const json& value, const json&, const json& schema, const std::string& place) {
    expect(!fits(value, schema), place, "fits what it must not");
  }

  const json& root_;
};

}  // namespace

std::vector<std::string> findSchemaFaults(const json& value, const json& schema, const json& root) {
  Checker checker(root);
  checker.check(value, schema, "$");
  return checker.faults;
}

}  // namespace gaitmill
