#pragma once

#include <string>
#include <vector>

#include "core/data/fiber_target.h"
#include "core/data/model_spec.h"
#include "core/muscle/muscle.h"

namespace gaitmill {

/// What determines the slack length of a tendon whose fiber is known in one pose.
struct SlackInput {
  double path_length = 0;           ///< L [m]
  double optimal_fiber_length = 0;  ///< l0M [m]
  double norm_fiber_length = 0;     ///< l~ = fiber length over l0M in that pose [-]
  double pennation_at_optimal = 0;  ///< alpha_o [rad]
  TendonKind tendon = TendonKind::kElastic;
};

/// Tendon slack length that balances a fiber of length l~ l0M at 1 % activation
/// (spec/paper_metrics.md I4; Rajagopal et al. 2016):
///   alpha = asin(sin alpha_o / l~),  f = (0.01 fAL(l~) + fPE(l~)) cos alpha
///   lsT = (L - l~ l0M cos alpha) / (1 + eps(f)),   eps the inverse tendon curve, 0 if rigid
/// Negative where the fiber is longer than the path: nothing is left for a tendon.
/// @returns NaN where pennation is undefined (l~ <= |sin alpha_o|) or l0M is not positive
/// @param muscle  for its curves; its size plays no part
double calcTendonSlack(const SlackInput& input, const Muscle& muscle) noexcept;

/// Tendon length over slack length at which the curve has this force, both normalised; 1 for
/// forces <= 0. Solves to round-off.
double solveTendonStretch(const Muscle& muscle, double force) noexcept;

/// One row of a calibration.
struct SlackCalibration {
  std::string muscle;
  TendonKind tendon = TendonKind::kElastic;
  double path_length = 0;           ///< in the calibration pose [m]
  double norm_fiber_length = 0;     ///< target l~ [-]
  bool is_given = false;            ///< else l~ is where the muscle rests as it is
  double present_slack_length = 0;  ///< [m]
  double slack_length = 0;          ///< calibrated [m]
};

/// Calibrates the tendons of a model as Rajagopal et al. (2016) did: both legs at hip flexion 7
/// deg, abduction 2 deg, knee 0, plantarflexion 20 deg, activation 1 %, so that every fiber has its
/// target length in static equilibrium. Whether a tendon is rigid stays as it is.
/// @param targets  by muscle name; a name without side ("soleus") means both. Muscles without
/// target
///   keep the fiber length at which they rest in the pose, and so their slack length.
/// @throws Error kInputValue if a target names no muscle, names one twice, or cannot be reached;
///   kInputCoordinates if the model has none of the legs' coordinates
std::vector<SlackCalibration> calibrateTendonSlack(const ModelSpec& model,
                                                   const std::vector<FiberTarget>& targets);

/// The model with the calibrated slack lengths of muscles whose target was given.
ModelSpec applyCalibration(ModelSpec model, const std::vector<SlackCalibration>& calibration);

}  // namespace gaitmill
