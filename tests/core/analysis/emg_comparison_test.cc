#include "core/analysis/emg_comparison.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr GaitCycle kCycle{2.0, 3.0};  // a percent is 10 ms

using Shape = std::function<double(double percent)>;

/// A record of a shape that repeats with the cycle, rows every 1 ms.
TimeSeries makeRecord(const std::string& name, const Shape& shape, double start, double end) {
  std::vector<double> time;
  for (int i = 0; start + 1e-3 * i <= end + 1e-9; ++i) {
    time.push_back(start + 1e-3 * i);
  }
  TimeSeries record = makeTimeSeries(name, {"m"}, time);
  for (int i = 0; i < record.rowCount(); ++i) {
    const double percent = calcPercent(kCycle, time[static_cast<std::size_t>(i)]);
    record.values(i, 0) = shape(percent - 100 * std::floor(percent / 100));
  }
  return record;
}

/// A triangle of height 1 and half width 25.5 % around a centre, 0 elsewhere: on (above 20 %)
/// within 20.4 % of the centre.
Shape makeTriangle(double center) {
  return [center](double percent) {
    return std::max(0.0, 1 - std::abs(std::remainder(percent - center, 100.0)) / 25.5);
  };
}

EmgChannel makeChannel(const std::vector<std::string>& muscles) {
  return {"SOL", 0, muscles, BodySide::kRight};
}

EmgComparison compare(const Shape& emg, const Shape& activation) {
  return compareEmg(makeRecord("emg", emg, 1.5, 3.5),
                    makeRecord("activations", activation, 1.9, 3.1),
                    makeChannel({"m"}),
                    kCycle);
}

TEST(EmgComparison, OfTheSameCurveIsPerfect) {
  const EmgComparison same = compare(makeTriangle(40), makeTriangle(40));
  EXPECT_EQ(same.instants, 100);
  EXPECT_EQ(same.overlap, 1.0);
  EXPECT_NEAR(same.correlation, 1.0, tol(1e-12));
  EXPECT_EQ(same.lag, 0.0);
  EXPECT_NEAR(same.rms_difference, 0.0, tol(1e-12));
  EXPECT_NEAR(same.onset_difference, 0.0, tol(1e-9));
}

TEST(EmgComparison, ALaterSimulationIsLaterInEveryFigure) {
  const EmgComparison later = compare(makeTriangle(40), makeTriangle(47));
  EXPECT_EQ(later.lag, 7.0);
  EXPECT_NEAR(later.correlation, 1.0, tol(1e-9));
  EXPECT_LT(later.correlation_at_zero, 0.95);
  ASSERT_EQ(later.emg_bursts.size(), 1U);
  EXPECT_NEAR(later.emg_bursts[0].onset, 19.6, tol(1e-6));
  EXPECT_NEAR(later.emg_bursts[0].offset, 60.4, tol(1e-6));
  EXPECT_NEAR(later.onset_difference, 7.0, tol(1e-6));
  EXPECT_NEAR(later.offset_difference, 7.0, tol(1e-6));
  // On at 19.6 to 60.4 % against 26.6 to 67.4 %: seven whole percents apart at each end.
  EXPECT_NEAR(later.overlap, 0.86, tol(1e-12));
  const EmgComparison earlier = compare(makeTriangle(47), makeTriangle(40));
  EXPECT_EQ(earlier.lag, -7.0);
  EXPECT_NEAR(earlier.onset_difference, -7.0, tol(1e-6));
}

TEST(EmgComparison, ABurstMayGoOverTheStrike) {
  const EmgComparison over = compare(makeTriangle(98), makeTriangle(3));
  EXPECT_EQ(over.lag, 5.0);
  ASSERT_EQ(over.emg_bursts.size(), 1U);
  EXPECT_NEAR(over.emg_bursts[0].onset, 77.6, tol(1e-6));
  EXPECT_NEAR(over.emg_bursts[0].offset, 18.4, tol(1e-6));
  EXPECT_NEAR(over.onset_difference, 5.0, tol(1e-6));
}

TEST(EmgComparison, DoesNotDependOnAmplitudes) {
  const Shape triangle = makeTriangle(40);
  const EmgComparison small =
      compare([&](double p) { return 3e-5 * triangle(p); }, makeTriangle(50));
  const EmgComparison large = compare([&](double p) { return 40 * triangle(p); }, makeTriangle(50));
  EXPECT_NEAR(small.scale * 3e-5, 1.0, tol(1e-9));
  EXPECT_NEAR(large.scale * 40, 1.0, tol(1e-9));
  EXPECT_NEAR(small.rms_difference, large.rms_difference, tol(1e-12));
  EXPECT_EQ(small.overlap, large.overlap);
  EXPECT_EQ(small.lag, large.lag);
}

TEST(EmgComparison, TakesTheMeanOfTheMusclesThatThereAre) {
  const TimeSeries emg = makeRecord("emg", makeTriangle(40), 2, 3);
  TimeSeries activations = makeTimeSeries("activations", {"a", "b"}, emg.time);
  activations.values.col(0) = 0.2 * emg.values;
  activations.values.col(1) = 0.6 * emg.values;
  const EmgComparison both = compareEmg(emg, activations, makeChannel({"a", "b", "c"}), kCycle);
  EXPECT_EQ(both.muscles, (std::vector<std::string>{"a", "b"}));
  EXPECT_NEAR(both.activation_peak, 0.4, tol(1e-12));
}

TEST(EmgComparison, ARecordThatStartsLateIsRealigned) {
  // From 25 to 125 % of the cycle, as the published walking trial.
  const Shape early = makeTriangle(10);
  const EmgComparison shifted = compareEmg(makeRecord("emg", early, 0, 5),
                                           makeRecord("activations", early, 2.25, 3.25),
                                           makeChannel({"m"}),
                                           kCycle);
  EXPECT_EQ(shifted.instants, 100);
  EXPECT_NEAR(shifted.correlation_at_zero, 1.0, tol(1e-9));
  EXPECT_EQ(shifted.overlap, 1.0);
}

TEST(EmgComparison, WhatTheRecordDoesNotShowIsNotTold) {
  // 0 to 60 % only, the burst of 29.6 to 70.4 % is cut.
  const EmgComparison cut = compareEmg(makeRecord("emg", makeTriangle(50), 2.0, 2.6),
                                       makeRecord("activations", makeTriangle(50), 2.0, 3.0),
                                       makeChannel({"m"}),
                                       kCycle);
  EXPECT_EQ(cut.instants, 61);
  EXPECT_TRUE(std::isnan(cut.correlation));
  EXPECT_TRUE(std::isnan(cut.lag));
  ASSERT_EQ(cut.emg_bursts.size(), 1U);
  EXPECT_NEAR(cut.emg_bursts[0].onset, 29.6, tol(1e-6));
  EXPECT_TRUE(std::isnan(cut.emg_bursts[0].offset));
  EXPECT_TRUE(std::isnan(cut.offset_difference));
  EXPECT_EQ(cut.overlap, 1.0);
}

TEST(EmgComparison, APercentThatIsMissingHidesNoBurst) {
  // 99 % is not recorded; a burst of 79.6 to 20.4 % goes over it.
  const EmgComparison short_of = compareEmg(makeRecord("emg", makeTriangle(0), 1.5, 3.5),
                                            makeRecord("activations", makeTriangle(2), 2.0, 2.985),
                                            makeChannel({"m"}),
                                            kCycle);
  EXPECT_EQ(short_of.instants, 99);
  ASSERT_EQ(short_of.emg_bursts.size(), 1U);
  EXPECT_NEAR(short_of.emg_bursts[0].onset, 79.6, tol(1e-6));
  EXPECT_NEAR(short_of.onset_difference, 2.0, tol(1e-6));
}

TEST(EmgComparison, RecordsWithoutCommonTimeHaveNoFigures) {
  const EmgComparison none = compareEmg(makeRecord("emg", makeTriangle(50), 7.0, 8.0),
                                        makeRecord("activations", makeTriangle(50), 2.0, 3.0),
                                        makeChannel({"m"}),
                                        kCycle);
  EXPECT_EQ(none.instants, 0);
  EXPECT_TRUE(std::isnan(none.overlap));
  EXPECT_TRUE(std::isnan(none.scale));
}

TEST(EmgComparison, SpikesAndDipsBelowThreePercentDoNotCount) {
  const Shape triangle = makeTriangle(40);
  const Shape spiky = [&](double percent) {
    const bool spike = percent >= 80 && percent < 82;
    const bool dip = percent >= 40 && percent < 42;
    return spike ? 0.5 : dip ? 0.1 : triangle(percent);
  };
  const EmgComparison compared = compare(spiky, triangle);
  EXPECT_EQ(compared.emg_bursts.size(), 1U);
  EXPECT_EQ(compared.overlap, 1.0);
}

TEST(EmgComparison, SilentChannelsAndConstantOnesHaveNoTiming) {
  const EmgComparison silent = compare([](double) { return 0.0; }, makeTriangle(40));
  EXPECT_TRUE(std::isnan(silent.overlap));
  const EmgComparison constant = compare([](double) { return 2.0; }, makeTriangle(40));
  EXPECT_TRUE(std::isnan(constant.correlation));
  ASSERT_EQ(constant.emg_bursts.size(), 1U);
  EXPECT_TRUE(std::isnan(constant.emg_bursts[0].onset));
  EXPECT_TRUE(std::isnan(constant.onset_difference));
  const double missing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(compare([&](double) { return missing; }, makeTriangle(40)).instants, 0);
}

}  // namespace
}  // namespace gaitmill
