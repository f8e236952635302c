#pragma once

#include <string>
#include <vector>

#include "core/data/model_spec.h"
#include "core/validation/normal_draws.h"
#include "core/validation/published_parameters.h"
#include "core/validation/tendon_slack.h"
#include "core/validation/validation.h"

namespace gaitmill {

// How the spread of measured muscle architecture becomes a spread of model parameters
// (spec/paper_metrics.md I5 to I8; Rajagopal et al. 2016, Supplemental Table I).

/// A slack length's inputs and their standard deviations, independent and normal.
struct SlackVariation {
  SlackInput mean;
  double fiber_sd = 0;        ///< of l0M [m]
  double norm_length_sd = 0;  ///< of l~ [-]
  double pennation_sd = 0;    ///< of alpha_o [rad]
};

/// Result of a Monte Carlo. Draws without defined pennation or fiber count as rejected.
struct SlackSpread {
  double mean = 0;  ///< [m] of the accepted draws
  double sd = 0;    ///< [m] sample standard deviation of the accepted draws
  int rejected = 0;
  int draws = 0;
};

/// Draws l0M, l~ and alpha_o, in this order, and calibrates the slack length each time (I4, I7).
SlackSpread drawTendonSlack(const SlackVariation& variation,
                            const Muscle& muscle,
                            NormalDraws& normal,
                            int draws);

/// First-order propagation: derivatives of the slack length times the standard deviations.
struct SlackSensitivity {
  double by_fiber = 0;        ///< d lsT / d l0M [-]
  double by_norm_length = 0;  ///< d lsT / d l~ [m]
  double by_pennation = 0;    ///< d lsT / d alpha_o [m/rad]
};
SlackSensitivity calcSensitivity(const SlackInput& input, const Muscle& muscle);

/// Spread of pennation at optimal fiber length that a spread of measured normalised length makes
/// (first term of I6): sin alpha/D sigma_l~ with alpha the pennation at l~ [rad].
double calcPennationSpread(double pennation_at_optimal,
                           double norm_fiber_length,
                           double norm_length_sd);

/// What can be recomputed of one row of Supplemental Table I. The paper's inputs that are printed
/// nowhere (spreads of volume fraction and of measured normalised fiber length) are inferred from
/// the printed spreads of ONE compartment of each measured muscle; the rows of its other
/// compartments are then predictions. NaN where the table prints no spread.
struct ParameterSpread {
  std::string muscle;  ///< of the model: "soleus_r"
  const PublishedParameters* published = nullptr;
  bool is_prediction_of_force = false;  ///< inferred from another compartment's printed spread
  bool is_prediction_of_slack = false;

  double norm_fiber_length = 0;  ///< l~ at which the model's muscle rests in the calibration pose
  double force_by_fiber_n = 0;   ///< F sigma_l0/l0M
  double volume_cv = 0;          ///< sigma_phi/phi inferred
  double force_sd_n = 0;         ///< by I5

  double norm_length_cv = 0;       ///< sigma_l~/l~ inferred, to first order
  SlackSpread slack_by_fiber;      ///< Monte Carlo with sigma_l~ = 0: a lower bound
  SlackSpread slack;               ///< Monte Carlo with the inferred sigma_l~
  double pennation_by_length = 0;  ///< [rad] part of sigma_alpha_o due to sigma_l~
};

/// The muscles of the model's right leg that the table has.
/// @throws Error as calibrateTendonSlack; kInputValue if the number of draws is out of range
std::vector<ParameterSpread> calcParameterSpreads(const ModelSpec& model,
                                                  const ValidationOptions& options);

}  // namespace gaitmill
