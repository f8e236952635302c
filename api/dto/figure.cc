#include "api/dto/figure.h"

#include <nlohmann/json.hpp>

#include "api/dto/object_reader.h"
#include "api/dto/page.h"

namespace gaitmill::api {

std::string renderFigureInfo(const FigureInfo& info, const std::string& url) {
  return dumpJson(
      {{"name", info.name}, {"title", info.title}, {"caption", info.caption}, {"url", url}});
}

std::string renderFigureList(const std::vector<FigureInfo>& figures,
                             const std::string& folder,
                             const std::string& query) {
  std::vector<std::string> items;
  items.reserve(figures.size());
  for (const FigureInfo& info : figures) {
    items.push_back(renderFigureInfo(info, folder + "/" + info.name + query));
  }
  return renderPage(items, "");
}

std::string renderComparison(const std::vector<std::string>& job_ids,
                             const std::string& tables_json,
                             const std::vector<FigureInfo>& figures) {
  std::string query = "?jobs=";
  for (const std::string& id : job_ids) {
    query += (id == job_ids.front() ? "" : ",") + id;
  }
  std::string plots;
  for (const FigureInfo& info : figures) {
    plots += (plots.empty() ? "" : ",") +
             renderFigureInfo(info, "/v1/compare/plots/" + info.name + query);
  }
  return "{\"jobs\":" + dumpJson(job_ids) + ",\"tables\":" + tables_json + ",\"plots\":[" + plots +
         "]}";
}

}  // namespace gaitmill::api
