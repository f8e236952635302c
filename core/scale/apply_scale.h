#pragma once

#include <vector>

#include "core/data/model_spec.h"
#include "core/scale/scale_result.h"

namespace gaitmill {

/// Whether bodies keep their mass when they change their size, or their density.
enum class MassDistribution { kPreserved, kFollowsVolume };

/// A model whose bodies are stretched along their own axes (spec/scale.md 2 and 3): everything that
/// is fixed in a body moves with it; translation functions of a custom joint are multiplied by the
/// parent body's factors along their axis; wrap cylinders take the mean of their two radial
/// factors; a body stretched unevenly takes the inertia of a stretched solid cylinder; optimal
/// fiber and tendon slack lengths follow the length of their path in the default pose. Maximal
/// forces, pennation, curves, ranges, default values, stiffnesses and damping stay.
/// @param factors  bodies that are not named keep their size
/// @throws Error kModelReference for an unknown body, kModelUnsupported for a coupler that drives a
///   translation (its scale would be ambiguous)
ModelSpec applyScaleFactors(const ModelSpec& generic,
                            const std::vector<BodyScale>& factors,
                            MassDistribution distribution);

}  // namespace gaitmill
