#include "core/validation/side.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace gaitmill {

MuscleIndex findRightMuscle(const ModelSpec& model, const std::string& base) {
  return MuscleIndex(model.findMuscle(base + "_r"));
}

std::vector<MuscleIndex> findRightMuscles(const ModelSpec& model,
                                          const std::vector<std::string>& bases) {
  std::vector<MuscleIndex> muscles;
  for (const std::string& base : bases) {
    const MuscleIndex muscle = findRightMuscle(model, base);
    if (muscle.isValid()) {
      muscles.push_back(muscle);
    }
  }
  return muscles;
}

const CoordinateSpec* findRightCoordinate(const ModelSpec& model, const std::string& base) {
  const std::string name = base + "_r";
  const bool is_driven = std::any_of(
      model.couplers.begin(), model.couplers.end(), [&name](const CouplerSpec& coupler) {
        return coupler.enforced && coupler.dependent == name;
      });
  return is_driven ? nullptr : model.findCoordinate(name);
}

std::vector<double> makeSweep(const CoordinateSpec& coordinate, double low_deg, double high_deg) {
  double low = toRadians(low_deg);
  double high = toRadians(high_deg);
  if (coordinate.clamped) {
    low = std::max(low, coordinate.range_min);
    high = std::min(high, coordinate.range_max);
  }
  std::vector<double> sweep;
  if (low < high) {
    const int steps = std::max(1, static_cast<int>(std::lround(toDegrees(high - low))));
    for (int i = 0; i <= steps; ++i) {
      sweep.push_back(low + (high - low) * i / steps);
    }
  }
  return sweep;
}

}  // namespace gaitmill
