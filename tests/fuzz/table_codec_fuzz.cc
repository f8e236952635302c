#include <string>

#include "service/storage/table_codec.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {

// A table from a damaged database.
GAITMILL_FUZZ_TARGET(table_codec) {
  const TimeSeries table = decodeTable(std::string(input));
  requirePromise(
      table.values.rows() == table.rowCount() && table.values.cols() == table.columnCount(),
      "values fit labels and times");
  encodeTable(table);
}

}  // namespace gaitmill
