#pragma once

#include <string>
#include <vector>

#include "core/base/index.h"
#include "core/data/model_spec.h"

namespace gaitmill {

// Figures of a model show its right leg: muscle and coordinate names of the field end in _r there.

/// Muscle "<base>_r" of the model, invalid if there is none.
MuscleIndex findRightMuscle(const ModelSpec& model, const std::string& base);

/// Those of `bases` that the model has, in that order.
std::vector<MuscleIndex> findRightMuscles(const ModelSpec& model,
                                          const std::vector<std::string>& bases);

/// Coordinate "<base>_r" of the model; null if there is none, or a coupler drives it.
const CoordinateSpec* findRightCoordinate(const ModelSpec& model, const std::string& base);

/// Angles of a coordinate from `low` to `high` in steps of about one degree [rad], cut to the
/// coordinate's range where that is clamped; empty if nothing remains.
std::vector<double> makeSweep(const CoordinateSpec& coordinate, double low_deg, double high_deg);

}  // namespace gaitmill
