#include "core/io/osim_geometry.h"

#include <string>

#include "core/io/osim_frames.h"

namespace gaitmill {

namespace {

using Vector3d = Eigen::Vector3d;

void readAttachedGeometry(const OsimElement& owner, std::vector<MeshSpec>& meshes) {
  for (const OsimElement& geometry : owner.property("attached_geometry").children()) {
    MeshSpec mesh;
    mesh.file = geometry.text("mesh_file");
    const bool visible = geometry.property("Appearance").boolean("visible", true);
    if (geometry.type() == "Mesh" && !mesh.file.empty() && visible) {
      mesh.scale_factors = geometry.vector3("scale_factors", Vector3d::Ones());
      meshes.push_back(std::move(mesh));
    }
  }
}

// Three body-fixed rotations, then the translation.
FrameSpec readTransform(const OsimElement& shape) {
  FrameSpec frame;
  if (const OsimElement transform = shape.property("transform")) {
    const std::vector<double> numbers = transform.ownNumbers(6);
    frame.orientation = Vector3d(numbers[0], numbers[1], numbers[2]);
    frame.translation = Vector3d(numbers[3], numbers[4], numbers[5]);
  }
  return frame;
}

void readVisibleObject(const OsimElement& owner, std::vector<MeshSpec>& meshes) {
  const OsimElement object = owner.property("VisibleObject");
  const Vector3d outer_factors = object.vector3("scale_factors", Vector3d::Ones());
  const FrameSpec outer = readTransform(object);
  for (const OsimElement& geometry : object.objectsOf("GeometrySet")) {
    MeshSpec mesh;
    mesh.file = geometry.text("geometry_file");
    // That of the whole object says nothing: published models hide thigh and shank by it, and show
    // them once converted.
    const bool hidden = geometry.number("display_preference", 1) == 0;
    if (mesh.file.empty() || hidden) {
      continue;
    }
    const FrameSpec inner = readTransform(geometry);
    const FrameSpec frame = composeFrames(outer, inner.translation, inner.orientation);
    mesh.translation = frame.translation;
    mesh.orientation = frame.orientation;
    mesh.scale_factors =
        outer_factors.cwiseProduct(geometry.vector3("scale_factors", Vector3d::Ones()));
    meshes.push_back(std::move(mesh));
  }
}

}  // namespace

std::vector<MeshSpec> readMeshes(const OsimElement& owner) {
  std::vector<MeshSpec> meshes;
  readAttachedGeometry(owner, meshes);
  readVisibleObject(owner, meshes);
  return meshes;
}

}  // namespace gaitmill
