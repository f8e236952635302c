#pragma once

namespace gaitmill {

/// A test tolerance. GAITMILL_TOLERANCE_SCALE multiplies all of them: 0 shows the true margins,
/// since every comparison then fails and prints its difference.
double tol(double value);

}  // namespace gaitmill
