#pragma once

#include <string>

namespace gaitmill {

/// The value with this many significant digits, as a double with few decimals.
double roundSignificant(double value, int digits);

/// A number for people with three significant digits: "0.0123", "12.3", "1230".
std::string formatShort(double value);

}  // namespace gaitmill
