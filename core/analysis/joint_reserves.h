#pragma once

#include <string>
#include <vector>

#include "core/analysis/actuator_statistics.h"
#include "core/data/model_spec.h"
#include "core/data/time_series.h"

namespace gaitmill {

/// The reserve actuators of one joint against the joint's own moments.
struct JointReserve {
  std::string joint;     ///< "hip_r"
  std::string actuator;  ///< with the largest peak of this joint
  double peak = 0;       ///< of that actuator [N.m]
  double joint_moment;   ///< largest moment of inverse dynamics about any axis of the joint [N.m]
};

/// One entry per joint that has reserves, in the order of their first actuator. Axes of a joint
/// count together: what turns the thigh about its own axis is small beside what carries the body,
/// and a percentage of it would say little. Joints whose moment is not known are left out.
/// @param reserves  statistics of the actuators in `specs` that act on coordinates
/// @param moments   inverse dynamics, columns "<coordinate>_moment" [N.m]
/// @throws Error kTableNoRows
std::vector<JointReserve> calcJointReserves(const std::vector<ActuatorStatistics>& reserves,
                                            const std::vector<ActuatorSpec>& specs,
                                            const std::vector<JointSpec>& joints,
                                            const TimeSeries& moments);

}  // namespace gaitmill
