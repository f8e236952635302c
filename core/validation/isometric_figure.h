#pragma once

#include "core/data/figure.h"
#include "core/data/model_spec.h"

namespace gaitmill {

/// Maximum isometric and passive joint moments against joint angle in the poses of Supplemental
/// Figure 3 of Rajagopal et al. (2016), right leg (spec/paper_metrics.md H). The agonists of a
/// moment, the muscles whose arm has its sign at that angle, are at activation 1 with fiber and
/// tendon in equilibrium; the others add their passive force. Passive moments are those of the
/// stretched fibers at the lowest activation. Panels whose coordinates the model lacks are left
/// out.
Figure makeIsometricFigure(const ModelSpec& model);

/// Whether at least one panel can be drawn.
bool hasIsometricFigure(const ModelSpec& model);

}  // namespace gaitmill
