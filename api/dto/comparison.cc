#include "api/dto/comparison.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "api/dto/object_reader.h"
#include "core/base/numbers.h"

namespace gaitmill::api {

namespace {

using nlohmann::json;

json toJson(double value) {
  constexpr int kDigits = 4;
  return std::isfinite(value) ? json(roundSignificant(value, kDigits)) : json(nullptr);
}

json renderColumn(const ColumnComparison& column) {
  json differences = json::array();
  for (const ColumnDifference& difference : column.differences) {
    differences.push_back({{"rms", toJson(difference.rms)},
                           {"largest", toJson(difference.largest)},
                           {"largest_percent", toJson(difference.largest_percent)},
                           {"peak", toJson(difference.peak)}});
  }
  return {{"name", column.column},
          {"unit", column.unit.empty() ? "1" : column.unit},
          {"first_peak", toJson(column.first_peak)},
          {"differences", differences}};
}

json renderTable(const TableComparison& table) {
  json columns = json::array();
  for (const ColumnComparison& column : table.columns) {
    columns.push_back(renderColumn(column));
  }
  return {{"name", table.table}, {"columns", columns}};
}

}  // namespace

std::string renderComparison(const Comparison& comparison) {
  json tables = json::array();
  for (const TableComparison& table : comparison.tables) {
    tables.push_back(renderTable(table));
  }
  json quality = json::array();
  for (const QuantityComparison& quantity : comparison.quality) {
    json values = json::array();
    for (const double value : quantity.values) {
      values.push_back(toJson(value));
    }
    quality.push_back({{"quantity", quantity.quantity}, {"values", values}});
  }
  return dumpJson({{"jobs", comparison.labels},
                   {"axis", "gait_cycle"},
                   {"tables", tables},
                   {"quality", quality}});
}

}  // namespace gaitmill::api
