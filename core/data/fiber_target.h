#pragma once

#include <limits>
#include <string>

namespace gaitmill {

/// Fiber length that a muscle shall have in the pose in which its tendon is calibrated: one of the
/// two lengths is known, the other NaN.
struct FiberTarget {
  std::string muscle;  ///< "soleus_r", or "soleus" for both sides
  double norm_fiber_length = std::numeric_limits<double>::quiet_NaN();  ///< over l0M [-] > 0
  double fiber_length = std::numeric_limits<double>::quiet_NaN();       ///< [m] > 0
  int line = 0;  ///< of the file that states it, 0 = none
};

}  // namespace gaitmill
