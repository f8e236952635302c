#pragma once

#include "core/data/figure.h"
#include "core/data/model_spec.h"

namespace gaitmill {

/// Normalised fiber lengths of the right leg over one cycle of the embedded walking pattern
/// (core/sample/gait_pattern.h), every muscle in static equilibrium at 1 % activation: what the
/// posture alone does to the fibers. One panel per group of muscles.
Figure makeFiberLengthFigure(const ModelSpec& model);

/// Whether the model has muscles on the right and the coordinates of the walking pattern.
bool hasFiberLengthFigure(const ModelSpec& model);

}  // namespace gaitmill
