#pragma once

#include <string>
#include <vector>

#include "core/base/index.h"
#include "core/data/mesh.h"
#include "core/data/model_spec.h"

namespace gaitmill {

/// A bone, or several, fixed to a body, in the body's frame, scaled with the subject.
struct BodyMesh {
  BodyIndex body;
  Mesh mesh;
};

/// gaitmill's own stylised bones: every body of the Rajagopal model, and of other gait models the
/// bodies of the same names; any other body that has a joint further out gets a plain shaft.
std::vector<BodyMesh> makeStylizedBones(const ModelSpec& model);

/// The meshes that the model names, from a folder of .vtp, .stl and .obj files, with the model's
/// scale factors. Bodies without any mesh in the folder get their stylised bones.
/// @param warnings  a sentence for each file that is missing or unreadable
std::vector<BodyMesh> readBones(const ModelSpec& model,
                                const std::string& folder,
                                std::vector<std::string>& warnings);

}  // namespace gaitmill
