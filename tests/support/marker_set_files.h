#pragma once

#include <string>

#include "core/data/marker_trajectories.h"
#include "core/io/files.h"
#include "core/io/trc_reader.h"
#include "core/pipeline/marker_set_json.h"

namespace gaitmill {

/// A marker set that the project ships, for tests that link core_pipeline.
inline MarkerSetSpec readShippedMarkerSet(const std::string& name) {
  const std::string path = "models/marker_sets/" + name + ".json";
  return readMarkerSet(InputFile{path, readFile(path)});
}

/// Marker trajectories from a file, for tests that link core_io.
inline MarkerTrajectories readMarkerFile(const std::string& path) {
  return readTrc(readFile(path), path).markers;
}

}  // namespace gaitmill
