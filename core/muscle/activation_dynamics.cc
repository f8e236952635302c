#include "core/muscle/activation_dynamics.h"

#include <algorithm>
#include <cmath>

namespace gaitmill {
namespace {

// tau = tau_a (kBase + kGain a), and the reciprocal for deactivation.
constexpr double kBase = 0.5;
constexpr double kGain = 1.5;
constexpr double kRoundOff = 1e-15;
constexpr int kMaxSteps = 50;

// Rising: with gap g = x - a, dg/dt = -g/(tau_a (p - 1.5 g)), p = 0.5 + 1.5 x, so that
//   t/tau_a = 1.5 (g - g0) - p ln(g/g0).
// In s = ln(g/g0) <= 0 the right-hand side is convex and falling: Newton from a smaller s never
// overshoots.
double propagateGap(double gap, double excitation, double relative_duration) {
  const double p = kBase + kGain * excitation;
  // The gap falls at most as fast as with the smallest time constant it meets, the present one.
  double s = -relative_duration / (p - kGain * gap);
  for (int step = 0; step < kMaxSteps; ++step) {
    const double shrink = std::exp(s);
    const double error = kGain * gap * (shrink - 1) - p * s - relative_duration;
    const double change = error / (p - kGain * gap * shrink);
    s += change;
    if (std::abs(change) <= kRoundOff * (1 + std::abs(s))) {
      break;
    }
  }
  return gap * std::exp(std::min(s, 0.0));
}

// Rate at which the activation approaches a constant excitation [1/s]: constant until it is there.
double calcSchutteRate(const ActivationDynamics& d, double activation, double excitation) {
  return d.activation_rate + (excitation > activation ? d.excitation_rate * excitation : 0.0);
}

}  // namespace

double ActivationDynamics::calcRate(double activation, double excitation) const noexcept {
  if (law == Law::kSchutte1993) {
    return (excitation - activation) * calcSchutteRate(*this, activation, excitation);
  }
  const double weight = kBase + kGain * activation;
  const double tau = excitation > activation ? activation_time_constant * weight
                                             : deactivation_time_constant / weight;
  return (excitation - activation) / tau;
}

double ActivationDynamics::propagate(double activation,
                                     double excitation,
                                     double duration) const noexcept {
  if (law == Law::kSchutte1993) {
    const double rate = calcSchutteRate(*this, activation, excitation);
    return excitation + (activation - excitation) * std::exp(-rate * duration);
  }
  if (excitation > activation) {
    return excitation -
           propagateGap(excitation - activation, excitation, duration / activation_time_constant);
  }
  // Falling: logistic in w = 0.5 + 1.5 a, dw/dt = w (p - w)/tau_d with p = 0.5 + 1.5 x.
  const double p = kBase + kGain * excitation;
  const double w = kBase + kGain * activation;
  const double decay = std::exp(-p * duration / deactivation_time_constant);
  const double ratio = (w - p) / w * decay;
  return excitation + p * ratio / ((1 - ratio) * kGain);
}

}  // namespace gaitmill
