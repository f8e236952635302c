#pragma once

#include <string>
#include <vector>

namespace gaitmill {

/// How a column of one job differs from the same column of the first job, over what both have of
/// 0..100 % of the gait cycle. NaN if they have no instant in common.
struct ColumnDifference {
  double rms = 0;              ///< of job minus first job [unit of the column]
  double largest = 0;          ///< the difference of largest size, with its sign
  double largest_percent = 0;  ///< where that is [% of the cycle]
  double peak = 0;             ///< value of largest size of this job, with its sign
};

struct ColumnComparison {
  std::string column;
  std::string unit;
  double first_peak = 0;                      ///< value of largest size of the first job
  std::vector<ColumnDifference> differences;  ///< of the second job, the third, ...
};

struct TableComparison {
  std::string table;
  std::vector<ColumnComparison> columns;  ///< that all jobs have, in the order of the first
};

/// A number that the quality figures of all jobs have.
struct QuantityComparison {
  std::string quantity;        ///< "moments.knee_angle_r.rmse_nm"
  std::vector<double> values;  ///< one per job; NaN = it has none
};

struct Comparison {
  std::vector<std::string> labels;  ///< one per job
  std::vector<TableComparison> tables;
  std::vector<QuantityComparison> quality;
};

}  // namespace gaitmill
