#include "core/math/table_filters.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

TimeSeries makeSine(double frequency, double rate, int rows) {
  std::vector<double> time(static_cast<std::size_t>(rows));
  for (int i = 0; i < rows; ++i) time[static_cast<std::size_t>(i)] = 2 + i / rate;
  TimeSeries table = makeTimeSeries("wave", {"wave"}, time);
  for (int i = 0; i < rows; ++i) table.values(i, 0) = std::sin(2 * kPi * frequency * i / rate);
  return table;
}

TEST(PadOdd, ReflectsValuesAndTimesAboutTheEnds) {
  TimeSeries table = makeTimeSeries("t", {"a"}, {1.0, 2.0, 4.0});
  table.values << 10, 11, 15;
  const TimeSeries padded = padOdd(table, 2);
  const std::vector<double> time = {-2, 0, 1, 2, 4, 6, 7};
  EXPECT_EQ(padded.time, time);
  const Eigen::VectorXd expected = (Eigen::VectorXd(7) << 5, 9, 10, 11, 15, 19, 20).finished();
  EXPECT_EQ((padded.values.col(0) - expected).norm(), 0);
}

TEST(PadOdd, AddsNoMoreThanThereIs) {
  TimeSeries table = makeTimeSeries("t", {"a"}, {1.0, 2.0});
  table.values << 1, 2;
  EXPECT_EQ(padOdd(table, 60).rowCount(), 4);
}

TEST(Resampling, LeavesAConstantStepAlone) {
  TimeSeries table = makeTimeSeries("t", {"a"}, {0.0, 0.25, 0.5, 0.75, 1.0, 1.25});
  table.values.setZero();
  EXPECT_EQ(resampleAtSmallestStep(table).time, table.time);
}

// A 60 Hz file printed with eight decimals: the rows move to multiples of the smallest step.
TEST(Resampling, TakesTheSmallestStepOfRoundedTimes) {
  TimeSeries table = makeSine(1, 60, 120);
  for (double& t : table.time) t = std::round((t - 2) * 1e8) * 1e-8;
  const TimeSeries resampled = resampleAtSmallestStep(table);
  EXPECT_NEAR(resampled.time[24], 0.39999984, tol(1e-12));
  EXPECT_NEAR(resampled.values(24, 0), std::sin(2 * kPi * resampled.time[24]), tol(1e-7));
}

TEST(FirLowPass, HalvesTheCutoffAndKeepsWhatIsFarBelow) {
  const TimeSeries at_cutoff = filterFir(makeSine(6, 100, 600), 6);
  EXPECT_NEAR(at_cutoff.values.middleRows(200, 200).maxCoeff(), 0.5, tol(5e-3));
  const TimeSeries below = makeSine(2, 100, 600);
  const TimeSeries kept = filterFir(below, 6);
  EXPECT_LE((kept.values - below.values).middleRows(200, 200).cwiseAbs().maxCoeff(), tol(3e-3));
  EXPECT_EQ(kept.time, below.time);
}

TEST(FirLowPass, KeepsAStraightLineUpToTheEnds) {
  TimeSeries line = makeSine(1, 100, 200);
  for (int i = 0; i < 200; ++i) line.values(i, 0) = 5 - 0.1 * i;
  const TimeSeries filtered = filterFir(line, 6);
  EXPECT_LE((filtered.values - line.values).cwiseAbs().maxCoeff(), tol(1e-12));
}

TEST(FirLowPass, NeedsAHundredRows) {
  EXPECT_THROW(filterFir(makeSine(1, 100, 99), 6), Error);
}

TEST(RecursiveLowPass, IsSixDecibelsDownAtTheCutoff) {
  const TimeSeries filtered = filterRecursive(makeSine(6, 100, 800), 6);
  EXPECT_NEAR(filtered.values.middleRows(300, 200).maxCoeff(), 0.5, tol(5e-3));
}

TEST(RecursiveLowPass, CutoffBeyondNyquistIsLowered) {
  const TimeSeries table = makeSine(3, 100, 400);
  const double step = table.time[1] - table.time[0];
  const TimeSeries filtered = filterRecursive(table, 80);
  EXPECT_TRUE(filtered.values.allFinite());
  EXPECT_LE((filtered.values - filterRecursive(table, 0.49 / step).values).norm(), tol(1e-9));
}

TEST(DropRepeatedRows, KeepsTheFirstOfTwoRowsAtOneInstant) {
  TimeSeries table = makeTimeSeries("t", {"a"}, {0.0, 1.0, 1.0 + 6e-14, 2.0});
  table.values << 1, 2, 3, 4;
  const TimeSeries distinct = dropRepeatedRows(table);
  EXPECT_EQ(distinct.time, (std::vector<double>{0.0, 1.0, 2.0}));
  EXPECT_EQ(distinct.values(1, 0), 2);
}

TEST(CropTime, KeepsBothEnds) {
  TimeSeries table = makeTimeSeries("t", {"a"}, {0.0, 1.0, 2.0, 3.0});
  const TimeSeries cropped = cropTime(table, 1.0, 2.5);
  EXPECT_EQ(cropped.time, (std::vector<double>{1.0, 2.0}));
  EXPECT_THROW(cropTime(table, 4.0, 5.0), Error);
}

}  // namespace
}  // namespace gaitmill
