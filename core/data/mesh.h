#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace gaitmill {

/// A surface of triangles [m]. Corners run counter-clockwise seen from outside.
struct Mesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3f> normals;  ///< one per vertex, unit length
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

}  // namespace gaitmill
