#include "core/math/filters.h"

#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/shared_data.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

RowMatrix makeSine(double frequency, double rate, int rows) {
  RowMatrix wave(rows, 1);
  for (int i = 0; i < rows; ++i) wave(i, 0) = std::sin(2 * kPi * frequency * i / rate);
  return wave;
}

// Amplitude of the middle of a filtered sine.
double calcGain(const FilterCascade& filter, double frequency, double rate) {
  RowMatrix wave = makeSine(frequency, rate, 4000);
  filterZeroPhase(filter, wave);
  return wave.middleRows(1500, 1000).cwiseAbs().maxCoeff();
}

TEST(Butterworth, LowPassIsSixDecibelsDownAtTheSinglePassCutoff) {
  EXPECT_NEAR(calcGain(makeButterworthLowPass(4, 6, 100), 6, 100), 0.5, tol(1e-2));
  EXPECT_NEAR(calcGain(makeButterworthLowPass(3, 6, 1000), 6, 1000), 0.5, tol(1e-4));
}

TEST(Butterworth, CorrectedLowPassIsThreeDecibelsDown) {
  const auto filter = makeButterworthLowPass(2, 6, 1000, CutoffMeaning::kBothPasses);
  EXPECT_NEAR(calcGain(filter, 6, 1000), std::sqrt(0.5), tol(1e-4));
}

TEST(Butterworth, BandPassKeepsTheCenterAndHalvesTheEdges) {
  for (const int order : {3, 6}) {
    const auto filter = makeButterworthBandPass(order, 50, 500, 2000);
    const double center =
        std::atan(std::sqrt(std::tan(kPi * 50 / 2000) * std::tan(kPi * 500 / 2000))) * 2000 / kPi;
    EXPECT_NEAR(calcGain(filter, center, 2000), 1.0, tol(2e-3));
    EXPECT_NEAR(calcGain(filter, 50, 2000), 0.5, tol(1e-3));
    EXPECT_NEAR(calcGain(filter, 500, 2000), 0.5, tol(1e-3));
  }
}

TEST(Butterworth, HasNoPhaseAndKeepsAStraightLine) {
  RowMatrix line(400, 1);
  for (int i = 0; i < 400; ++i) line(i, 0) = 3 - 0.5 * i;
  const RowMatrix before = line;
  filterZeroPhase(makeButterworthLowPass(4, 6, 100), line);
  // Away from the ends, where a pass starts as if the line had been level.
  EXPECT_LE((line - before).middleRows(150, 100).cwiseAbs().maxCoeff(), tol(1e-9));
}

TEST(Butterworth, RefusesCutoffsBeyondTheNyquistFrequency) {
  EXPECT_THROW(makeButterworthLowPass(2, 50, 100), Error);
  EXPECT_THROW(makeButterworthBandPass(2, 30, 20, 100), Error);
  EXPECT_THROW(makeButterworthBandPass(6, 50, 500, 960), Error);
}

TEST(CriticallyDamped, IsThreeDecibelsDownAfterAllPasses) {
  for (const int passes : {2, 4}) {
    RowMatrix wave = makeSine(6, 1000, 4000);
    filterCriticallyDamped(passes, 6, 1000, EdgeTreatment::kReflected, wave);
    EXPECT_NEAR(wave.middleRows(1500, 1000).maxCoeff(), std::sqrt(0.5), tol(1e-3)) << passes;
  }
}

TEST(CriticallyDamped, StepHasNoOvershoot) {
  RowMatrix step = RowMatrix::Zero(1000, 1);
  step.bottomRows(500).setOnes();
  filterCriticallyDamped(2, 6, 1000, EdgeTreatment::kReflected, step);
  EXPECT_LE(step.maxCoeff(), 1 + tol(1e-12));
  EXPECT_GE(step.minCoeff(), -tol(1e-12));
}

// The trial's analog file: tab-separated counts, names and full scales [mV] above them.
struct AnalogFile {
  std::vector<std::string> names;
  std::vector<double> range;
  RowMatrix counts;

  RowMatrix volts(const std::string& name) const {
    const auto found = std::find(names.begin(), names.end(), name);
    const auto column = found - names.begin();
    return counts.col(column) * (2e-3 * range[static_cast<std::size_t>(column)] / 65536.0);
  }
};

AnalogFile readAnalogFile(const std::string& path) {
  AnalogFile file;
  std::ifstream stream(path);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream cells(line);
    std::string head;
    cells >> head;
    if (head == "Name") {
      for (std::string name; cells >> name;) file.names.push_back(name);
    } else if (head == "Range") {
      for (double range = 0; cells >> range;) file.range.push_back(range);
    } else if (!file.range.empty()) {
      rows.emplace_back();
      for (double count = 0; cells >> count;) rows.back().push_back(count);
      if (rows.back().empty()) rows.pop_back();
    }
  }
  file.counts.resize(static_cast<Eigen::Index>(rows.size()),
                     static_cast<Eigen::Index>(file.names.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    file.counts.row(static_cast<Eigen::Index>(i)) =
        Eigen::Map<Eigen::RowVectorXd>(rows[i].data(), file.counts.cols());
  }
  return file;
}

RowMatrix readNumbers(const std::string& path, int header_lines) {
  std::ifstream stream(path);
  std::string line;
  for (int i = 0; i < header_lines; ++i) std::getline(stream, line);
  std::vector<double> numbers;
  Eigen::Index rows = 0;
  while (std::getline(stream, line)) {
    std::istringstream cells(line);
    const std::size_t before = numbers.size();
    for (double number = 0; cells >> number;) numbers.push_back(number);
    if (numbers.size() > before) ++rows;
  }
  return Eigen::Map<RowMatrix>(
      numbers.data(), rows, static_cast<Eigen::Index>(numbers.size()) / rows);
}

using PublishedChains = SharedDataTest;

// Band-pass 50-500 Hz of design order 6, rectified, low-pass order 4 at 7.5 Hz, critically damped
// over four passes at 15 Hz (spec/signal.md 3.1); printed with six decimals.
TEST_F(PublishedChains, EmgEnvelopesOfTheWalkingTrial) {
  const AnalogFile raw = readAnalogFile(shared("data/walk/emg_walk_raw.anc"));
  const RowMatrix published = readNumbers(shared("data/walk/emg_walk.txt"), 1);
  const struct {
    const char* name;
    int column;
    double peak;
  } channels[] = {{"SOL", 1, 0.060667}, {"TA", 3, 0.11696}, {"GMAX", 9, 0.003542}};
  for (const auto& channel : channels) {
    RowMatrix signal = raw.volts(channel.name);
    filterZeroPhase(makeButterworthBandPass(6, 50, 500, 2000), signal);
    signal = signal.cwiseAbs();
    filterZeroPhase(makeButterworthLowPass(4, 7.5, 2000), signal);
    filterCriticallyDamped(4, 15, 2000, EdgeTreatment::kZeroStart, signal);
    EXPECT_NEAR(signal.maxCoeff(), channel.peak, tol(5.1e-6)) << channel.name;
    const Eigen::Index rows = published.rows() - 2;  // the last two published rows are zero
    const double worst =
        (signal.topRows(rows) - published.topRows(rows).col(channel.column)).cwiseAbs().maxCoeff();
    EXPECT_LE(worst, tol(0.51e-6)) << channel.name;
  }
}

// Plate 3 alone carries the right foot's second contact: volts, filter, gain, turned up.
TEST_F(PublishedChains, VerticalForceOfTheWalkingTrial) {
  const AnalogFile raw = readAnalogFile(shared("data/walk/emg_walk_raw.anc"));
  const RowMatrix published = readNumbers(shared("data/walk/grf_walk.mot"), 7);
  RowMatrix vertical = 2000 * (raw.volts("F1Z") + raw.volts("F3Z"));
  filterCriticallyDamped(2, 6, 2000, EdgeTreatment::kZeroStart, vertical);
  // The file starts and ends within the record: rows correspond one to one.
  double worst = 0;
  for (Eigen::Index i = 0; i < published.rows(); ++i) {
    if (published(i, 2) > 5) worst = std::max(worst, std::abs(published(i, 2) - vertical(i, 0)));
  }
  EXPECT_LE(worst, tol(1e-5));
}

}  // namespace
}  // namespace gaitmill
