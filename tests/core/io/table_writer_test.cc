#include "core/io/table_writer.h"

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "core/io/table_reader.h"
#include "core/io/trc_reader.h"
#include "tests/support/shared_data.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

bool sameBits(const RowMatrix& a, const RowMatrix& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) {
    return false;
  }
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    const bool both_missing = std::isnan(a.data()[i]) && std::isnan(b.data()[i]);
    if (!both_missing && a.data()[i] != b.data()[i]) {
      return false;
    }
  }
  return true;
}

/// Doubles of all magnitudes, some missing.
TimeSeries makeRandomTable() {
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> exponent(-300, 300);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::vector<double> time;
  for (int i = 0; i < 50; ++i) {
    time.push_back(0.45 + i / 3000.0);
  }
  TimeSeries table = makeTimeSeries("random", {"a", "/forceset/b/activation", "c"}, time);
  table.units = {"N", "", "rad"};
  for (Eigen::Index i = 0; i < table.values.size(); ++i) {
    table.values.data()[i] =
        i % 11 == 0 ? kNaN : mantissa(generator) * std::pow(10, exponent(generator));
  }
  return table;
}

TEST(TableWriter, StoReadsBackBitForBit) {
  const TimeSeries table = makeRandomTable();
  const TableFile back = readTable(writeTable(table), "a.sto");
  EXPECT_EQ(back.table.name, table.name);
  EXPECT_EQ(back.table.labels, table.labels);
  EXPECT_EQ(back.table.time, table.time);
  EXPECT_TRUE(sameBits(back.table.values, table.values));
  EXPECT_TRUE(back.degrees_stated);
  EXPECT_FALSE(back.in_degrees);
  EXPECT_TRUE(back.warnings.empty());
}

TEST(TableWriter, CsvReadsBackBitForBitWithUnits) {
  const TimeSeries table = makeRandomTable();
  const std::string text = writeCsv(table);
  EXPECT_EQ(text.substr(0, text.find('\n')), "time [s],a [N],/forceset/b/activation [1],c [rad]");
  const TableFile back = readTable(text, "a.csv");
  EXPECT_EQ(back.table.labels, table.labels);
  EXPECT_EQ(back.table.units, table.units);
  EXPECT_EQ(back.table.time, table.time);
  EXPECT_TRUE(sameBits(back.table.values, table.values));
}

TEST(TableWriter, TableWhosePartsDoNotFitIsRefused) {
  TimeSeries table = makeRandomTable();
  table.labels.pop_back();
  EXPECT_THROW(writeTable(table), Error);
}

TEST(TrcWriter, ReadsBackBitForBit) {
  MarkerTrajectories markers;
  markers.names = {"R.Heel", "With blank"};
  markers.rate = 100;
  markers.time = {0.23, 0.24, 0.25};
  markers.positions = RowMatrix::Random(3, 6);
  markers.positions.block<1, 3>(1, 3).setConstant(kNaN);
  TrcOptions options;
  options.times = TrcOptions::Times::kExact;
  const TrcFile back = readTrc(writeTrc(markers, "a.trc"), "a.trc", options);
  EXPECT_EQ(back.markers.names, markers.names);
  EXPECT_EQ(back.markers.time, markers.time);
  EXPECT_EQ(back.markers.rate, markers.rate);
  EXPECT_TRUE(sameBits(back.markers.positions, markers.positions));
  EXPECT_TRUE(back.warnings.empty());
}

class TableWriterShared : public SharedDataTest {};

// A file in degrees keeps translations and the patella as they are, and comes back the same.
TEST_F(TableWriterShared, MotionInDegreesReadsBack) {
  const std::string path = "data/models/Rajagopal2016.osim";
  const ModelSpec model = readOsim(readFile(shared(path)), path);
  const std::string motion = "data/walk/moco/coordinates.mot";
  const TableFile original = readTable(readFile(shared(motion)), motion);
  const TimeSeries q = toCoordinates(original, model);
  const std::string text = writeTable(q, {AngleUnit::kDegrees, &model, {}});
  const TableFile back = readTable(text, "a.mot");
  EXPECT_TRUE(back.in_degrees);
  EXPECT_LT((back.table.values - original.table.values).cwiseAbs().maxCoeff(), tol(1e-13))
      << "two roundings of numbers up to 150";
  const TimeSeries again = toCoordinates(back, model);
  EXPECT_LT((again.values - q.values).cwiseAbs().maxCoeff(), tol(1e-15));
}

// Without a model the table's own units tell angles from lengths.
TEST(TableWriter, UnitsTellAnglesWithoutAModel) {
  TimeSeries table = makeTimeSeries("q", {"knee_angle_r", "pelvis_ty"}, {0.0});
  table.units = {"rad", "m"};
  table.values << 0.5, 0.9;
  const std::string text = writeTable(table, {AngleUnit::kDegrees, nullptr, {}});
  EXPECT_NE(text.find("inDegrees=yes"), std::string::npos);
  EXPECT_NE(text.find("0\t28.64788975654116\t0.9\n"), std::string::npos) << text;
  table.units.clear();  // neither model nor units
  EXPECT_THROW(writeTable(table, {AngleUnit::kDegrees, nullptr, {}}), Error);
}

TEST_F(TableWriterShared, CsvInDegreesReadsBack) {
  const std::string path = "data/models/Rajagopal2016.osim";
  const ModelSpec model = readOsim(readFile(shared(path)), path);
  const std::string motion = "data/walk/moco/coordinates.mot";
  const TimeSeries q = toCoordinates(readTable(readFile(shared(motion)), motion), model);
  const std::string text = writeCsv(q, {AngleUnit::kDegrees, &model, {}});
  EXPECT_NE(text.find(",knee_angle_r [deg],knee_angle_r_beta [rad],"), std::string::npos);
  const TimeSeries back = toCoordinates(readTable(text, "a.csv"), model);
  EXPECT_LT((back.values - q.values).cwiseAbs().maxCoeff(), tol(1e-15));
}

}  // namespace
}  // namespace gaitmill
