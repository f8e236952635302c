#pragma once

#include <nlohmann/json.hpp>

#include "core/analysis/tracking_error.h"
#include "core/pipeline/job.h"

namespace gaitmill {

/// JSON has no NaN and no infinity: a figure that does not exist is null.
nlohmann::ordered_json toJsonNumber(double value);

nlohmann::ordered_json summarizeTracking(const TrackingError& error);

/// The object "quality" of summary.json: verdict and reasons; every check with its bounds, sources,
/// causes and fixes; the verdict of each stage; then the figures themselves, units in the names.
nlohmann::ordered_json summarizeQuality(const Job& job, const JobQuality& quality);

}  // namespace gaitmill
