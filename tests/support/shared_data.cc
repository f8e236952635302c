#include "tests/support/shared_data.h"

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>

namespace gaitmill {

std::string findSharedFolder() {
  const char* named = std::getenv("GAITMILL_SHARED");
  const std::string folder = named == nullptr ? "../shared" : named;
  return std::filesystem::is_directory(folder + "/reference") ? folder : "";
}

int CsvTable::column(const std::string& name) const {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) {
      return static_cast<int>(i);
    }
  }
  throw std::runtime_error("no CSV column " + name);
}

double CsvTable::number(int row, int column) const {
  return std::stod(rows.at(static_cast<std::size_t>(row)).at(static_cast<std::size_t>(column)));
}

namespace {

std::vector<std::string> splitCells(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  std::string cell;
  while (std::getline(stream, cell, ',')) {
    if (!cell.empty() && cell.back() == '\r') {
      cell.pop_back();
    }
    cells.push_back(cell);
  }
  return cells;
}

}  // namespace

CsvTable readCsv(const std::string& path) {
  std::ifstream file(path);
  if (!file) {
    throw std::runtime_error("cannot read " + path);
  }
  CsvTable table;
  std::string line;
  std::getline(file, line);
  table.names = splitCells(line);
  while (std::getline(file, line)) {
    if (!line.empty()) {
      table.rows.push_back(splitCells(line));
    }
  }
  return table;
}

TimeSeries readCsvSeries(const std::string& path) {
  const CsvTable csv = readCsv(path);
  std::vector<double> time;
  for (int row = 0; row < static_cast<int>(csv.rows.size()); ++row) {
    time.push_back(csv.number(row, 0));
  }
  TimeSeries table = makeTimeSeries(path, {csv.names.begin() + 1, csv.names.end()}, time);
  for (int row = 0; row < table.rowCount(); ++row) {
    for (int column = 0; column < table.columnCount(); ++column) {
      table.values(row, column) = csv.number(row, column + 1);
    }
  }
  return table;
}

void SharedDataTest::SetUp() {
  folder_ = findSharedFolder();
  if (!folder_.empty()) {
    return;
  }
  const char* ci = std::getenv("CI");
  if (ci != nullptr && std::string(ci) == "true") {
    FAIL() << "the shared data folder is absent: set GAITMILL_SHARED";
  }
  std::cerr << "*** SKIPPED: no shared data folder; this agreement was NOT checked. Set "
               "GAITMILL_SHARED.\n";
  GTEST_SKIP() << "no shared data folder";
}

}  // namespace gaitmill
