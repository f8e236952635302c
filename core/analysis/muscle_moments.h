#pragma once

#include <string>
#include <vector>

#include "core/data/time_series.h"
#include "core/model/model.h"

namespace gaitmill {

/// Net moments of all muscles on chosen coordinates over time:
///   m_c(t) = sum_i r_ic(q(t)) f_i(t)                                                       [N.m]
/// with r the moment arms at the pose, the patella's arm counted with the knee's, and f the tendon
/// forces. Rows are those of `tendon_forces`; the pose is read from `pose` by linear interpolation.
/// @param pose           columns = model coordinates [rad|m]; absent ones keep their default value
/// @param tendon_forces  columns = muscles of the model [N]; others are ignored
/// @param coordinates    columns of the result, in this order; none may be locked or dependent
/// @throws Error kInputCoordinates for an unknown or dependent coordinate, kTableNoRows
TimeSeries calcMuscleMoments(const Model& model,
                             const TimeSeries& pose,
                             const TimeSeries& tendon_forces,
                             const std::vector<std::string>& coordinates);

}  // namespace gaitmill
