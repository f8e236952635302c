#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "core/analysis/tracking_error.h"
#include "core/pipeline/job.h"

namespace gaitmill {

/// What residual reduction did, step by step: limits, the steps that settled mass and mass centre,
/// and of every pass the weights, what was changed and why, deviations and residuals before and
/// after, and the decision that followed. The object "rra" of summary.json and the whole of
/// rra_audit.json.
nlohmann::ordered_json auditRra(const RraResult& rra);

/// The array "rra_passes" of summary.json: the passes in short.
nlohmann::ordered_json summarizeRraPasses(const RraResult& rra);

}  // namespace gaitmill
