#include "core/figure/quality_limit.h"

#include <nlohmann/json.hpp>

#include "core/base/numbers.h"

namespace gaitmill {

std::optional<QualityLimit> findLimit(const JobData& data, const std::string& check) {
  const nlohmann::json& summary = data.summary();
  const nlohmann::json::json_pointer place("/quality/checks");
  if (!summary.contains(place)) {
    return std::nullopt;
  }
  for (const nlohmann::json& entry : summary.at(place)) {
    if (entry.value("figure", "") == check && entry.contains("limit") &&
        entry["limit"].is_number()) {
      return QualityLimit{
          entry["limit"].get<double>(), entry.value("unit", ""), entry.value("source", "")};
    }
  }
  return std::nullopt;
}

void addLimit(const JobData& data,
              const std::string& check,
              const std::string& what,
              double factor,
              Panel& panel) {
  if (const std::optional<QualityLimit> limit = findLimit(data, check)) {
    const double value = factor * limit->value;
    panel.guides.push_back({Guide::Direction::kHorizontal,
                            value,
                            "limit of " + what + ": " + formatShort(value) + " " + panel.y.unit +
                                " (" + limit->source.substr(0, limit->source.find(':')) + ")"});
  }
}

}  // namespace gaitmill
