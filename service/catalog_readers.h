#pragma once

#include <string>

#include "core/pipeline/pipeline.h"

namespace gaitmill {

/// What is in a model document, as JSON: {"name", "total_mass_kg", "counts": {…}, "bodies",
/// "coordinates", "muscles", "actuators", "markers", "warnings"}, names in the document's order.
/// @throws Error of readOsim
std::string summarizeModel(const InputFile& document);

/// What is in a marker set document, as JSON: {"name", "description", "markers": those that inverse
/// kinematics follows, "model_markers": those that the set puts on the model}.
/// @throws Error of readMarkerSet
std::string summarizeMarkerSet(const InputFile& document);

}  // namespace gaitmill
