#include "core/scale/scale_factors.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/simple_models.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// One body on a slider with markers A, B 0.4 m apart along y and C 0.2 m beside A.
ModelSpec makeModel() {
  ModelSpec spec = makeSlider("thigh");
  spec.markers = {{"A", "thigh", {0, 0, 0}, false},
                  {"B", "thigh", {0, -0.4, 0}, false},
                  {"C", "thigh", {0, 0, 0.2}, false}};
  return spec;
}

/// A, B, C measured `scale` times as far apart, 10 frames at 0.0 .. 0.9 s.
MarkerTrajectories makeTrial(double scale) {
  MarkerTrajectories trial;
  trial.names = {"A", "B", "C"};
  trial.positions = RowMatrix::Zero(10, 9);
  for (int frame = 0; frame < 10; ++frame) {
    trial.time.push_back(0.1 * frame);
    trial.positions(frame, 4) = -0.4 * scale;
    trial.positions(frame, 8) = 0.2 * scale;
  }
  return trial;
}

ScaleOptions makeOptions() {
  ScaleOptions options;
  MeasurementSpec length;
  length.name = "length";
  length.pairs = {{"A", "B"}};
  length.bodies = {"thigh"};
  length.axes = {false, true, false};
  options.marker_set.measurements.push_back(length);
  return options;
}

/// A to C, across the thigh.
MeasurementSpec makeWidth() {
  MeasurementSpec width;
  width.name = "width";
  width.pairs = {{"A", "C"}};
  width.bodies = {"thigh"};
  width.axes = {false, false, true};
  return width;
}

TEST(ScaleFactors, MeanOfThePairsOnTheNamedAxesOnly) {
  ScaleOptions options = makeOptions();
  options.marker_set.measurements[0].pairs.push_back({"A", "C"});
  MarkerTrajectories trial = makeTrial(1.1);
  trial.positions.col(8).setConstant(0.2 * 1.3);
  const ScaleFactors factors = calcScaleFactors(Model(makeModel()), trial, options);
  EXPECT_NEAR(factors.bodies[0].factors.y(), 1.2, tol(1e-12));
  EXPECT_EQ(factors.bodies[0].factors.x(), 1.0);
  ASSERT_EQ(factors.measurements[0].pairs.size(), 2U);
  EXPECT_NEAR(factors.measurements[0].pairs[1].factor, 1.3, tol(1e-12));
  ASSERT_EQ(factors.warnings.size(), 1U);  // the two pairs disagree
}

TEST(ScaleFactors, OrderDecidesWhoWins) {
  ScaleOptions options = makeOptions();
  options.marker_set.manual.push_back({{"thigh"}, {2, 2, 2}});
  const Model model(makeModel());
  options.marker_set.order = ScalingOrder::kManualThenMeasurements;
  const Eigen::Vector3d measured_last =
      calcScaleFactors(model, makeTrial(1.1), options).bodies[0].factors;
  EXPECT_NEAR(measured_last.y(), 1.1, tol(1e-12));
  EXPECT_EQ(measured_last.x(), 2.0);
  options.marker_set.order = ScalingOrder::kMeasurementsThenManual;
  EXPECT_EQ(calcScaleFactors(model, makeTrial(1.1), options).bodies[0].factors,
            Eigen::Vector3d::Constant(2));
}

TEST(ScaleFactors, MissingFramesAreLeftOutOfTheMean) {
  MarkerTrajectories trial = makeTrial(1.1);
  trial.positions.row(3).segment<3>(3).setConstant(kNaN);
  const ScaleFactors factors = calcScaleFactors(Model(makeModel()), trial, makeOptions());
  EXPECT_NEAR(factors.bodies[0].factors.y(), 1.1, tol(1e-12));
  EXPECT_NEAR(factors.measurements[0].pairs[0].visible_fraction, 0.9, tol(1e-12));
}

TEST(ScaleFactors, RequiredPairThatCannotBeMeasuredIsNamed) {
  const Model model(makeModel());
  MarkerTrajectories seldom = makeTrial(1.1);
  seldom.positions.middleRows(0, 4).setConstant(kNaN);
  ScaleOptions unknown = makeOptions();
  unknown.marker_set.measurements[0].pairs[0].second = "HJC";
  struct Case {
    MarkerTrajectories trial;
    ScaleOptions options;
  };
  for (const Case& bad : {Case{seldom, makeOptions()}, Case{makeTrial(1), unknown}}) {
    try {
      calcScaleFactors(model, bad.trial, bad.options);
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInputMarkers);
      EXPECT_NE(error.message().find("'length'"), std::string::npos);
    }
  }
}

TEST(ScaleFactors, OptionalPairThatCannotBeMeasuredIsAWarning) {
  ScaleOptions options = makeOptions();
  options.marker_set.measurements[0].pairs[0].second = "HJC";
  options.marker_set.measurements[0].required = false;
  const ScaleFactors factors = calcScaleFactors(Model(makeModel()), makeTrial(1.1), options);
  EXPECT_EQ(factors.bodies[0].factors, Eigen::Vector3d::Ones());
  EXPECT_EQ(factors.measurements[0].factor, -1);
  ASSERT_EQ(factors.warnings.size(), 2U);
  EXPECT_NE(factors.warnings[1].find("nothing measures thigh"), std::string::npos);
}

TEST(ScaleFactors, RangeReachesFromTheRowBeforeToTheRowAfter) {
  const std::vector<double> time = {0.0, 0.1, 0.2, 0.3, 0.4};
  const FrameRange between = findFrameRange(time, {0.15, 0.25});
  EXPECT_EQ(between.first, 1);
  EXPECT_EQ(between.last, 3);
  const FrameRange on = findFrameRange(time, {0.1, 0.3});
  EXPECT_EQ(on.first, 1);
  EXPECT_EQ(on.last, 3);
  const FrameRange all = findFrameRange(time, {});
  EXPECT_EQ(all.first, 0);
  EXPECT_EQ(all.last, 4);
  EXPECT_THROW(findFrameRange(time, {1, 2}), Error);
}

TEST(ScaleFactors, UnusualFactorIsAWarning) {
  const ScaleFactors factors = calcScaleFactors(Model(makeModel()), makeTrial(1.5), makeOptions());
  ASSERT_EQ(factors.warnings.size(), 1U);
  EXPECT_NE(factors.warnings[0].find("'thigh'"), std::string::npos);
}

TEST(ScaleFactors, FirstAlternativeThatIsPlausibleCounts) {
  const Model model(makeModel());
  ScaleOptions options = makeOptions();
  options.marker_set.measurements[0].alternative_of = "size";
  options.marker_set.measurements[0].min_factor = 0.7;
  options.marker_set.measurements[0].max_factor = 1.4;
  options.marker_set.measurements.push_back(makeWidth());
  options.marker_set.measurements[1].alternative_of = "size";
  const ScaleFactors first = calcScaleFactors(model, makeTrial(1.1), options);
  EXPECT_EQ(first.measurements[0].use, MeasurementUse::kApplied);
  EXPECT_EQ(first.measurements[1].use, MeasurementUse::kNotNeeded);
  EXPECT_NEAR(first.bodies[0].factors.y(), 1.1, tol(1e-12));
  EXPECT_EQ(first.bodies[0].factors.z(), 1.0);

  MarkerTrajectories wrong = makeTrial(1.1);
  wrong.positions.col(4) *= 2;
  const ScaleFactors second = calcScaleFactors(model, wrong, options);
  EXPECT_EQ(second.measurements[0].use, MeasurementUse::kRefused);
  EXPECT_EQ(second.measurements[1].use, MeasurementUse::kApplied);
  EXPECT_EQ(second.bodies[0].factors.y(), 1.0);
  EXPECT_NEAR(second.bodies[0].factors.z(), 1.1, tol(1e-12));
  ASSERT_FALSE(second.warnings.empty());
  EXPECT_NE(second.warnings[0].find("A to B 88.0 cm against 40.0 cm"), std::string::npos)
      << second.warnings[0];
}

TEST(ScaleFactors, FactorIsLimitedBesideAnother) {
  const Model model(makeModel());
  ScaleOptions options = makeOptions();
  options.marker_set.measurements.push_back(makeWidth());
  options.marker_set.measurements[1].limit = FactorLimit{"length", 0.9, 1.15};
  MarkerTrajectories sole = makeTrial(1.1);
  sole.positions.col(8).setConstant(0.2 * 1.6);
  const ScaleFactors limited = calcScaleFactors(model, sole, options);
  EXPECT_EQ(limited.measurements[1].use, MeasurementUse::kLimited);
  EXPECT_NEAR(limited.bodies[0].factors.z(), 1.15 * 1.1, tol(1e-12));
  sole.positions.col(8).setConstant(0.2 * 1.2);
  const ScaleFactors within = calcScaleFactors(model, sole, options);
  EXPECT_EQ(within.measurements[1].use, MeasurementUse::kApplied);
  EXPECT_NEAR(within.bodies[0].factors.z(), 1.2, tol(1e-12));
}

TEST(ScaleFactors, WhatNothingMeasuresTakesTheSizeRatioAndIsNamed) {
  const Model model(makeModel());
  ScaleOptions options = makeOptions();
  options.marker_set.size_ratio = 1.05;
  options.marker_set.measurements[0].required = false;
  options.marker_set.measurements[0].pairs[0].second = "nowhere";
  MarkerTrajectories trial = makeTrial(1.1);
  const ScaleFactors factors = calcScaleFactors(model, trial, options);
  EXPECT_EQ(factors.measurements[0].use, MeasurementUse::kUnmeasured);
  EXPECT_EQ(factors.bodies[0].factors, Eigen::Vector3d::Constant(1.05));
  ASSERT_EQ(factors.warnings.size(), 2U);
  EXPECT_NE(factors.warnings[1].find("nothing measures thigh: scaled by 1.050"), std::string::npos);
}

}  // namespace
}  // namespace gaitmill
