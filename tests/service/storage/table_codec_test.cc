#include "service/storage/table_codec.h"

#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace gaitmill {
namespace {

TimeSeries makeTable() {
  TimeSeries table = makeTimeSeries("moments", {"a", "b \"quoted\"\n"}, {0.1, 0.2, 0.3});
  table.units = {"N.m", ""};
  table.values << 1.0 / 3.0, -0.0, std::numeric_limits<double>::quiet_NaN(),
      std::numeric_limits<double>::infinity(), std::numeric_limits<double>::denorm_min(), 1e300;
  return table;
}

TEST(TableCodec, BringsEveryBitBack) {
  const TimeSeries table = makeTable();
  const TimeSeries back = decodeTable(encodeTable(table));
  EXPECT_EQ(back.name, table.name);
  EXPECT_EQ(back.labels, table.labels);
  EXPECT_EQ(back.units, table.units);
  EXPECT_EQ(back.time, table.time);
  ASSERT_EQ(back.values.size(), table.values.size());
  EXPECT_EQ(std::memcmp(back.values.data(), table.values.data(), 6 * sizeof(double)), 0);
}

TEST(TableCodec, TakesEmptyTables) {
  const TimeSeries empty = decodeTable(encodeTable(makeTimeSeries("none", {}, {})));
  EXPECT_EQ(empty.rowCount(), 0);
  EXPECT_EQ(empty.columnCount(), 0);
}

TEST(TableCodec, RefusesEveryCutAndForeignBytes) {
  const std::string bytes = encodeTable(makeTable());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(decodeTable(bytes.substr(0, size)), Error) << size;
  }
  EXPECT_THROW(decodeTable("GMT2" + bytes.substr(4)), Error);
  EXPECT_THROW(decodeTable(bytes + "x"), Error);
}

}  // namespace
}  // namespace gaitmill
