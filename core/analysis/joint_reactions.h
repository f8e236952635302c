#pragma once

#include "core/analysis/force_record.h"
#include "core/data/time_series.h"
#include "core/model/model.h"

namespace gaitmill {

/// Load that every joint transmits to its child body, on the rows of the record (spec/so.md 2):
///   <joint>_on_<child>_in_<frame>_fx..fz  force                                               [N]
///   ..._mx..mz                            moment about the child's joint frame's origin [N.m]
///   ..._px..pz                            that origin                                         [m]
/// for frame = the child's own axes (from the body's origin), then "ground". By recursive
/// Newton-Euler from the tips, with the accelerations that the recorded forces give. What
/// generalized forces, couplers and locks do across a joint is part of its load; muscles, as
/// tensions along their paths, are not, but load every joint that they span. The patella hangs on
/// the femur, so the patellofemoral load holds the quadriceps' pull around it, and the tibiofemoral
/// one (walker_knee) is what the femur puts on the tibia.
/// @throws Error kTableUnknownLabel
TimeSeries calcJointReactions(const Model& model, const ForceRecord& record);

}  // namespace gaitmill
