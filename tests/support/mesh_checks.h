#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/data/mesh.h"

namespace gaitmill {

inline Eigen::Vector3d calcAreaVector(const Mesh& mesh,
                                      const std::array<std::uint32_t, 3>& triangle) {
  const Eigen::Vector3d a = mesh.vertices[triangle[0]].cast<double>();
  return 0.5 * (mesh.vertices[triangle[1]].cast<double>() - a)
                   .cross(mesh.vertices[triangle[2]].cast<double>() - a);
}

inline double calcArea(const Mesh& mesh) {
  double area = 0;
  for (const auto& triangle : mesh.triangles) {
    area += calcAreaVector(mesh, triangle).norm();
  }
  return area;
}

/// Volume inside a closed mesh whose triangles look outward [m^3].
inline double calcVolume(const Mesh& mesh) {
  double volume = 0;
  for (const auto& triangle : mesh.triangles) {
    volume += mesh.vertices[triangle[0]].cast<double>().dot(calcAreaVector(mesh, triangle)) / 3;
  }
  return volume;
}

inline Eigen::AlignedBox3d findBox(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    box.extend(vertex.cast<double>());
  }
  return box;
}

/// True if every edge is passed as often in one direction as in the other.
inline bool isClosed(const Mesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> forth, back;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      forth.emplace_back(triangle[k], triangle[(k + 1) % 3]);
      back.emplace_back(triangle[(k + 1) % 3], triangle[k]);
    }
  }
  std::sort(forth.begin(), forth.end());
  std::sort(back.begin(), back.end());
  return forth == back;
}

}  // namespace gaitmill
