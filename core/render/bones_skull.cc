// Skull and jaw, in the frame of the torso.

#include "core/render/bone_shapes.h"
#include "core/render/mesh_kit.h"
#include "core/render/solid.h"

namespace gaitmill {

namespace {

using Vector3d = Eigen::Vector3d;

// Cheek bone with its arch, rim of the orbit, mastoid process, orbit and temple of one side.
void addSide(Solid& skull, double side) {
  skull.addStroke({{{0.066, 0.568, side * 0.046}, 0.0062},
                   {{0.062, 0.551, side * 0.0485}, 0.0060},
                   {{0.059, 0.534, side * 0.043}, 0.0100}},
                  0.010);
  skull.addEllipsoid({0.059, 0.527, side * 0.036}, {0.0130, 0.0125, 0.0125}, 0.012);
  skull.addStroke({{{0.056, 0.533, side * 0.045}, 0.0080},
                   {{0.032, 0.537, side * 0.060}, 0.0050},
                   {{0.004, 0.541, side * 0.060}, 0.0055}},
                  0.006);
  skull.addEllipsoid({-0.012, 0.523, side * 0.050}, {0.0120, 0.0150, 0.0100}, 0.014);
  skull.carveEllipsoid({0.084, 0.5505, side * 0.0265}, {0.0270, 0.0155, 0.0175}, 0.006);
  skull.carveEllipsoid({0.038, 0.550, side * 0.083}, {0.0200, 0.0200, 0.0240}, 0.010);
}

// A row of teeth along the arch of a jaw. @param x  of the front teeth
void addTeeth(Solid& jaw, double x, double y, double radius) {
  jaw.addStroke({{{x - 0.030, y, -0.0240}, radius},
                 {{x - 0.007, y, -0.0150}, radius},
                 {{x, y, 0.0}, radius},
                 {{x - 0.007, y, 0.0150}, radius},
                 {{x - 0.030, y, 0.0240}, radius}},
                0.005);
}

Mesh makeCranium() {
  Solid skull;
  // Vault, forehead, occiput and base.
  skull.addEllipsoid({-0.006, 0.584, 0}, {0.0755, 0.0660, 0.0690}, 0.0);
  skull.addEllipsoid({0.032, 0.588, 0}, {0.0510, 0.0550, 0.0580}, 0.020);
  skull.addEllipsoid({-0.036, 0.550, 0}, {0.0410, 0.0350, 0.0490}, 0.020);
  skull.addEllipsoid({0.022, 0.545, 0}, {0.0420, 0.0340, 0.0440}, 0.020);
  // Brow and upper jaw.
  skull.addStroke({{{0.068, 0.569, -0.038}, 0.0085},
                   {{0.081, 0.569, 0}, 0.0090},
                   {{0.068, 0.569, 0.038}, 0.0085}},
                  0.014);
  skull.addEllipsoid({0.052, 0.524, 0}, {0.0320, 0.0340, 0.0300}, 0.014);
  addSide(skull, -1);
  addSide(skull, 1);
  // Nasal bones and the opening under them.
  skull.addStroke({{{0.084, 0.563, 0}, 0.0060}, {{0.093, 0.545, 0}, 0.0050}}, 0.008);
  skull.carveEllipsoid({0.092, 0.5265, 0}, {0.0170, 0.0130, 0.0090}, 0.005);
  addTeeth(skull, 0.079, 0.4970, 0.0062);
  return skull.makeMesh(Vector3d::Constant(0.0080));
}

Mesh makeJaw() {
  Solid jaw;
  jaw.addStroke({{{0.030, 0.480, -0.044}, 0.0095},
                 {{0.060, 0.470, -0.029}, 0.0100},
                 {{0.076, 0.468, 0.0}, 0.0115},
                 {{0.060, 0.470, 0.029}, 0.0100},
                 {{0.030, 0.480, 0.044}, 0.0095}},
                0.0);
  addTeeth(jaw, 0.076, 0.4845, 0.0056);
  for (const double side : {-1.0, 1.0}) {
    // Ramus, from the angle of the jaw to its joint and to the coronoid process.
    jaw.addSheet({{{{0.018, 0.482, side * 0.046}, 0.0065}, {{0.042, 0.476, side * 0.041}, 0.0065}},
                  {{{0.013, 0.508, side * 0.049}, 0.0055}, {{0.040, 0.503, side * 0.046}, 0.0050}},
                  {{{0.009, 0.534, side * 0.051}, 0.0065}, {{0.034, 0.527, side * 0.048}, 0.0045}}},
                 0.008);
  }
  return jaw.makeMesh(Vector3d::Constant(0.0070));
}

}  // namespace

Mesh makeSkull() {
  Mesh mesh = makeCranium();
  appendMesh(mesh, makeJaw());
  return mesh;
}

}  // namespace gaitmill
