#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/data/time_series.h"
#include "core/model/model.h"

namespace gaitmill {

/// Columns of the labels, in their order. @throws Error kTableUnknownLabel
std::vector<int> getColumns(const TimeSeries& table, const std::vector<std::string>& labels);

/// Those columns of one row. @param picked  (columns.size())
void pickRow(const TimeSeries& table,
             int row,
             const std::vector<int>& columns,
             Eigen::Ref<Eigen::VectorXd> picked);

/// Names of the model's muscles, in order.
std::vector<std::string> listMuscles(const Model& model);

}  // namespace gaitmill
