#pragma once

#include "core/data/figure.h"
#include "core/data/model_spec.h"
#include "core/validation/validation.h"

namespace gaitmill {

/// Table II of Rajagopal et al. (2016) as bars: maximum isometric force, optimal fiber length,
/// tendon slack length and pennation of the right leg's muscles beside the printed values. Models
/// without right leg: all their muscles. Needs at least one muscle.
Figure makeParameterFigure(const ModelSpec& model);

/// Supplemental Table I: printed standard deviations beside those recomputed by the paper's
/// formulas and Monte Carlo (core/validation/variability.h), and the inputs inferred for them.
Figure makeVariabilityFigure(const ModelSpec& model, const ValidationOptions& options);

/// Whether the model has muscles of the table, and a leg to pose.
bool hasVariabilityFigure(const ModelSpec& model);

}  // namespace gaitmill
