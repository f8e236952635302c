// Foot: talus, the block from calcaneus to metatarsals, and toes.

#include <array>

#include "core/render/bone_shapes.h"
#include "core/render/mesh_kit.h"
#include "core/render/solid.h"

namespace gaitmill {

namespace {

using Vector3d = Eigen::Vector3d;

/// From base to head.
struct Metatarsal {
  Vector3d base, head;
  double radius;  ///< of the head
};

// From the great to the little toe. The heads stand along the joint's oblique axis.
const std::array<Metatarsal, 5> kMetatarsals = {{
    {{0.112, 0.020, -0.024}, {0.174, 0.004, -0.029}, 0.0125},
    {{0.106, 0.027, -0.008}, {0.181, 0.004, -0.007}, 0.0084},
    {{0.102, 0.025, 0.005}, {0.174, 0.003, 0.011}, 0.0080},
    {{0.094, 0.020, 0.016}, {0.163, 0.002, 0.026}, 0.0078},
    {{0.082, 0.013, 0.028}, {0.149, 0.001, 0.040}, 0.0080},
}};

// A long bone of hand or foot: thick at both ends.
Mesh makeRay(const Vector3d& base, const Vector3d& head, double radius, double arch) {
  const Vector3d up(0, arch, 0);
  return makeTube({{base, 0.95 * radius},
                   {base + 0.20 * (head - base) + 0.5 * up, 0.72 * radius},
                   {base + 0.55 * (head - base) + up, 0.58 * radius},
                   {base + 0.85 * (head - base) + 0.3 * up, 0.80 * radius},
                   {head, 0.92 * radius}},
                  {7, 1, 1, {}});
}

Mesh makeHindfoot() {
  Solid foot;
  // Calcaneus: heel, body, the shelf under the talus, and its front end.
  foot.addEllipsoid({0.011, 0.014, -0.004}, {0.0190, 0.0225, 0.0160}, 0.0);
  foot.addStroke({{{0.014, 0.020, -0.004}, 0.0165},
                  {{0.036, 0.024, -0.001}, 0.0165},
                  {{0.062, 0.019, 0.011}, 0.0150}},
                 0.014);
  foot.addEllipsoid({0.046, 0.030, -0.016}, {0.0130, 0.0070, 0.0090}, 0.008);
  return foot.makeMesh(Vector3d::Constant(0.0055));
}

Mesh makeMidfoot() {
  Mesh mesh;
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  const auto add = [&](const Vector3d& center, const Vector3d& radii) {
    appendMesh(mesh, makeEllipsoid(center, radii, axes, 10, 6));
  };
  add({0.081, 0.030, -0.016}, {0.0115, 0.0140, 0.0180});  // navicular
  add({0.079, 0.017, 0.017}, {0.0180, 0.0130, 0.0135});   // cuboid
  add({0.099, 0.024, -0.023}, {0.0155, 0.0145, 0.0100});  // cuneiforms
  add({0.097, 0.029, -0.008}, {0.0135, 0.0120, 0.0092});
  add({0.096, 0.026, 0.005}, {0.0140, 0.0120, 0.0092});
  return mesh;
}

}  // namespace

Mesh makeTalusBones() {
  Solid talus;
  // Trochlea: a drum about the ankle's axis; neck and head forward and inward.
  talus.addStroke({{{-0.002, -0.002, -0.011}, 0.0155}, {{0.000, -0.001, 0.013}, 0.0155}}, 0.0);
  talus.addStroke({{{0.006, -0.003, -0.004}, 0.0125}, {{0.024, -0.008, -0.012}, 0.0115}}, 0.008);
  talus.addEllipsoid({-0.014, -0.009, -0.002}, {0.0080, 0.0070, 0.0100}, 0.008);
  talus.cut({0, -0.018, 0}, {0, -1, 0}, 0.004);
  return talus.makeMesh(Vector3d::Constant(0.0055));
}

Mesh makeCalcaneusBones() {
  Mesh mesh = makeHindfoot();
  appendMesh(mesh, makeMidfoot());
  for (const Metatarsal& bone : kMetatarsals) {
    appendMesh(mesh, makeRay(bone.base, bone.head, bone.radius, 0.004));
  }
  // Styloid process of the fifth metatarsal, where the peroneus brevis ends.
  appendMesh(
      mesh,
      makeTube({{{0.086, 0.013, 0.028}, 0.0070}, {{0.070, 0.013, 0.034}, 0.0040}}, {8, 2, 1, {}}));
  return mesh;
}

Mesh makeToesBones() {
  // The toes' frame stands there in that of the calcaneus.
  const Vector3d joint(0.1788, -0.002, 0.00108);
  struct Toe {
    double length;  ///< of all phalanges
    int phalanges;
    double radius;
    Vector3d direction;
  };
  const std::array<Toe, 5> toes = {{
      {0.062, 2, 0.0112, {0.995, -0.03, 0.09}},
      {0.054, 3, 0.0066, {0.995, -0.05, 0.05}},
      {0.048, 3, 0.0062, {0.985, -0.05, 0.14}},
      {0.042, 3, 0.0060, {0.970, -0.05, 0.22}},
      {0.037, 3, 0.0058, {0.950, -0.05, 0.30}},
  }};
  Mesh mesh;
  for (std::size_t i = 0; i < toes.size(); ++i) {
    const Toe& toe = toes[i];
    const Vector3d direction = toe.direction.normalized();
    Vector3d base = kMetatarsals[i].head - joint + 0.75 * kMetatarsals[i].radius * direction;
    double length = toe.length * (toe.phalanges == 2 ? 0.56 : 0.50);
    for (int k = 0; k < toe.phalanges; ++k) {
      const double radius = toe.radius * (1 - 0.12 * k);
      const Vector3d drop(0, -0.0015 * k, 0);
      appendMesh(mesh,
                 makeRay(base + radius * direction,
                         base + (length - 0.8 * radius) * direction + drop,
                         radius,
                         0));
      base += length * direction + drop;
      length = k == 0 && toe.phalanges == 3 ? 0.27 * toe.length : toe.length * 0.24;
      length = toe.phalanges == 2 ? 0.44 * toe.length : length;
    }
  }
  return mesh;
}

}  // namespace gaitmill
