#include "api/dto/page.h"

#include <nlohmann/json.hpp>

#include "api/dto/object_reader.h"

namespace gaitmill::api {

std::string renderPage(const std::vector<std::string>& items, const std::string& next_cursor) {
  std::string out = "{\"items\":[";
  for (std::size_t i = 0; i < items.size(); ++i) {
    out.append(i == 0 ? "" : ",").append(items[i]);
  }
  return out + "],\"next_cursor\":" + (next_cursor.empty() ? "null" : dumpJson(next_cursor)) + "}";
}

}  // namespace gaitmill::api
