// Hip bones and sacrum.

#include "core/render/bone_shapes.h"
#include "core/render/mesh_kit.h"
#include "core/render/solid.h"

namespace gaitmill {

namespace {

using Vector3d = Eigen::Vector3d;

// From the acetabulum's roof to the crest, each row from front to back.
void addIliacWing(Solid& hip) {
  hip.addSheet({{{{-0.030, -0.042, 0.090}, 0.0085},
                 {{-0.052, -0.036, 0.088}, 0.0110},
                 {{-0.075, -0.032, 0.078}, 0.0100},
                 {{-0.096, -0.026, 0.064}, 0.0085},
                 {{-0.112, -0.012, 0.053}, 0.0090}},
                {{{-0.014, -0.018, 0.107}, 0.0060},
                 {{-0.045, -0.004, 0.099}, 0.0045},
                 {{-0.078, 0.000, 0.084}, 0.0045},
                 {{-0.105, 0.004, 0.066}, 0.0060},
                 {{-0.131, 0.006, 0.047}, 0.0080}},
                {{{-0.004, 0.002, 0.121}, 0.0060},
                 {{-0.040, 0.036, 0.117}, 0.0038},
                 {{-0.078, 0.046, 0.098}, 0.0036},
                 {{-0.112, 0.040, 0.074}, 0.0048},
                 {{-0.140, 0.026, 0.047}, 0.0075}},
                {{{-0.003, 0.014, 0.123}, 0.0065},
                 {{-0.034, 0.066, 0.129}, 0.0058},
                 {{-0.076, 0.086, 0.112}, 0.0055},
                 {{-0.116, 0.074, 0.079}, 0.0055},
                 {{-0.145, 0.040, 0.047}, 0.0070}}},
               0.006);
}

Mesh makeHipBone() {
  Solid hip;
  addIliacWing(hip);
  // Body around the hip joint, then pubis and ischium, which close around the obturator foramen.
  hip.addEllipsoid({-0.060, -0.072, 0.070}, {0.0300, 0.0310, 0.0220}, 0.014);
  hip.addStroke({{{-0.040, -0.064, 0.066}, 0.0130},
                 {{-0.022, -0.068, 0.040}, 0.0090},
                 {{-0.010, -0.082, 0.014}, 0.0100},
                 {{-0.012, -0.096, 0.0085}, 0.0080}},
                0.010);
  hip.addStroke({{{-0.014, -0.100, 0.0095}, 0.0078},
                 {{-0.036, -0.116, 0.022}, 0.0062},
                 {{-0.066, -0.128, 0.040}, 0.0072},
                 {{-0.090, -0.122, 0.054}, 0.0120}},
                0.008);
  hip.addStroke({{{-0.076, -0.080, 0.070}, 0.0160},
                 {{-0.092, -0.100, 0.063}, 0.0130},
                 {{-0.096, -0.116, 0.057}, 0.0140}},
                0.012);
  // Ischial spine.
  hip.addStroke({{{-0.098, -0.062, 0.058}, 0.0075}, {{-0.112, -0.064, 0.046}, 0.0035}}, 0.008);
  hip.carveEllipsoid({-0.0563, -0.0785, 0.0840}, {0.0255, 0.0255, 0.0300}, 0.004);
  return hip.makeMesh(Vector3d::Constant(0.0070));
}

Mesh makeSacrum() {
  Solid sacrum;
  // Rows from the base down to the tip, from the middle to the right and, mirrored, to the left.
  struct Row {
    double x, y, half_width, side_x, thickness;
  };
  const Row rows[] = {{-0.108, 0.068, 0.046, -0.128, 0.0130},
                      {-0.122, 0.044, 0.045, -0.142, 0.0125},
                      {-0.140, 0.020, 0.036, -0.152, 0.0110},
                      {-0.156, -0.004, 0.023, -0.160, 0.0085},
                      {-0.162, -0.022, 0.013, -0.162, 0.0065},
                      {-0.160, -0.038, 0.005, -0.160, 0.0045}};
  std::vector<std::vector<StrokePoint>> net;
  for (const Row& row : rows) {
    const double edge = 0.7 * row.thickness;
    net.push_back({{{row.side_x, row.y, -row.half_width}, edge},
                   {{0.5 * (row.x + row.side_x), row.y, -0.5 * row.half_width}, row.thickness},
                   {{row.x, row.y, 0}, row.thickness},
                   {{0.5 * (row.x + row.side_x), row.y, 0.5 * row.half_width}, row.thickness},
                   {{row.side_x, row.y, row.half_width}, edge}});
  }
  sacrum.addSheet(net, 0.0);
  // Median crest, and the upper face that carries the last lumbar vertebra.
  sacrum.addStroke(
      {{{-0.140, 0.058, 0}, 0.0075}, {{-0.160, 0.030, 0}, 0.0070}, {{-0.172, 0.000, 0}, 0.0050}},
      0.010);
  sacrum.addEllipsoid({-0.106, 0.070, 0}, {0.0180, 0.0100, 0.0240}, 0.006);
  for (const double side : {-1.0, 1.0}) {
    for (int k = 0; k < 4; ++k) {
      const double y = 0.046 - 0.0155 * k;
      sacrum.carveEllipsoid(
          {-0.112 - 0.0135 * k, y, side * (0.019 - 0.0025 * k)}, {0.012, 0.0042, 0.0042}, 0.003);
    }
  }
  return sacrum.makeMesh(Vector3d::Constant(0.0070));
}

}  // namespace

Mesh makePelvisBones() {
  Mesh mesh = makeHipBone();
  Mesh left = mesh;
  scaleMesh(left, {1, 1, -1});
  appendMesh(mesh, left);
  appendMesh(mesh, makeSacrum());
  // Pubic symphysis.
  appendMesh(mesh,
             makeEllipsoid(
                 {-0.011, -0.089, 0}, {0.007, 0.014, 0.006}, Eigen::Matrix3d::Identity(), 10, 6));
  return mesh;
}

}  // namespace gaitmill
