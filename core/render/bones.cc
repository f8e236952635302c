#include "core/render/bones.h"

namespace gaitmill {

std::vector<BodyMesh> readBones(const ModelSpec& model,
                                const std::string&,
                                std::vector<std::string>& warnings) {
  warnings.push_back("meshes of a geometry folder cannot be read yet: stylised bones are shown");
  return makeStylizedBones(model);
}

}  // namespace gaitmill
