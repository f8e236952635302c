// Upper arm, forearm and hand.

#include <array>

#include "core/render/bone_shapes.h"
#include "core/render/mesh_kit.h"
#include "core/render/solid.h"

namespace gaitmill {

namespace {

using Vector3d = Eigen::Vector3d;

const Vector3d kArmCell(0.0054, 0.0110, 0.0054);

}  // namespace

Mesh makeHumerusBones() {
  Solid humerus;
  humerus.addStroke({{{0.008, -0.015, 0.000}, 0.0150},
                     {{0.006, -0.060, 0.000}, 0.0110},
                     {{0.005, -0.140, 0.000}, 0.0095},
                     {{0.004, -0.210, 0.001}, 0.0095},
                     {{0.007, -0.255, 0.001}, 0.0120}},
                    0.0);
  humerus.addEllipsoid({0.001, 0.000, -0.004}, {0.0215, 0.0215, 0.0215}, 0.006);
  humerus.addEllipsoid({0.007, 0.000, 0.012}, {0.0125, 0.0140, 0.0110}, 0.010);
  humerus.addEllipsoid({0.020, -0.008, 0.000}, {0.0080, 0.0120, 0.0080}, 0.010);
  // Deltoid tuberosity.
  humerus.addStroke({{{0.006, -0.080, 0.004}, 0.0010},
                     {{0.006, -0.115, 0.006}, 0.0060},
                     {{0.005, -0.150, 0.003}, 0.0010}},
                    0.010);
  // Flat lower end: epicondyles, capitulum and trochlea about the elbow's axis.
  humerus.addStroke({{{0.008, -0.250, 0.002}, 0.0130}, {{0.011, -0.276, -0.003}, 0.0260}},
                    0.010,
                    {Vector3d::UnitX(), 0.40});
  humerus.addEllipsoid({0.008, -0.274, -0.028}, {0.0060, 0.0085, 0.0060}, 0.008);
  humerus.addStroke({{{0.013, -0.286, -0.022}, 0.0115},
                     {{0.014, -0.286, -0.009}, 0.0085},
                     {{0.014, -0.287, 0.000}, 0.0105}},
                    0.005);
  humerus.addEllipsoid({0.016, -0.285, 0.012}, {0.0105, 0.0105, 0.0095}, 0.005);
  humerus.carveEllipsoid({-0.004, -0.270, -0.008}, {0.0085, 0.0100, 0.0100}, 0.004);
  return humerus.makeMesh(kArmCell);
}

Mesh makeUlnaBones() {
  Solid ulna;
  ulna.addStroke({{{-0.018, 0.004, -0.004}, 0.0105},
                  {{-0.020, -0.020, 0.000}, 0.0105},
                  {{-0.026, -0.060, 0.008}, 0.0070},
                  {{-0.027, -0.120, 0.011}, 0.0060},
                  {{-0.025, -0.180, 0.014}, 0.0052},
                  {{-0.023, -0.222, 0.021}, 0.0062},
                  {{-0.022, -0.236, 0.023}, 0.0078}},
                 0.0);
  // Coronoid process and the notch that holds the humerus.
  ulna.addEllipsoid({-0.006, -0.016, -0.002}, {0.0085, 0.0070, 0.0100}, 0.008);
  ulna.carveStroke({{{0.002, 0.000, -0.018}, 0.0125}, {{-0.002, 0.000, 0.012}, 0.0125}}, 0.003);
  ulna.addStroke({{{-0.026, -0.236, 0.018}, 0.0035}, {{-0.027, -0.246, 0.017}, 0.0022}}, 0.004);
  return ulna.makeMesh(kArmCell);
}

Mesh makeRadiusBones() {
  Solid radius;
  radius.addStroke({{{0.000, -0.004, 0.000}, 0.0105}, {{0.000, -0.010, 0.000}, 0.0100}}, 0.0);
  radius.addStroke({{{0.000, -0.012, 0.000}, 0.0066},
                    {{-0.001, -0.040, 0.003}, 0.0066},
                    {{-0.001, -0.090, 0.012}, 0.0062},
                    {{-0.004, -0.140, 0.022}, 0.0060},
                    {{-0.007, -0.190, 0.025}, 0.0072},
                    {{-0.008, -0.220, 0.023}, 0.0110}},
                   0.006);
  radius.addEllipsoid({0.000, -0.036, -0.002}, {0.0055, 0.0090, 0.0055}, 0.006);
  radius.addEllipsoid({-0.008, -0.222, 0.021}, {0.0115, 0.0110, 0.0150}, 0.008);
  radius.addStroke({{{-0.008, -0.226, 0.031}, 0.0060}, {{-0.006, -0.236, 0.033}, 0.0040}}, 0.006);
  radius.carveEllipsoid({-0.0088, -0.2400, 0.0160}, {0.0130, 0.0080, 0.0190}, 0.003);
  return radius.makeMesh(kArmCell);
}

namespace {

/// A finger: metacarpal base and head, then the joints to the tip.
struct Finger {
  std::array<Vector3d, 5> joints;
  double radius;
  int bones;
};

Mesh makeFingerBone(const Vector3d& base, const Vector3d& head, double radius) {
  return makeTube({{base, radius},
                   {base + 0.22 * (head - base), 0.74 * radius},
                   {base + 0.60 * (head - base), 0.62 * radius},
                   {head, 0.92 * radius}},
                  {7, 1, 1, {}});
}

// Slightly bent fingers of a hanging hand, palm inward: x forward, z to the thumb's side.
const std::array<Finger, 5> kFingers = {{
    {{{{0.004, -0.026, 0.026},
       {0.016, -0.060, 0.044},
       {0.024, -0.088, 0.051},
       {0.028, -0.108, 0.053},
       {0, 0, 0}}},
     0.0076,
     3},
    {{{{-0.004, -0.030, 0.012},
       {-0.006, -0.090, 0.018},
       {0.012, -0.126, 0.021},
       {0.030, -0.143, 0.021},
       {0.046, -0.148, 0.020}}},
     0.0070,
     4},
    {{{{-0.006, -0.030, 0.002},
       {-0.008, -0.092, 0.001},
       {0.012, -0.130, 0.000},
       {0.033, -0.146, -0.002},
       {0.050, -0.150, -0.003}}},
     0.0070,
     4},
    {{{{-0.006, -0.029, -0.006},
       {-0.006, -0.086, -0.012},
       {0.013, -0.120, -0.016},
       {0.032, -0.135, -0.018},
       {0.048, -0.139, -0.019}}},
     0.0066,
     4},
    {{{{-0.004, -0.027, -0.013},
       {-0.002, -0.078, -0.024},
       {0.013, -0.104, -0.030},
       {0.027, -0.114, -0.033},
       {0.040, -0.117, -0.035}}},
     0.0060,
     4},
}};

// Wrist: two rows of four.
const std::array<std::pair<Vector3d, double>, 8> kCarpals = {{
    {{0.000, -0.0050, 0.010}, 0.0095},
    {{-0.003, -0.0040, -0.001}, 0.0087},
    {{-0.004, -0.0070, -0.010}, 0.0078},
    {{0.006, -0.0090, -0.013}, 0.0056},
    {{0.003, -0.0170, 0.018}, 0.0081},
    {{-0.002, -0.0190, 0.010}, 0.0069},
    {{-0.003, -0.0170, 0.001}, 0.0099},
    {{-0.001, -0.0180, -0.009}, 0.0090},
}};

}  // namespace

Mesh makeHandBones() {
  Mesh mesh;
  for (const auto& [center, radius] : kCarpals) {
    appendMesh(
        mesh, makeEllipsoid(center, Vector3d::Constant(radius), Eigen::Matrix3d::Identity(), 8, 5));
  }
  for (const Finger& finger : kFingers) {
    for (int i = 0; i < finger.bones; ++i) {
      const Vector3d& base = finger.joints[static_cast<std::size_t>(i)];
      const Vector3d& head = finger.joints[static_cast<std::size_t>(i) + 1];
      const double radius = finger.radius * (1 - 0.09 * i);
      const Vector3d gap = radius * (head - base).normalized();
      appendMesh(mesh, makeFingerBone(base + 0.9 * gap, head - 0.7 * gap, radius));
    }
  }
  return mesh;
}

}  // namespace gaitmill
