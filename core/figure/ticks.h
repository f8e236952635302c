#pragma once

#include <string>
#include <vector>

#include "core/data/figure.h"

namespace gaitmill {

/// The ends of an axis, low < high.
struct Range {
  double low = 0;
  double high = 1;
};

/// What an axis has to hold: its fixed ends, else the ends of the data with a little air, at round
/// numbers. A single value gets room around it.
/// @param ticks  how many are wanted, about
Range findRange(const Axis& axis, double data_low, double data_high, int ticks);

/// Round numbers in the range: multiples of 1, 2, 2.5 or 5 times a power of ten; multiples of 15,
/// 30 or 45 for degrees would be rounder, but not for small angles.
std::vector<double> makeTicks(const Range& range, int ticks);

/// How many decimals tell the ticks apart: 2 for 0, 0.25, 0.5.
int countDecimals(const std::vector<double>& ticks);

/// Tick labels with just these decimals: "0.25", "1200".
std::vector<std::string> labelTicks(const std::vector<double>& ticks);

/// "Gait cycle [%]", "Activation".
std::string makeAxisTitle(const Axis& axis);

/// What the series and horizontal guides of a panel reach; {0, 1} without any number.
Range findDataX(const Panel& panel);
Range findDataY(const Panel& panel);

}  // namespace gaitmill
