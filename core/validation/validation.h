#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/data/figure.h"
#include "core/data/model_spec.h"

namespace gaitmill {

struct ValidationOptions {
  std::uint64_t seed = 1;  ///< of the Monte Carlo draws
  int draws = 10000;       ///< per muscle, 100 to 100000
};

/// The validation figures that this model has the muscles, coordinates and data for.
std::vector<FigureInfo> listValidationFigures(const ModelSpec& model);

/// A validation figure of any model that can be read: moment arms, isometric moments, curves,
/// normalised fiber lengths, variability (spec/paper_metrics.md G, H, I).
/// @throws Error kFigureNotFound naming those there are; kInputValue for options out of range;
/// those
///   of Model and makeMuscles if the model cannot be built
Figure makeValidationFigure(const ModelSpec& model,
                            const std::string& name,
                            const ValidationOptions& options = {});

}  // namespace gaitmill
