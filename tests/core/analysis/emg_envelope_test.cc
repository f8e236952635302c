#include "core/analysis/emg_envelope.h"

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/io/emg_reader.h"
#include "core/io/files.h"
#include "tests/support/shared_data.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr double kRate = 2000;  // [Hz]

TimeSeries makeRecording(int rows, double rate = kRate) {
  std::vector<double> time;
  for (int i = 0; i < rows; ++i) {
    time.push_back(1.0 + i / rate);
  }
  TimeSeries recording = makeTimeSeries("emg", {"SOL"}, time);
  recording.values.setZero();
  return recording;
}

TimeSeries makeSine(double frequency, int rows = 8000, double rate = kRate) {
  TimeSeries recording = makeRecording(rows, rate);
  for (int i = 0; i < rows; ++i) {
    recording.values(i, 0) = std::sin(2 * kPi * frequency * i / rate);
  }
  return recording;
}

/// Noise in two bursts, as muscles give it.
TimeSeries makeBursts(unsigned seed) {
  TimeSeries recording = makeRecording(4000);
  std::mt19937 generator(seed);
  std::normal_distribution<double> noise(0, 1e-3);
  for (int i = 0; i < 4000; ++i) {
    recording.values(i, 0) = noise(generator) * (1 + std::cos(2 * kPi * i / 2000.0));
  }
  return recording;
}

double calcMiddle(const TimeSeries& envelopes) {
  return envelopes.values.middleRows(envelopes.rowCount() / 2 - 200, 400).mean();
}

// A rectified sine has the mean 2/pi of its amplitude, which is what the low-passes leave; the
// zero-phase band-pass keeps 1 in the middle of the band, half at its edges, where the pre-warped
// band ends exactly, and (1 + r^12)^-1 below them for a design of order 6, r being the distance of
// the analog frequency from the centre in units of the band: here |w^2 - w1 w2| / (w (w2 - w1)).
TEST(EmgEnvelope, FrequencyResponseIsTheBandPassDesigned) {
  const auto warp = [](double frequency) {
    return std::tan(kPi * frequency / kRate);
  };
  for (const double frequency : {31.0, 41.3, 50.0, 61.7, 103.0, 211.0, 497.3, 613.0}) {
    const double w = warp(frequency);
    const double r = std::abs(w * w - warp(50) * warp(500)) / (w * (warp(500) - warp(50)));
    const double gain = 1 / (1 + std::pow(r, 12));
    const EmgEnvelopes result = calcEmgEnvelopes(makeSine(frequency), EmgSource::kRaw, {});
    EXPECT_NEAR(calcMiddle(result.envelopes), gain * 2 / kPi, tol(1e-3)) << frequency;
  }
}

TEST(EmgEnvelope, CriticallyDampedStepRisesWithoutOvershoot) {
  TimeSeries step = makeRecording(2000);
  step.values.bottomRows(1000).setConstant(2.0);
  EmgOptions options;
  options.band_pass.reset();
  options.butterworth.reset();
  const TimeSeries response = calcEmgEnvelopes(step, EmgSource::kRaw, options).envelopes;
  for (int i = 1; i < 2000; ++i) {
    EXPECT_GE(response.values(i, 0), response.values(i - 1, 0) - tol(1e-12)) << i;
  }
  EXPECT_NEAR(response.values(0, 0), 0.0, tol(1e-9));
  EXPECT_NEAR(response.values(1999, 0), 2.0, tol(1e-9));
  // Zero lag: half the step where the step is, between samples 999 and 1000.
  EXPECT_NEAR(0.5 * (response.values(999, 0) + response.values(1000, 0)), 1.0, tol(1e-9));
}

TEST(EmgEnvelope, ScalesWithTheSignalAndNotWithItsSign) {
  const TimeSeries recording = makeBursts(3);
  TimeSeries scaled = recording;
  scaled.values *= -7.0;
  const RowMatrix one = calcEmgEnvelopes(recording, EmgSource::kRaw, {}).envelopes.values;
  const RowMatrix seven = calcEmgEnvelopes(scaled, EmgSource::kRaw, {}).envelopes.values;
  EXPECT_LE((seven - 7.0 * one).cwiseAbs().maxCoeff(), tol(1e-14));
}

TEST(EmgEnvelope, AnOffsetOfTheAmplifierChangesNothing) {
  const TimeSeries recording = makeBursts(4);
  TimeSeries shifted = recording;
  shifted.values.array() += 0.5;
  const RowMatrix without = calcEmgEnvelopes(recording, EmgSource::kRaw, {}).envelopes.values;
  const RowMatrix with = calcEmgEnvelopes(shifted, EmgSource::kRaw, {}).envelopes.values;
  EXPECT_LE((without - with).cwiseAbs().maxCoeff(), tol(1e-12));
}

TEST(EmgEnvelope, BackwardInTimeIsTheEnvelopeBackward) {
  const TimeSeries recording = makeBursts(5);
  TimeSeries reversed = recording;
  reversed.values = recording.values.colwise().reverse().eval();
  const RowMatrix one = calcEmgEnvelopes(recording, EmgSource::kRaw, {}).envelopes.values;
  const RowMatrix two = calcEmgEnvelopes(reversed, EmgSource::kRaw, {}).envelopes.values;
  const RowMatrix difference = one - two.colwise().reverse();
  // Passes differ in order only, away from the ends, where each starts from another guess.
  EXPECT_LE(difference.middleRows(1950, 100).cwiseAbs().maxCoeff(), tol(1e-9));
}

TEST(EmgEnvelope, EnvelopesComeBackAsTheyAre) {
  const TimeSeries recording = makeBursts(6);
  const EmgEnvelopes result = calcEmgEnvelopes(recording, EmgSource::kEnvelope, {});
  EXPECT_EQ(result.envelopes.values, recording.values);
  EXPECT_EQ(result.source, EmgSource::kEnvelope);
}

TEST(EmgEnvelope, TheBandEndsBelowHalfTheRate) {
  const EmgEnvelopes result = calcEmgEnvelopes(makeSine(100, 2000, 960), EmgSource::kRaw, {});
  EXPECT_NEAR(result.used.band_pass->high, 432.0, tol(1e-6));
  EXPECT_EQ(result.used.band_pass->low, 50.0);
}

TEST(EmgEnvelope, RefusesWhatItCannotFilter) {
  EXPECT_THROW(calcEmgEnvelopes(makeSine(10, 500, 100), EmgSource::kRaw, {}), Error);
  TimeSeries uneven = makeSine(100);
  for (std::size_t i = 4000; i < uneven.time.size(); ++i) {
    uneven.time[i] += 0.01;
  }
  EXPECT_THROW(calcEmgEnvelopes(uneven, EmgSource::kRaw, {}), Error);
  EXPECT_THROW(calcEmgEnvelopes(makeRecording(1), EmgSource::kAuto, {}), Error);
}

TEST(EmgEnvelope, MissingSamplesStayMissingAndSpoilNothingElse) {
  TimeSeries recording = makeBursts(7);
  const RowMatrix whole = calcEmgEnvelopes(recording, EmgSource::kRaw, {}).envelopes.values;
  recording.values(2000, 0) = std::numeric_limits<double>::quiet_NaN();
  recording.values(3999, 0) = std::numeric_limits<double>::infinity();
  const RowMatrix holed = calcEmgEnvelopes(recording, EmgSource::kRaw, {}).envelopes.values;
  EXPECT_TRUE(std::isnan(holed(2000, 0)));
  EXPECT_TRUE(std::isnan(holed(3999, 0)));
  EXPECT_TRUE(holed.topRows(2000).allFinite());
  EXPECT_LE((holed - whole).topRows(1000).cwiseAbs().maxCoeff(), tol(1e-5));
}

TEST(EmgEnvelope, AChannelWithoutValuesOrBeyondAllNumbersIsMissing) {
  TimeSeries recording = makeTimeSeries("emg", {"none", "huge"}, makeRecording(1000).time);
  for (int i = 0; i < 1000; ++i) {
    recording.values(i, 1) = i % 2 == 0 ? 1.7e308 : -1.7e308;
  }
  const RowMatrix values = calcEmgEnvelopes(recording, EmgSource::kRaw, {}).envelopes.values;
  EXPECT_TRUE(values.col(0).array().isNaN().all());
  EXPECT_FALSE((values.col(1).array().abs() == std::numeric_limits<double>::infinity()).any());
}

TEST(EmgSourceDecision, NoiseIsRawAndSmoothCurvesAreNot) {
  EXPECT_EQ(findEmgSource(makeBursts(8)), EmgSource::kRaw);
  EXPECT_EQ(findEmgSource(makeSine(3)), EmgSource::kEnvelope);
  EXPECT_EQ(findEmgSource(makeSine(40, 1000, 150)), EmgSource::kEnvelope);
  EXPECT_EQ(findEmgSource(makeRecording(100)), EmgSource::kEnvelope);
}

class PublishedEnvelopes : public SharedDataTest {
 protected:
  TimeSeries read(const std::string& relative) const {
    return readEmg(readFile(shared("data/" + relative)), relative).signals;
  }
};

TEST_F(PublishedEnvelopes, AllFilesAreTakenForWhatTheyAre) {
  EXPECT_EQ(findEmgSource(read("walk/emg_walk_raw.anc")), EmgSource::kRaw);
  EXPECT_EQ(findEmgSource(read("walk/emg_walk.txt")), EmgSource::kEnvelope);
  EXPECT_EQ(findEmgSource(read("walk/example3DWalking/electromyography.sto")),
            EmgSource::kEnvelope);
  EXPECT_EQ(findEmgSource(read("run/paper_subject01/emg_run_raw.csv")), EmgSource::kRaw);
  EXPECT_EQ(findEmgSource(read("run/paper_subject01/emg_run.txt")), EmgSource::kEnvelope);
}

// spec/signal.md 3.1 states six printed decimals for SOL, TA and GMAX; all ten channels have them.
// The last two published rows are zero.
TEST_F(PublishedEnvelopes, OfTheWalkingTrialComeOutOfItsCounts) {
  EmgOptions options;
  options.ends = EdgeTreatment::kZeroStart;
  const TimeSeries ours =
      calcEmgEnvelopes(read("walk/emg_walk_raw.anc"), EmgSource::kAuto, options).envelopes;
  const TimeSeries published = read("walk/emg_walk.txt");
  const Eigen::Index rows = published.rowCount() - 2;
  for (const std::string& channel : published.labels) {
    const double difference = (ours.values.col(ours.getColumn(channel)).topRows(rows) -
                               published.values.col(published.getColumn(channel)).topRows(rows))
                                  .cwiseAbs()
                                  .maxCoeff();
    EXPECT_LE(difference, tol(0.51e-6)) << channel;
  }
  EXPECT_NEAR(ours.values.col(ours.getColumn("SOL")).maxCoeff(), 0.060667, tol(0.51e-6));
  EXPECT_NEAR(ours.values.col(ours.getColumn("TA")).maxCoeff(), 0.11696, tol(5.1e-6));
  EXPECT_NEAR(ours.values.col(ours.getColumn("GMAX")).maxCoeff(), 0.003542, tol(0.51e-6));
}

}  // namespace
}  // namespace gaitmill
