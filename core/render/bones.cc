#include "core/render/bones.h"

#include "core/render/surface.h"

namespace gaitmill {

namespace {

constexpr double kShaftRadius = 0.016;  // [m]

// A tube from the body's origin to where the next body hangs, and a knob at the origin.
Mesh makeShaft(const Eigen::Vector3d& end) {
  Surface surface;
  addSphere(Eigen::Vector3d::Zero(), 1.5 * kShaftRadius, {}, surface);
  if (end.norm() > kShaftRadius) {
    addTube({{Eigen::Vector3d::Zero(), kShaftRadius, {}}, {end, kShaftRadius, {}}}, 0, surface);
  }
  Mesh mesh;
  for (const SurfaceVertex& v : surface.vertices) {
    mesh.vertices.push_back(v.position);
    mesh.normals.push_back(v.normal);
  }
  for (std::size_t i = 0; i + 2 < surface.indices.size(); i += 3) {
    mesh.triangles.push_back({surface.indices[i], surface.indices[i + 1], surface.indices[i + 2]});
  }
  return mesh;
}

}  // namespace

std::vector<BodyMesh> makeStylizedBones(const ModelSpec& model) {
  std::vector<BodyMesh> bones;
  for (const JointSpec& joint : model.joints) {
    const int parent = model.findBody(joint.parent.body);
    if (parent >= 0) bones.push_back({BodyIndex(parent), makeShaft(joint.parent.translation)});
  }
  return bones;
}

std::vector<BodyMesh> readBones(const ModelSpec& model,
                                const std::string&,
                                std::vector<std::string>& warnings) {
  warnings.push_back("meshes of a geometry folder cannot be read yet: stylised bones are shown");
  return makeStylizedBones(model);
}

}  // namespace gaitmill
