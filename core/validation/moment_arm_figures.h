#pragma once

#include <string>

#include "core/data/figure.h"
#include "core/data/model_spec.h"

namespace gaitmill {

/// Joint of a figure of moment arms.
enum class ArmJoint { kHip, kKnee, kAnkle };

/// Moment arms -dl/dq [cm] against a joint angle [deg], the patella moving with the knee: the
/// panels, muscles, ranges and ordinates of Supplemental Figures 1 (knee, ankle) and 2 (hip) of
/// Rajagopal et al. (2016), right side, angles not named at 0 (spec/paper_metrics.md G). Muscles
/// and coordinates that the model lacks are left out.
Figure makeMomentArmFigure(const ModelSpec& model, ArmJoint joint);

/// Whether at least one panel can be drawn.
bool hasMomentArmFigure(const ModelSpec& model, ArmJoint joint);

}  // namespace gaitmill
