#include "core/render/surface.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/base/units.h"

namespace gaitmill {

namespace {

constexpr int kTubeSides = 10;
constexpr int kSphereSides = 12;

// Unit circle in the plane of two axes.
Eigen::Vector3d calcRim(const Eigen::Vector3d& a, const Eigen::Vector3d& b, int side, int sides) {
  const double angle = 2 * kPi * side / sides;
  return std::cos(angle) * a + std::sin(angle) * b;
}

Eigen::Vector3d findPerpendicular(const Eigen::Vector3d& axis) {
  return axis.unitOrthogonal();
}

void addVertex(const Eigen::Vector3d& position,
               const Eigen::Vector3d& normal,
               const Rgb& color,
               std::uint8_t gloss,
               Surface& surface) {
  surface.vertices.push_back({position.cast<float>(), normal.cast<float>(), color, gloss});
}

// Two triangles per side between the ring that begins at `first` and the next ring.
void joinRings(std::uint32_t first, int sides, Surface& surface) {
  const std::uint32_t n = static_cast<std::uint32_t>(sides);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    surface.addTriangle(first + i, first + j, first + n + i);
    surface.addTriangle(first + j, first + n + j, first + n + i);
  }
}

// A ring about `center`; normals lean along the axis by `slope`.
void addRing(const TubeRing& ring,
             const Eigen::Vector3d& a,
             const Eigen::Vector3d& tangent,
             double slope,
             std::uint8_t gloss,
             Surface& surface) {
  const Eigen::Vector3d b = tangent.cross(a);
  for (int side = 0; side < kTubeSides; ++side) {
    const Eigen::Vector3d rim = calcRim(a, b, side, kTubeSides);
    addVertex(ring.center + ring.radius * rim,
              (rim - slope * tangent).normalized(),
              ring.color,
              gloss,
              surface);
  }
}

// Direction of the path at a ring: along the bisector of its two pieces.
Eigen::Vector3d calcTangent(const std::vector<TubeRing>& rings, std::size_t i) {
  const std::size_t before = i > 0 ? i - 1 : i;
  const std::size_t after = std::min(i + 1, rings.size() - 1);
  const Eigen::Vector3d in = rings[i].center - rings[before].center;
  const Eigen::Vector3d out = rings[after].center - rings[i].center;
  const Eigen::Vector3d sum = in.normalized() + out.normalized();
  for (const Eigen::Vector3d& candidate : {sum, out, in}) {
    if (candidate.norm() > 1e-9) return candidate.normalized();
  }
  return Eigen::Vector3d::UnitY();  // the same point thrice
}

double calcSlope(const std::vector<TubeRing>& rings, std::size_t i) {
  const std::size_t before = i > 0 ? i - 1 : i;
  const std::size_t after = std::min(i + 1, rings.size() - 1);
  const double run = (rings[after].center - rings[before].center).norm();
  return run > 0 ? (rings[after].radius - rings[before].radius) / run : 0;
}

}  // namespace

void Surface::clear() {
  vertices.clear();
  indices.clear();
}

void Surface::addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  indices.push_back(a);
  indices.push_back(b);
  indices.push_back(c);
}

void addMesh(const Mesh& mesh, const Pose& X_GB, const Material& material, Surface& surface) {
  const Eigen::Matrix3f R = X_GB.R.cast<float>();
  const Eigen::Vector3f p = X_GB.p.cast<float>();
  const std::uint32_t first = surface.nextIndex();
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    surface.vertices.push_back(
        {R * mesh.vertices[i] + p, R * mesh.normals[i], material.color, material.gloss});
  }
  for (const std::array<std::uint32_t, 3>& t : mesh.triangles) {
    surface.addTriangle(first + t[0], first + t[1], first + t[2]);
  }
}

void addSphere(const Eigen::Vector3d& center,
               double radius,
               const Material& material,
               Surface& surface) {
  constexpr int kRings = kSphereSides / 2;
  const std::uint32_t first = surface.nextIndex();
  for (int ring = 0; ring <= kRings; ++ring) {
    const double polar = kPi * ring / kRings;
    for (int side = 0; side < kSphereSides; ++side) {
      const Eigen::Vector3d normal =
          std::cos(polar) * Eigen::Vector3d::UnitY() +
          std::sin(polar) *
              calcRim(Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(), side, kSphereSides);
      addVertex(center + radius * normal, normal, material.color, material.gloss, surface);
    }
  }
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    joinRings(first + ring * kSphereSides, kSphereSides, surface);
  }
}

void addTube(const std::vector<TubeRing>& rings, std::uint8_t gloss, Surface& surface) {
  if (rings.size() < 2) return;
  Eigen::Vector3d a = findPerpendicular(calcTangent(rings, 0));
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const Eigen::Vector3d tangent = calcTangent(rings, i);
    const Eigen::Vector3d carried = a - a.dot(tangent) * tangent;
    a = carried.norm() > 1e-6 ? carried.normalized() : findPerpendicular(tangent);
    const std::uint32_t first = surface.nextIndex();
    addRing(rings[i], a, tangent, calcSlope(rings, i), gloss, surface);
    if (i + 1 < rings.size()) joinRings(first, kTubeSides, surface);
  }
}

void addArrow(const Eigen::Vector3d& tail,
              const Eigen::Vector3d& direction,
              double length,
              double shaft_radius,
              const Material& material,
              Surface& surface) {
  const double head = std::min(6 * shaft_radius, 0.6 * length);
  const Eigen::Vector3d neck = tail + (length - head) * direction;
  const Eigen::Vector3d tip = tail + length * direction;
  addTube({{tail, shaft_radius, material.color}, {neck, shaft_radius, material.color}},
          material.gloss,
          surface);
  addTube(
      {{neck - 1e-4 * direction, 0, material.color}, {neck, 2.6 * shaft_radius, material.color}},
      material.gloss,
      surface);
  addTube({{neck, 2.6 * shaft_radius, material.color}, {tip, 0, material.color}},
          material.gloss,
          surface);
}

}  // namespace gaitmill
