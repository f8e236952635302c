#pragma once

#include "core/base/index.h"
#include "core/data/figure.h"
#include "core/data/model_spec.h"

namespace gaitmill {

/// Figure 3 of Rajagopal et al. (2016): active and passive fiber force against length, force
/// against velocity, tendon force against strain, all normalised, as most muscles of the model have
/// them. Needs at least one muscle.
Figure makeForceLengthVelocityFigure(const ModelSpec& model);

/// The same curves of one muscle in newtons and metres, and its force at rest against path length
/// with the tendon in equilibrium. Named "muscle_curves_<muscle>".
Figure makeMuscleCurvesFigure(const ModelSpec& model, MuscleIndex muscle);

}  // namespace gaitmill
