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

std::string makeStored(const std::string& header, std::uint64_t header_size, std::size_t cells) {
  std::string bytes = "GMT1" + std::string(sizeof header_size, ' ');
  std::memcpy(&bytes[4], &header_size, sizeof header_size);
  return bytes + header + std::string(cells * sizeof(double), ' ');
}

TEST(TableCodec, RefusesHeadersThatLie) {
  const std::string huge =
      R"({"name": "t", "labels": ["a"], "units": [], "rows": 4611686018427387904})";
  const std::string units = R"({"name": "t", "labels": ["a"], "units": ["m", "s"], "rows": 1})";
  const std::string real = R"({"name": "t", "labels": ["a"], "units": [], "rows": 1e300})";
  for (const std::string& header :
       {huge, units, real, std::string("{}"), std::string("[1]"), std::string("{\"name")}) {
    try {
      decodeTable(makeStored(header, header.size(), 2));
      ADD_FAILURE() << header;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kStorage) << error.what();
    }
  }
  EXPECT_THROW(decodeTable(makeStored("{}", ~std::uint64_t{0}, 2)), Error);
}

}  // namespace
}  // namespace gaitmill
