#pragma once

#include <string>

#include "core/data/marker_set.h"
#include "core/data/model_spec.h"
#include "core/pipeline/pipeline.h"

namespace gaitmill {

/// Reads a marker set document (models/marker_sets/*.json). Fields wear their units: location_m,
/// time_range_s, value_deg or value_m, min_deg ... Everything but "name" may be absent.
/// @throws Error kSettingsJson (with line and column), kSettingsUnknownField (with the nearest
///   name), kSettingsValue, kInputMissing (with the path of the field)
MarkerSetSpec readMarkerSet(const InputFile& file);

/// The document that readMarkerSet reads back to the same values (angles to the last bits).
/// @param model  tells rotations from translations
std::string writeMarkerSet(const MarkerSetSpec& set, const ModelSpec& model);

}  // namespace gaitmill
