// Skull and jaw, in the frame of the torso.

#include "core/render/bone_shapes.h"
#include "core/render/mesh_kit.h"
#include "core/render/solid.h"

namespace gaitmill {

namespace {

using Vector3d = Eigen::Vector3d;

Mesh makeCranium() {
  Solid skull;
  // Vault, forehead, base.
  skull.addEllipsoid({-0.006, 0.582, 0}, {0.0760, 0.0660, 0.0690}, 0.0);
  skull.addEllipsoid({0.030, 0.588, 0}, {0.0520, 0.0560, 0.0600}, 0.020);
  skull.addEllipsoid({-0.036, 0.548, 0}, {0.0400, 0.0360, 0.0480}, 0.020);
  // Face: brow, cheek bones with their arches, upper jaw, nose.
  skull.addStroke({{{0.070, 0.568, -0.036}, 0.0085},
                   {{0.081, 0.568, 0}, 0.0090},
                   {{0.070, 0.568, 0.036}, 0.0085}},
                  0.014);
  skull.addEllipsoid({0.056, 0.520, 0}, {0.0270, 0.0320, 0.0270}, 0.016);
  for (const double side : {-1.0, 1.0}) {
    skull.addStroke({{{0.066, 0.566, side * 0.047}, 0.0060},
                     {{0.060, 0.545, side * 0.050}, 0.0065},
                     {{0.060, 0.528, side * 0.042}, 0.0095}},
                    0.010);
    skull.addStroke({{{0.058, 0.530, side * 0.047}, 0.0075},
                     {{0.034, 0.534, side * 0.061}, 0.0042},
                     {{0.008, 0.538, side * 0.062}, 0.0050}},
                    0.006);
    skull.addEllipsoid({-0.010, 0.515, side * 0.052}, {0.0100, 0.0180, 0.0085}, 0.012);
    skull.carveEllipsoid({0.080, 0.549, side * 0.0275}, {0.0240, 0.0160, 0.0180}, 0.006);
    // Hollow of the temple.
    skull.carveEllipsoid({0.040, 0.548, side * 0.074}, {0.0200, 0.0220, 0.0200}, 0.008);
  }
  skull.addStroke({{{0.084, 0.562, 0}, 0.0050}, {{0.093, 0.546, 0}, 0.0045}}, 0.008);
  skull.carveEllipsoid({0.090, 0.527, 0}, {0.0140, 0.0140, 0.0085}, 0.005);
  // Teeth of the upper jaw.
  skull.addStroke({{{0.050, 0.497, -0.024}, 0.0058},
                   {{0.074, 0.496, -0.013}, 0.0058},
                   {{0.079, 0.496, 0.0}, 0.0058},
                   {{0.074, 0.496, 0.013}, 0.0058},
                   {{0.050, 0.497, 0.024}, 0.0058}},
                  0.006);
  return skull.makeMesh(Vector3d::Constant(0.0066));
}

Mesh makeJaw() {
  Solid jaw;
  jaw.addStroke({{{0.026, 0.478, -0.045}, 0.0085},
                 {{0.060, 0.472, -0.028}, 0.0090},
                 {{0.077, 0.470, 0.0}, 0.0105},
                 {{0.060, 0.472, 0.028}, 0.0090},
                 {{0.026, 0.478, 0.045}, 0.0085}},
                0.0);
  jaw.addStroke({{{0.048, 0.487, -0.026}, 0.0052},
                 {{0.070, 0.486, -0.014}, 0.0052},
                 {{0.075, 0.486, 0.0}, 0.0052},
                 {{0.070, 0.486, 0.014}, 0.0052},
                 {{0.048, 0.487, 0.026}, 0.0052}},
                0.006);
  for (const double side : {-1.0, 1.0}) {
    jaw.addStroke({{{0.026, 0.480, side * 0.045}, 0.0120},
                   {{0.018, 0.508, side * 0.049}, 0.0110},
                   {{0.012, 0.530, side * 0.051}, 0.0075}},
                  0.008,
                  {Vector3d::UnitZ(), 0.5});
  }
  return jaw.makeMesh(Vector3d::Constant(0.0055));
}

}  // namespace

Mesh makeSkull() {
  Mesh mesh = makeCranium();
  appendMesh(mesh, makeJaw());
  return mesh;
}

}  // namespace gaitmill
