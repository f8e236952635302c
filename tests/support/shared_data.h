#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/data/time_series.h"

namespace gaitmill {

/// Folder with the trials and reference numbers that are not part of the project: GAITMILL_SHARED,
/// by default ../shared. Empty if it is absent.
std::string findSharedFolder();

/// A CSV file of the reference folder: first row names, then rows of text cells.
struct CsvTable {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;
  int column(const std::string& name) const;  ///< fails the process if absent
  double number(int row, int column) const;
};
CsvTable readCsv(const std::string& path);

/// The same with all cells numbers and a first column "time".
TimeSeries readCsvSeries(const std::string& path);

/// For tests that read the shared folder. Where it is absent they are skipped loudly, and fail
/// under CI=true, so that a green CI cannot hide that the agreement was never checked.
class SharedDataTest : public ::testing::Test {
 protected:
  void SetUp() override;
  std::string shared(const std::string& relative) const { return folder_ + "/" + relative; }

 private:
  std::string folder_;
};

}  // namespace gaitmill
