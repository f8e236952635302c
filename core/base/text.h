#pragma once

#include <string>

namespace gaitmill {

/// A number for people, for instance formatFixed(1.0386, 1) = "1.0"; the decimal point whatever the
/// locale. "nan" and "inf" as such. For files use formatNumber of core/io, which loses nothing.
std::string formatFixed(double value, int decimals);

}  // namespace gaitmill
