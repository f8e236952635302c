#pragma once

#include <vector>

#include "core/cmc/cmc_options.h"
#include "core/data/model_spec.h"

namespace gaitmill {

/// Upper excitation limits of all muscles over time, resolved to the model's order. Immutable.
class ExcitationLimits {
 public:
  /// @throws Error kSettingsValue for a muscle that the model does not have or a second list
  ExcitationLimits(const ModelSpec& model, const CmcOptions& options);

  /// [-] The lower limit is min(options.min_excitation, this).
  double findUpper(int muscle, double t) const;

 private:
  double max_excitation_;
  std::vector<std::vector<ExcitationLimit::Node>> nodes_;  ///< per muscle; empty = constant
};

}  // namespace gaitmill
