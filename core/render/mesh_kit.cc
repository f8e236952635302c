#include "core/render/mesh_kit.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Geometry>

namespace gaitmill {

namespace {

using Vector3d = Eigen::Vector3d;
using Vector3f = Eigen::Vector3f;

constexpr double kPi = 3.14159265358979323846;

/// A ring of corners, or a pole where the radii are zero.
struct Ring {
  Vector3d center;
  Vector3d u, v;  ///< half axes [m]; u x v points along the tube
};

template <class Value>
Value interpolate(const Value& a, const Value& b, const Value& c, const Value& d, double t) {
  const double t2 = t * t;
  const double t3 = t2 * t;
  return 0.5 * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * t2 +
                (3.0 * b - a - 3.0 * c + d) * t3);
}

Vector3d calcTangent(const std::vector<StrokePoint>& curve, std::size_t i) {
  const std::size_t before = i == 0 ? 0 : i - 1;
  const std::size_t after = std::min(i + 1, curve.size() - 1);
  return (curve[after].position - curve[before].position).normalized();
}

Vector3d findPerpendicular(const Vector3d& direction) {
  Eigen::Index smallest = 0;
  direction.cwiseAbs().minCoeff(&smallest);
  return direction.cross(Vector3d::Unit(smallest)).normalized();
}

Ring makeRing(const StrokePoint& point,
              const Vector3d& tangent,
              const CrossSection& section,
              Vector3d& u) {
  u = section.flatness == 1 ? u : section.thin_direction;
  u -= u.dot(tangent) * tangent;
  u = u.norm() < 1e-9 ? findPerpendicular(tangent) : Vector3d(u.normalized());
  return {point.position, u * point.radius * section.flatness, tangent.cross(u) * point.radius};
}

// Half an ellipsoid in rings and a pole: two rings, or one where tubes have few sides anyway.
void appendCap(
    std::vector<Ring>& rings, const Ring& end, const Vector3d& outward, double height, int sides) {
  constexpr int kFine = 9;
  const std::vector<double> angles =
      sides < kFine ? std::vector<double>{kPi / 4} : std::vector<double>{kPi / 6, kPi / 3};
  std::vector<Ring> cap;
  for (const double angle : angles) {
    cap.push_back({end.center + outward * height * std::sin(angle),
                   end.u * std::cos(angle),
                   end.v * std::cos(angle)});
  }
  cap.push_back({end.center + outward * height, Vector3d::Zero(), Vector3d::Zero()});
  if (rings.empty()) {
    std::reverse(cap.begin(), cap.end());
  }
  rings.insert(rings.end(), cap.begin(), cap.end());
}

void appendRing(Mesh& mesh, const Ring& ring, int sides) {
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * kPi * i / sides;
    const Vector3d p = ring.center + std::cos(angle) * ring.u + std::sin(angle) * ring.v;
    mesh.vertices.push_back(p.cast<float>());
  }
}

/// First and last ring are poles.
Mesh joinRings(const std::vector<Ring>& rings, int sides) {
  Mesh mesh;
  const auto n = static_cast<std::uint32_t>(sides);
  mesh.vertices.push_back(rings.front().center.cast<float>());
  for (std::size_t i = 1; i + 1 < rings.size(); ++i) {
    appendRing(mesh, rings[i], sides);
  }
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(rings.back().center.cast<float>());
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    mesh.triangles.push_back({0, 1 + next, 1 + i});
    for (std::uint32_t ring = 1; ring + n < last; ring += n) {
      mesh.triangles.push_back({ring + i, ring + next, ring + n + next});
      mesh.triangles.push_back({ring + i, ring + n + next, ring + n + i});
    }
    mesh.triangles.push_back({last, last - n + i, last - n + next});
  }
  calcSmoothNormals(mesh);
  return mesh;
}

}  // namespace

std::vector<StrokePoint> refineStroke(const std::vector<StrokePoint>& points, int per_span) {
  std::vector<StrokePoint> curve;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const StrokePoint& a = points[i == 0 ? 0 : i - 1];
    const StrokePoint& b = points[i];
    const StrokePoint& c = points[i + 1];
    const StrokePoint& d = points[std::min(i + 2, points.size() - 1)];
    for (int k = 0; k < per_span; ++k) {
      const double t = static_cast<double>(k) / per_span;
      curve.push_back({interpolate(a.position, b.position, c.position, d.position, t),
                       std::max(1e-4, interpolate(a.radius, b.radius, c.radius, d.radius, t))});
    }
  }
  curve.push_back(points.back());
  return curve;
}

Mesh makeTube(const std::vector<StrokePoint>& points, const TubeForm& form) {
  const std::vector<StrokePoint> curve = refineStroke(points, form.per_span);
  std::vector<Ring> body;
  Vector3d u = findPerpendicular(calcTangent(curve, 0));
  for (std::size_t i = 0; i < curve.size(); ++i) {
    CrossSection section = form.section;
    if (form.thin_from_axis) {
      const Vector3d& p = curve[i].position;
      section.thin_direction = Vector3d(p.x(), 0, p.z()).normalized();
    }
    body.push_back(makeRing(curve[i], calcTangent(curve, i), section, u));
  }
  const double height = form.cap * std::sqrt(form.section.flatness);
  const Vector3d ahead = calcTangent(curve, curve.size() - 1);
  std::vector<Ring> rings;
  appendCap(rings, body.front(), -calcTangent(curve, 0), height * curve.front().radius, form.sides);
  rings.insert(rings.end(), body.begin(), body.end());
  appendCap(rings, body.back(), ahead, height * curve.back().radius, form.sides);
  return joinRings(rings, form.sides);
}

Mesh makeEllipsoid(const Vector3d& center,
                   const Vector3d& radii,
                   const Eigen::Matrix3d& axes,
                   int sides,
                   int rings) {
  std::vector<Ring> stack;
  for (int i = 0; i <= rings + 1; ++i) {
    const double angle = kPi * i / (rings + 1) - kPi / 2;
    const double width = i == 0 || i > rings ? 0.0 : std::cos(angle);
    stack.push_back({center + axes.col(2) * radii[2] * std::sin(angle),
                     axes.col(0) * radii[0] * width,
                     axes.col(1) * radii[1] * width});
  }
  return joinRings(stack, sides);
}

void appendMesh(Mesh& mesh, const Mesh& other) {
  const auto offset = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  mesh.normals.insert(mesh.normals.end(), other.normals.begin(), other.normals.end());
  for (const auto& [a, b, c] : other.triangles) {
    mesh.triangles.push_back({a + offset, b + offset, c + offset});
  }
}

void scaleMesh(Mesh& mesh, const Vector3d& factors) {
  const Vector3f s = factors.cast<float>();
  const Vector3f inverse = factors.cwiseInverse().cast<float>();
  for (Vector3f& vertex : mesh.vertices) {
    vertex = vertex.cwiseProduct(s);
  }
  for (Vector3f& normal : mesh.normals) {
    normal = normal.cwiseProduct(inverse).normalized();
  }
  if (factors.prod() < 0) {
    for (auto& triangle : mesh.triangles) {
      std::swap(triangle[1], triangle[2]);
    }
  }
}

void moveMesh(Mesh& mesh, const Eigen::Matrix3d& R, const Vector3d& translation) {
  for (Vector3f& vertex : mesh.vertices) {
    vertex = (R * vertex.cast<double>() + translation).cast<float>();
  }
  for (Vector3f& normal : mesh.normals) {
    normal = (R * normal.cast<double>()).cast<float>();
  }
}

void calcSmoothNormals(Mesh& mesh) {
  std::vector<Vector3d> sums(mesh.vertices.size(), Vector3d::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3d origin = mesh.vertices[a].cast<double>();
    const Vector3d twice_area =
        (mesh.vertices[b].cast<double>() - origin).cross(mesh.vertices[c].cast<double>() - origin);
    for (const std::uint32_t corner : {a, b, c}) {
      sums[corner] += twice_area;
    }
  }
  mesh.normals.clear();
  for (const Vector3d& sum : sums) {
    const double length = sum.norm();
    mesh.normals.push_back(length > 0 ? Vector3f((sum / length).cast<float>()) : Vector3f::UnitY());
  }
}

}  // namespace gaitmill
