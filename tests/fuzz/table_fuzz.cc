#include <algorithm>
#include <functional>

#include "core/io/table_reader.h"
#include "core/io/table_writer.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {
namespace {

void checkTable(const TableFile& file) {
  const TimeSeries& table = file.table;
  requirePromise(table.rowCount() > 0, "there is a row");
  requirePromise(
      table.values.rows() == table.rowCount() && table.values.cols() == table.columnCount(),
      "values fit labels and times");
  requirePromise(std::is_sorted(table.time.begin(), table.time.end(), std::less_equal<>()),
                 "times increase");
  requirePromise(file.row_lines.size() == table.time.size(), "every row has its line");
  requirePromise(file.label_columns.size() == table.labels.size(), "every label has its column");
}

}  // namespace

GAITMILL_FUZZ_TARGET(table) {
  for (const char* name : {"fuzz.mot", "fuzz.sto", "fuzz.csv"}) {
    tryParse([&] { checkTable(readTable(input, name)); });
  }
  tryParse([&] {
    const TimeSeries table = readTable(input, "fuzz.sto").table;
    for (const std::string& label : table.labels) {
      parseColumnName(label);
    }
    writeTable(table);
    writeCsv(table);
  });
}

}  // namespace gaitmill
