#pragma once

namespace gaitmill {

/// First-order activation dynamics (spec/muscle.md 5):
///   da/dt = (x - a)/tau,  tau = tau_a (0.5 + 1.5 a) if x > a, else tau_d/(0.5 + 1.5 a)
struct ActivationDynamics {
  double activation_time_constant = 0.010;    ///< tau_a [s]
  double deactivation_time_constant = 0.040;  ///< tau_d [s]

  /// da/dt [1/s]
  double calcRate(double activation, double excitation) const noexcept;

  /// Exact solution after `duration` [s] of constant excitation. Monotone between the activation
  /// and the excitation, which it never passes. Accurate to 1e-14.
  double propagate(double activation, double excitation, double duration) const noexcept;
};

}  // namespace gaitmill
