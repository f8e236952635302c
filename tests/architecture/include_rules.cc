#include "tests/architecture/include_rules.h"

#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace gaitmill {

namespace {

// What a room may include besides itself. The link lists of the CMake files say the same; this
// table also holds for headers that need no linking.
const std::map<std::string, std::set<std::string>>& allowedRooms() {
  static const std::set<std::string> stage = {
      "core/base", "core/data", "core/math", "core/muscle", "core/model"};
  static const std::map<std::string, std::set<std::string>> table = {
      {"core/base", {}},
      {"core/data", {"core/base"}},
      {"core/math", {"core/base", "core/data"}},
      {"core/io", {"core/base", "core/data"}},
      {"core/muscle", {"core/base", "core/data", "core/math"}},
      {"core/model", {"core/base", "core/data", "core/math", "core/muscle"}},
      {"core/scale", stage},
      {"core/ik", stage},
      {"core/id", stage},
      {"core/rra", stage},
      {"core/cmc", stage},
      {"core/so", stage},
      {"core/analysis", stage},
      {"core/intake", {"core/base", "core/data", "core/math"}},
      {"core/sample", {"core/base", "core/data", "core/math", "core/model"}},
      {"core/figure", {"core/base", "core/data", "core/math", "core/analysis"}},
      {"core/render",
       {"core/base", "core/data", "core/math", "core/io", "core/muscle", "core/model"}},
      {"core/validation",
       {"core/base",
        "core/data",
        "core/math",
        "core/muscle",
        "core/model",
        "core/sample",
        "core/figure"}},
      {"core/report", {"core/base", "core/data", "core/math", "core/analysis", "core/figure"}},
      {"core/pipeline",
       {"core/base",
        "core/data",
        "core/math",
        "core/io",
        "core/muscle",
        "core/model",
        "core/scale",
        "core/ik",
        "core/id",
        "core/rra",
        "core/cmc",
        "core/so",
        "core/analysis",
        "core/intake",
        "core/sample"}},
      {"api", {"core/base", "core/data"}},
      // A program of the build, not of the product.
      {"api/embed", {}},
      {"service/storage", {"api", "core/base", "core/data"}},
      {"service/process", {"api", "core/base", "core/data", "core/pipeline", "core/render"}},
      {"service/observe", {"core/base"}},
      // The command line reads and shows model documents and writes the sample trial by itself.
      {"service",
       {"api",
        "service/storage",
        "service/process",
        "service/observe",
        "core/base",
        "core/data",
        "core/intake",
        "core/io",
        "core/model",
        "core/intake",
        "core/sample",
        "core/pipeline",
        "core/figure",
        "core/render",
        "core/validation",
        "core/report"}},
  };
  return table;
}

enum class Place { kAnywhere, kSourcesOnly };

// A third-party or standard header and the rooms that may see it.
struct HeaderRule {
  std::regex header;
  std::set<std::string> rooms;
  Place place;
  std::string sentence;
};

const std::vector<HeaderRule>& headerRules() {
  static const std::vector<HeaderRule> rules = {
      {std::regex("fstream|filesystem|cstdio|stdio\\.h"),
       {"core/io", "service", "service/storage", "service/observe", "api/embed"},
       Place::kAnywhere,
       "files are opened by core/io and the service only"},
      {std::regex("iostream|print|spdlog/.*"),
       {"service", "service/storage", "service/observe"},
       Place::kAnywhere,
       "only the service prints and logs"},
      {std::regex("(Simbody|SimTKcommon|SimTKmath)\\.h|(simbody|SimTKcommon|simmath)/.*"),
       {"core/model"},
       Place::kSourcesOnly,
       "Simbody is known to the sources of core/model only"},
      {std::regex("(coin(-or)?/)?Ip[A-Z].*\\.hpp"),
       {"core/math"},
       Place::kSourcesOnly,
       "Ipopt is known to the sources of core/math only"},
      {std::regex("sqlite3.*"),
       {"service/storage"},
       Place::kAnywhere,
       "SQLite is known to service/storage only"},
      {std::regex("httplib\\.h"), {"api"}, Place::kAnywhere, "HTTP is known to the api only"},
      {std::regex("(GL|EGL)/.*"), {"core/render"}, Place::kAnywhere, "OpenGL stays in core/render"},
      {std::regex("pugi.*"), {"core/io"}, Place::kAnywhere, "XML is read in core/io only"},
      {std::regex("nlohmann/.*"),
       {"core/pipeline",
        "core/figure",
        "core/report",
        "api",
        "api/embed",
        "service",
        "service/storage",
        "service/observe"},
       Place::kAnywhere,
       "JSON is known to the rooms that read or write documents only"},
      {std::regex("CLI/.*"), {"service"}, Place::kAnywhere, "the command line is the service's"},
  };
  return rules;
}

std::string checkRoomInclude(const std::string& room, const std::string& target) {
  if (target.empty() || target == room) {
    return "";
  }
  const auto row = allowedRooms().find(room);
  if (row == allowedRooms().end()) {
    return "room " + room + " is not in the include table";
  }
  return row->second.count(target) == 1 ? "" : room + " may not include " + target;
}

std::string checkHeader(const std::string& room, const std::string& file, const HeaderRule& rule) {
  if (rule.rooms.count(room) == 0) {
    return rule.sentence;
  }
  const bool is_header = file.size() > 2 && file.compare(file.size() - 2, 2, ".h") == 0;
  return is_header && rule.place == Place::kSourcesOnly ? rule.sentence : "";
}

}  // namespace

std::string findRoom(const std::string& path) {
  static const std::regex room("(core/[a-z0-9_]+|service/[a-z0-9_]+|service|api/embed|api)/.*");
  std::smatch match;
  return std::regex_match(path, match, room) ? match[1].str() : "";
}

std::vector<std::string> findIncludes(const std::string& source) {
  static const std::regex directive("\\s*#\\s*include\\s*[<\"]([^>\"]+)[>\"].*");
  std::vector<std::string> includes;
  std::istringstream lines(source);
  std::string line;
  while (std::getline(lines, line)) {
    std::smatch match;
    if (std::regex_match(line, match, directive)) {
      includes.push_back(match[1].str());
    }
  }
  return includes;
}

std::vector<IncludeViolation> checkIncludes(const std::string& file,
                                            const std::vector<std::string>& includes) {
  const std::string room = findRoom(file);
  std::vector<IncludeViolation> violations;
  for (const std::string& include : includes) {
    std::string broken = checkRoomInclude(room, findRoom(include));
    for (const HeaderRule& rule : headerRules()) {
      if (broken.empty() && std::regex_match(include, rule.header)) {
        broken = checkHeader(room, file, rule);
      }
    }
    if (!broken.empty()) {
      violations.push_back({file, include, broken});
    }
  }
  return violations;
}

}  // namespace gaitmill
