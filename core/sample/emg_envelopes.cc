#include "core/sample/emg_envelopes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/base/units.h"

namespace gaitmill {

namespace {

constexpr double kFloor = 0.02;

// One burst: centre and half width in percent of the gait cycle, height.
struct Burst {
  const char* channel;
  double center;
  double half_width;
  double height;
};

// Phases: extensors and abductors after heel strike, plantarflexors before toe-off, hamstrings at
// the end of swing, tibialis anterior at heel strike and in swing (the qualitative facts of
// spec/paper_metrics.md D6).
constexpr std::array<Burst, 15> kBursts = {{{"SOL", 42, 24, 1.0},
                                            {"GAS", 40, 22, 1.0},
                                            {"TA", 2, 14, 1.0},
                                            {"TA", 72, 18, 0.6},
                                            {"MH", 94, 16, 1.0},
                                            {"MH", 6, 12, 0.5},
                                            {"BF", 93, 17, 1.0},
                                            {"BF", 7, 12, 0.5},
                                            {"VL", 8, 16, 1.0},
                                            {"VM", 8, 16, 1.0},
                                            {"RF", 8, 14, 0.8},
                                            {"RF", 62, 12, 1.0},
                                            {"GMAX", 6, 17, 1.0},
                                            {"GMED", 12, 22, 1.0},
                                            {"GMED", 36, 14, 0.4}}};

// Height of a burst at a phase, both in percent; the nearest of its repetitions counts.
double calcBump(const Burst& burst, double percent) {
  const double distance = std::abs(std::remainder(percent - burst.center, 100.0));
  if (distance >= burst.half_width) {
    return 0;
  }
  const double c = std::cos(0.5 * kPi * distance / burst.half_width);
  return burst.height * c * c;
}

}  // namespace

TimeSeries makeEmgEnvelopes(const std::vector<double>& time, double period) {
  std::vector<std::string> channels;
  for (const Burst& burst : kBursts) {
    if (channels.empty() || channels.back() != burst.channel) {
      channels.emplace_back(burst.channel);
    }
  }
  TimeSeries emg = makeTimeSeries("emg", channels, time);
  emg.units.assign(channels.size(), "");
  emg.values.setZero();
  for (int row = 0; row < emg.rowCount(); ++row) {
    const double percent = 100.0 * time[static_cast<std::size_t>(row)] / period;
    for (const Burst& burst : kBursts) {
      double& value = emg.values(row, emg.getColumn(burst.channel));
      value = std::max(std::max(value, kFloor), calcBump(burst, percent));
    }
  }
  return emg;
}

}  // namespace gaitmill
