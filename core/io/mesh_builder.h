#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/data/mesh.h"

namespace gaitmill {

/// Gathers vertices and polygons of one file and makes a mesh of them. Internal to core/io.
class MeshBuilder {
 public:
  explicit MeshBuilder(std::string file_name) : file_name_(std::move(file_name)) {}

  std::size_t vertexCount() const { return mesh_.vertices.size(); }
  /// @throws Error kMeshFormat unless finite, or if there are too many
  void addVertex(double x, double y, double z, int line);
  /// Normal of the next vertex that has none; all or no vertices of a mesh have one.
  void addNormal(const Eigen::Vector3f& normal) { mesh_.normals.push_back(normal); }
  /// Triangulates. Corners are positions in the list of vertices; repeated ones are dropped.
  /// @throws Error kMeshFormat if a corner is not there, or there are too many triangles
  void addPolygon(const std::vector<std::uint32_t>& corners, int line);
  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, int line);
  /// @throws Error kMeshFormat if there is no triangle
  Mesh finish();

  [[noreturn]] void fail(const std::string& message, int line) const;

 private:
  std::string file_name_;
  Mesh mesh_;
};

/// Divides a simple polygon into triangles: by cutting off ears in the polygon's mean plane, or as
/// a fan where it has more than 256 corners. @param corners  positions in `vertices`
std::vector<std::array<std::uint32_t, 3>> triangulate(const std::vector<Eigen::Vector3f>& vertices,
                                                      std::vector<std::uint32_t> corners);

/// Normals of each corner from the triangles around its vertex; see readMesh.
void calcCreasedNormals(Mesh& mesh);

// The formats.
void readVtp(std::string_view bytes, const std::string& file_name, MeshBuilder& mesh);
void readStl(std::string_view bytes, MeshBuilder& mesh);
void readObj(std::string_view bytes, MeshBuilder& mesh);

}  // namespace gaitmill
