#pragma once

#include "core/sample/gait_pattern.h"

namespace gaitmill {

/// How the balance of a walking motion was reached.
struct BalanceReport {
  double rms_before = 0;  ///< [m] distance of the zero moment point from its target, over the cycle
  double rms_after = 0;   ///< [m]
  double largest_after = 0;     ///< [m]
  double largest_shift = 0;     ///< [m] largest term added to a pelvis translation
  double largest_rotation = 0;  ///< [rad] largest term added to a rotation
};

/// Puts the zero moment point of the whole body under the supporting feet, rolling from heel to
/// toe, and the net force near the mass centre. A symmetrized fit loses the millimetres of sway
/// that keep the measured body in balance (2 mm at the fifth harmonic are 0.15 g). The terms of the
/// pelvis and of the lumbar joint are changed as little as needed: with z the zero moment point and
/// m the horizontal distance at which the net force passes the mass centre,
///   min  sum_t |z - target|^2 / sigma_z^2 + |m|^2 / sigma_m^2  +  sum_n (change_n / sigma_n)^2
/// by Gauss-Newton with differences; the problem is nearly linear.
BalanceReport balanceGait(GaitMotion& motion);

}  // namespace gaitmill
