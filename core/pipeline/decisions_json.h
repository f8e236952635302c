#pragma once

#include <string>

#include "core/data/decision.h"

namespace gaitmill {

/// [{"part", "topic", "field", "value", "origin", "confidence", "evidence"}], as summary.json and
/// the answer to an upload list them, as JSON text.
std::string describeAsJson(const Decisions& decisions);

}  // namespace gaitmill
