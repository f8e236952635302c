#pragma once

#include "core/intake/marker_names.h"
#include "core/pipeline/json_fields.h"
#include "core/pipeline/pipeline.h"

namespace gaitmill {

/// Reads {"measured name": "landmark" | null, ...}; null = the marker is to be ignored.
/// @throws Error kSettingsValue if a value is neither, kMarkerNames with the nearest name if there
///   is no such landmark; both name the field
MarkerOverrides readMarkerOverrides(JsonFields fields);

/// The same from a file of its own, the trial part marker_names.
/// @throws also Error kSettingsJson with line and column
MarkerOverrides readMarkerNames(const InputFile& file);

}  // namespace gaitmill
