#pragma once

#include <vector>

#include "core/data/model_spec.h"
#include "core/io/osim_element.h"

namespace gaitmill {

/// Visible meshes of a body or frame: <attached_geometry> of documents since 30502, <VisibleObject>
/// of older ones. Shapes without a file are ignored. Internal to core/io.
/// @throws Error kModelValue, kModelUnsupported
std::vector<MeshSpec> readMeshes(const OsimElement& owner);

}  // namespace gaitmill
