#include "core/cmc/muscle_predictor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/cmc/additive_runge_kutta.h"

namespace gaitmill {
namespace {

// First trial step, and the longest for which the fiber balance is surely monotone [s].
constexpr double kFirstStep = 0.0025;
constexpr double kLongestStep = 0.010;
// Shorter steps are accepted whatever the error: the state is then a jump, not a solution [s].
constexpr double kShortestStep = 1e-9;
constexpr double kSafety = 0.9;
constexpr int kMaxSearchSteps = 60;

struct StepControl {
  double step;
  bool accepted;
};

// Order 4 with an embedded order 3: the error scales with step^4.
StepControl controlStep(double step, double relative_error) {
  // Written so that an error that is not a number is accepted too: the loop must end.
  const bool accepted = !(relative_error > 1) || step <= kShortestStep;
  const double factor = kSafety * std::pow(std::max(1e-6, relative_error), -0.25);
  return {std::min(kLongestStep, step * std::clamp(factor, 0.1, accepted ? 5.0 : 0.9)), accepted};
}

// Root of an increasing or decreasing function between two ends of opposite sign: regula falsi with
// the weight of Anderson & Bjorck (1973) on an end that stays, so that both ends close in.
template <class Function>
double solveBracketed(
    const Function& f, double a, double f_a, double b, double f_b, double tolerance) {
  for (int step = 0; step < kMaxSearchSteps && std::abs(b - a) > tolerance; ++step) {
    const double x = b - f_b * (b - a) / (f_b - f_a);
    const double f_x = f(x);
    if (f_x == 0 || std::abs(x - b) < 0.5 * tolerance) {
      return x;
    }
    if ((f_x > 0) != (f_b > 0)) {
      a = b;
      f_a = f_b;
    } else {
      const double weight = 1 - f_x / f_b;
      f_a *= weight > 0 ? weight : 0.5;
    }
    b = x;
    f_b = f_x;
  }
  return b;
}

}  // namespace

MusclePredictor::MusclePredictor(const std::vector<Muscle>& muscles,
                                 int max_intervals,
                                 double fiber_tolerance)
    : muscles_(muscles),
      fiber_tolerance_(fiber_tolerance),
      paths_(static_cast<int>(muscles.size()), max_intervals),
      end_lengths_(static_cast<Eigen::Index>(muscles.size())),
      lines_(muscles.size()) {}

void MusclePredictor::setEnd(double duration,
                             const Eigen::Ref<const Eigen::VectorXd>& lengths,
                             const Eigen::Ref<const Eigen::VectorXd>& speeds) {
  duration_ = duration;
  end_lengths_ = lengths;
  for (std::size_t m = 0; m < muscles_.size(); ++m) {
    const auto i = static_cast<Eigen::Index>(m);
    lines_[m] = muscles_[m].calcRigidForceLine(lengths[i], speeds[i]);
  }
}

MusclePrediction MusclePredictor::predict(int muscle, const Start& start, double excitation) {
  ++predictions_;
  const auto m = static_cast<std::size_t>(muscle);
  MusclePrediction end;
  end.activation =
      muscles_[m].activationDynamics().propagate(start.activation, excitation, duration_);
  if (muscles_[m].hasRigidTendon()) {
    end.tendon_force = std::max(0.0, lines_[m].gain * end.activation + lines_[m].offset);
    return end;
  }
  end.fiber_length = integrateFiber(muscle, start, excitation);
  end.tendon_force = muscles_[m].calcTendonForce(end.fiber_length, end_lengths_[muscle]);
  return end;
}

double MusclePredictor::integrateFiber(int muscle, const Start& start, double excitation) {
  const Muscle& unit = muscles_[static_cast<std::size_t>(muscle)];
  const ActivationDynamics& dynamics = unit.activationDynamics();
  const double tolerance = fiber_tolerance_ * unit.optimalFiberLength();
  double length = std::max(start.fiber_length, unit.minFiberLength());
  double elapsed = 0;
  double next_step = kFirstStep;
  ark::Row k = {};  // fiber velocities of the stages
  k[0] = unit.solveStageVelocity({start.activation, length, paths_.calcLength(muscle, 0), 0}, 0);
  while (elapsed < duration_) {
    const double remaining = duration_ - elapsed;
    // Two equal steps rather than a long and a tiny one at the end.
    const double step = next_step >= remaining ? remaining : std::min(next_step, 0.5 * remaining);
    double change = 0;
    double error = 0;
    for (std::size_t i = 1; i < ark::kStages; ++i) {
      double start_length = length;
      for (std::size_t j = 0; j < i; ++j) {
        start_length += step * ark::kImplicit[i][j] * k[j];
      }
      const double t = elapsed + ark::kNodes[i] * step;
      const double a = dynamics.propagate(start.activation, excitation, t);
      k[i] = unit.solveStageVelocity(
          {a, start_length, paths_.calcLength(muscle, t), step * ark::kGamma}, k[i - 1]);
    }
    for (std::size_t i = 0; i < ark::kStages; ++i) {
      change += step * ark::kWeights[i] * k[i];
      error += step * (ark::kWeights[i] - ark::kEmbedded[i]) * k[i];
    }
    ++fiber_steps_;
    const StepControl control = controlStep(step, std::abs(error) / tolerance);
    next_step = control.step;
    if (!control.accepted) {
      ++rejected_steps_;
      continue;
    }
    length = std::max(length + change, unit.minFiberLength());
    elapsed = step == remaining ? duration_ : elapsed + step;
    k[0] = k[ark::kStages - 1];  // the last stage is the new state
  }
  return length;
}

double MusclePredictor::findExcitation(
    int muscle, const Start& start, const Range& range, double force, double tolerance) {
  if (force <= range.min_force || range.max_excitation <= range.min_excitation) {
    return range.min_excitation;
  }
  if (force >= range.max_force) {
    return range.max_excitation;
  }
  const auto m = static_cast<std::size_t>(muscle);
  if (muscles_[m].hasRigidTendon()) {
    // The force is a line in the final activation, and that is cheap to invert.
    const ActivationDynamics& dynamics = muscles_[m].activationDynamics();
    const double wanted = (force - lines_[m].offset) / lines_[m].gain;
    const auto error = [&](double x) {
      return dynamics.propagate(start.activation, x, duration_) - wanted;
    };
    return solveBracketed(error,
                          range.min_excitation,
                          error(range.min_excitation),
                          range.max_excitation,
                          error(range.max_excitation),
                          tolerance);
  }
  return solveBracketed([&](double x) { return predict(muscle, start, x).tendon_force - force; },
                        range.min_excitation,
                        range.min_force - force,
                        range.max_excitation,
                        range.max_force - force,
                        tolerance);
}

}  // namespace gaitmill
