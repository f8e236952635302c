#include "api/dto/figure.h"

#include <nlohmann/json.hpp>

#include "api/dto/comparison.h"
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

std::string renderComparisonPage(const std::vector<std::string>& job_ids,
                                 const Comparison& comparison,
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
  // Two objects become one.
  return "{\"ids\":" + dumpJson(job_ids) + ",\"plots\":[" + plots + "]," +
         renderComparison(comparison).substr(1);
}

}  // namespace gaitmill::api
