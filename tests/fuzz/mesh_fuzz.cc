#include <cmath>

#include "core/io/mesh_reader.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {
namespace {

void checkMesh(const char* name, std::string_view input) {
  const Mesh mesh = readMesh(name, input);
  requirePromise(!mesh.triangles.empty(), "there is a triangle");
  requirePromise(mesh.normals.size() == mesh.vertices.size(), "each vertex has a normal");
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      requirePromise(corner < mesh.vertices.size(), "corners are vertices");
    }
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    requirePromise(mesh.vertices[i].allFinite(), "vertices are finite");
    requirePromise(std::abs(mesh.normals[i].norm() - 1) < 1e-4F, "normals have unit length");
  }
}

}  // namespace

GAITMILL_FUZZ_TARGET(mesh) {
  for (const char* name : {"fuzz.vtp", "fuzz.stl", "fuzz.obj"}) {
    tryParse([&] { checkMesh(name, input); });
  }
}

}  // namespace gaitmill
