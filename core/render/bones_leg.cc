// Thigh and shank.

#include "core/render/bone_shapes.h"
#include "core/render/mesh_kit.h"
#include "core/render/solid.h"

namespace gaitmill {

namespace {

using Vector3d = Eigen::Vector3d;

// Shafts are smooth along their length: cells are longer there.
const Vector3d kLongBoneCell(0.0062, 0.0130, 0.0062);

}  // namespace

Mesh makeFemurBones() {
  Solid femur;
  // Shaft, bowed forward; its head end under the greater trochanter, its knee end over the
  // condyles.
  femur.addStroke({{{-0.009, -0.028, 0.047}, 0.0155},
                   {{-0.005, -0.080, 0.038}, 0.0150},
                   {{0.009, -0.150, 0.032}, 0.0128},
                   {{0.019, -0.220, 0.026}, 0.0122},
                   {{0.021, -0.290, 0.017}, 0.0130},
                   {{0.014, -0.350, 0.007}, 0.0165},
                   {{0.006, -0.385, 0.001}, 0.0210}},
                  0.0);
  femur.addStroke({{{-0.010, -0.030, 0.042}, 0.0165}, {{0.000, -0.003, 0.006}, 0.0145}}, 0.012);
  femur.addEllipsoid({0, 0, 0}, {0.0235, 0.0235, 0.0235}, 0.003);
  // Greater trochanter, where the gluteus medius ends; lesser one, where the psoas does.
  femur.addStroke({{{-0.018, 0.000, 0.053}, 0.0085},
                   {{-0.014, -0.018, 0.056}, 0.0140},
                   {{-0.008, -0.048, 0.052}, 0.0120}},
                  0.014);
  femur.addEllipsoid({-0.021, -0.060, 0.020}, {0.009, 0.013, 0.0085}, 0.018);
  // Linea aspera.
  femur.addStroke({{{-0.009, -0.110, 0.036}, 0.0040},
                   {{0.004, -0.190, 0.029}, 0.0045},
                   {{0.009, -0.290, 0.016}, 0.0010}},
                  0.008);
  // Condyles, with the groove of the patella before and the notch behind.
  femur.addEllipsoid({-0.004, -0.404, -0.0225}, {0.0285, 0.0245, 0.0125}, 0.012);
  femur.addEllipsoid({-0.003, -0.403, 0.0235}, {0.0290, 0.0240, 0.0135}, 0.012);
  femur.addStroke({{{0.017, -0.393, -0.016}, 0.0145}, {{0.019, -0.391, 0.018}, 0.0160}}, 0.012);
  femur.addEllipsoid({-0.002, -0.393, -0.035}, {0.011, 0.012, 0.006}, 0.010);
  femur.addEllipsoid({-0.002, -0.395, 0.036}, {0.011, 0.012, 0.005}, 0.010);
  femur.carveStroke({{{0.039, -0.386, 0.001}, 0.0070}, {{0.037, -0.412, 0.000}, 0.0090}}, 0.008);
  femur.carveEllipsoid({-0.022, -0.418, 0.001}, {0.022, 0.022, 0.0085}, 0.006);
  return femur.makeMesh(kLongBoneCell);
}

namespace {

Mesh makeTibia() {
  Solid tibia;
  tibia.addStroke({{{-0.002, -0.050, 0.002}, 0.0235},
                   {{0.004, -0.080, 0.003}, 0.0165},
                   {{0.006, -0.130, 0.002}, 0.0125},
                   {{0.004, -0.220, -0.001}, 0.0108},
                   {{0.001, -0.310, -0.001}, 0.0100},
                   {{-0.002, -0.360, -0.001}, 0.0125},
                   {{-0.005, -0.382, 0.001}, 0.0165}},
                  0.0);
  // Plateau: two condyles under the femur's.
  tibia.addEllipsoid({-0.006, -0.034, -0.017}, {0.0250, 0.0150, 0.0170}, 0.012);
  tibia.addEllipsoid({-0.006, -0.035, 0.021}, {0.0240, 0.0150, 0.0170}, 0.012);
  // Tuberosity, where the patellar tendon ends, and the shin's edge.
  tibia.addStroke({{{0.014, -0.045, 0.001}, 0.0100},
                   {{0.022, -0.063, 0.000}, 0.0085},
                   {{0.018, -0.090, 0.002}, 0.0060}},
                  0.012);
  tibia.addStroke({{{0.018, -0.090, 0.002}, 0.0050},
                   {{0.014, -0.180, 0.000}, 0.0045},
                   {{0.006, -0.290, -0.003}, 0.0010}},
                  0.010);
  tibia.cut({-0.006, -0.0225, 0.002}, {-0.10, 1, 0}, 0.004);
  tibia.addStroke({{{-0.006, -0.026, 0.001}, 0.0060}, {{-0.008, -0.018, 0.001}, 0.0025}}, 0.006);
  // Lower end with the medial malleolus and the roof of the ankle.
  tibia.addEllipsoid({-0.005, -0.380, 0.000}, {0.0175, 0.0150, 0.0190}, 0.008);
  tibia.addStroke({{{0.000, -0.375, -0.016}, 0.0095}, {{0.001, -0.398, -0.0200}, 0.0070}}, 0.010);
  tibia.carveStroke({{{-0.009, -0.401, -0.014}, 0.0160}, {{-0.009, -0.401, 0.040}, 0.0160}}, 0.003);
  return tibia.makeMesh(kLongBoneCell);
}

Mesh makeFibula() {
  Solid fibula;
  fibula.addStroke({{{-0.014, -0.062, 0.036}, 0.0105},
                    {{-0.010, -0.085, 0.034}, 0.0070},
                    {{-0.007, -0.140, 0.031}, 0.0058},
                    {{-0.004, -0.230, 0.028}, 0.0058},
                    {{-0.004, -0.330, 0.030}, 0.0055},
                    {{-0.006, -0.375, 0.031}, 0.0075},
                    {{-0.008, -0.405, 0.033}, 0.0095},
                    {{-0.009, -0.424, 0.033}, 0.0060}},
                   0.0);
  return fibula.makeMesh({0.0056, 0.0140, 0.0056});
}

}  // namespace

Mesh makeTibiaBones() {
  Mesh mesh = makeTibia();
  appendMesh(mesh, makeFibula());
  return mesh;
}

Mesh makePatellaBones() {
  Solid patella;
  patella.addEllipsoid({0.003, 0.030, 0.0}, {0.0105, 0.0195, 0.0205}, 0.0);
  patella.addEllipsoid({0.004, 0.012, 0.0}, {0.0080, 0.0110, 0.0095}, 0.014);
  // The facets that glide on the femur.
  patella.carveEllipsoid({-0.020, 0.030, 0.019}, {0.016, 0.030, 0.016}, 0.006);
  patella.carveEllipsoid({-0.020, 0.030, -0.019}, {0.016, 0.030, 0.016}, 0.006);
  return patella.makeMesh(Vector3d::Constant(0.0050));
}

}  // namespace gaitmill
