#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/data/mesh.h"
#include "core/model/model.h"
#include "core/render/image.h"

namespace gaitmill {

/// A corner of a triangle as the graphics library takes it, 28 bytes.
struct SurfaceVertex {
  Eigen::Vector3f position;  ///< in ground [m]
  Eigen::Vector3f normal;    ///< unit length; unused where a surface is not lit
  Rgb color;
  std::uint8_t weight;  ///< how glossy a lit surface is, how opaque one that is not lit, 0..255
};
static_assert(sizeof(SurfaceVertex) == 28, "the renderer states these offsets to OpenGL");

/// Coloured triangles in ground.
struct Surface {
  std::vector<SurfaceVertex> vertices;
  std::vector<std::uint32_t> indices;  ///< three per triangle

  void clear();
  std::uint32_t nextIndex() const { return static_cast<std::uint32_t>(vertices.size()); }
  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
};

/// How a lit surface looks.
struct Material {
  Rgb color;
  std::uint8_t gloss = 0;
};

void addMesh(const Mesh& mesh, const Pose& X_GB, const Material& material, Surface& surface);
void addSphere(const Eigen::Vector3d& center,
               double radius,
               const Material& material,
               Surface& surface);

/// A ring of a tube.
struct TubeRing {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< [m]
  double radius = 0;                                 ///< [m]
  Rgb color{};
};

/// A round tube through the rings, its ends closed by hemispheres' flat kin: cones of one ring.
/// Rings do not twist against each other (parallel transport). Fewer than two rings draw nothing.
void addTube(const std::vector<TubeRing>& rings, std::uint8_t gloss, Surface& surface);

/// An arrow from `tail`. Its head is part of `length`.
void addArrow(const Eigen::Vector3d& tail,
              const Eigen::Vector3d& direction,
              double length,
              double shaft_radius,
              const Material& material,
              Surface& surface);

}  // namespace gaitmill
