#pragma once

#include <Eigen/Core>

namespace gaitmill {

/// What the forward simulation carries from one instant to the next.
struct CmcState {
  double time = 0;               ///< [s]
  Eigen::VectorXd q;             ///< (free coordinates) [rad|m]
  Eigen::VectorXd u;             ///< (free coordinates) [rad/s|m/s]
  Eigen::VectorXd activation;    ///< (muscles) [-]
  Eigen::VectorXd fiber_length;  ///< (muscles) [m]; a rigid tendon's is not a state and ignored
};

/// What acts during one window: muscle excitations as steps, actuator forces as nodes of a ramp.
struct CmcControls {
  Eigen::VectorXd excitation;      ///< (muscles) [-], constant on the window
  Eigen::VectorXd actuator_force;  ///< (actuators) [N|N.m] at the window's end
};

}  // namespace gaitmill
