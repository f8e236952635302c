#pragma once

namespace gaitmill {

/// First-order activation dynamics, a the activation, x the excitation. kThelen2003, which
/// Millard's muscles have, too (spec/muscle.md 5):
///   da/dt = (x - a)/tau,  tau = tau_a (0.5 + 1.5 a) if x > a, else tau_d/(0.5 + 1.5 a)
/// kSchutte1993 (Zajac 1989):
///   da/dt = (x - a)(r_x x + r_a) if x > a, else (x - a) r_a
struct ActivationDynamics {
  enum class Law { kThelen2003, kSchutte1993 };
  double activation_time_constant = 0.010;    ///< tau_a [s]
  double deactivation_time_constant = 0.040;  ///< tau_d [s]
  Law law = Law::kThelen2003;
  double excitation_rate = 0;  ///< r_x [1/s]
  double activation_rate = 0;  ///< r_a [1/s]; activation stays as it is where both are 0

  /// da/dt [1/s]
  double calcRate(double activation, double excitation) const noexcept;

  /// Exact solution after `duration` [s] of constant excitation. Monotone between the activation
  /// and the excitation, which it never passes. Accurate to 1e-14.
  double propagate(double activation, double excitation, double duration) const noexcept;
};

}  // namespace gaitmill
