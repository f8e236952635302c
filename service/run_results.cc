#include "service/run_results.h"

#include "core/base/error.h"

namespace gaitmill {

bool RunResults::has(const std::string& table, Axis axis) const {
  return tablesOf(axis).count(table) > 0;
}

const TimeSeries& RunResults::table(const std::string& table, Axis axis) const {
  const auto found = tablesOf(axis).find(table);
  require(found != tablesOf(axis).end(),
          ErrorCode::kResultNotFound,
          "this run has no table '" + table + "'",
          {"", 0, 0, table});
  return found->second;
}

const std::map<std::string, TimeSeries>& RunResults::tablesOf(Axis axis) const {
  return axis == Axis::kTime ? result_.tables : result_.cycle_tables;
}

}  // namespace gaitmill
