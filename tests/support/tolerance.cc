#include "tests/support/tolerance.h"

#include <cstdlib>

namespace gaitmill {

double tol(double value) {
  static const double scale = [] {
    const char* text = std::getenv("GAITMILL_TOLERANCE_SCALE");
    return text == nullptr ? 1.0 : std::atof(text);
  }();
  return scale * value;
}

}  // namespace gaitmill
