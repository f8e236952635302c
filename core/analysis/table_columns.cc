#include "core/analysis/table_columns.h"

#include <cstddef>

namespace gaitmill {

std::vector<int> getColumns(const TimeSeries& table, const std::vector<std::string>& labels) {
  std::vector<int> columns;
  columns.reserve(labels.size());
  for (const std::string& label : labels) {
    columns.push_back(table.getColumn(label));
  }
  return columns;
}

void pickRow(const TimeSeries& table,
             int row,
             const std::vector<int>& columns,
             Eigen::Ref<Eigen::VectorXd> picked) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    picked[static_cast<Eigen::Index>(i)] = table.values(row, columns[i]);
  }
}

std::vector<std::string> listMuscles(const Model& model) {
  std::vector<std::string> names;
  for (const MuscleSpec& muscle : model.spec().muscles) {
    names.push_back(muscle.name);
  }
  return names;
}

}  // namespace gaitmill
