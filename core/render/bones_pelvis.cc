// Hip bones and sacrum.

#include "core/render/bone_shapes.h"
#include "core/render/mesh_kit.h"
#include "core/render/solid.h"

namespace gaitmill {

namespace {

using Vector3d = Eigen::Vector3d;

// From the acetabulum's roof to the crest, each row from front to back.
void addIliacWing(Solid& hip) {
  hip.addSheet({{{{-0.026, -0.042, 0.091}, 0.0090},
                 {{-0.052, -0.042, 0.084}, 0.0120},
                 {{-0.076, -0.038, 0.073}, 0.0110},
                 {{-0.094, -0.032, 0.062}, 0.0090},
                 {{-0.106, -0.021, 0.055}, 0.0085}},
                {{{-0.013, -0.016, 0.109}, 0.0062},
                 {{-0.046, -0.006, 0.100}, 0.0058},
                 {{-0.078, -0.002, 0.084}, 0.0058},
                 {{-0.106, 0.001, 0.066}, 0.0062},
                 {{-0.136, 0.001, 0.046}, 0.0080}},
                {{{-0.001, 0.000, 0.122}, 0.0062},
                 {{-0.040, 0.036, 0.118}, 0.0058},
                 {{-0.078, 0.046, 0.099}, 0.0058},
                 {{-0.112, 0.040, 0.075}, 0.0050},
                 {{-0.143, 0.024, 0.046}, 0.0078}},
                {{{-0.001, 0.013, 0.124}, 0.0068},
                 {{-0.030, 0.064, 0.131}, 0.0066},
                 {{-0.074, 0.087, 0.114}, 0.0062},
                 {{-0.116, 0.075, 0.080}, 0.0060},
                 {{-0.148, 0.040, 0.046}, 0.0072}}},
               0.006);
}

// The ring that carries the trunk: from the sacroiliac joint along the pelvic brim to the pubis.
void addBrim(Solid& hip) {
  hip.addStroke({{{-0.120, 0.002, 0.050}, 0.0100},
                 {{-0.094, -0.032, 0.063}, 0.0120},
                 {{-0.064, -0.055, 0.068}, 0.0150},
                 {{-0.038, -0.064, 0.060}, 0.0115},
                 {{-0.020, -0.071, 0.036}, 0.0088},
                 {{-0.011, -0.082, 0.013}, 0.0095},
                 {{-0.012, -0.096, 0.0085}, 0.0080}},
                0.012);
  // Anterior inferior iliac spine, where the rectus femoris begins.
  hip.addStroke({{{-0.020, -0.036, 0.097}, 0.0075},
                 {{-0.032, -0.052, 0.088}, 0.0110},
                 {{-0.044, -0.066, 0.076}, 0.0130}},
                0.010);
}

void addIschium(Solid& hip) {
  hip.addStroke({{{-0.074, -0.080, 0.068}, 0.0180},
                 {{-0.092, -0.098, 0.063}, 0.0140},
                 {{-0.096, -0.115, 0.057}, 0.0145}},
                0.012);
  // Ramus, which closes the obturator foramen from below.
  hip.addStroke({{{-0.014, -0.100, 0.0095}, 0.0078},
                 {{-0.036, -0.116, 0.022}, 0.0064},
                 {{-0.066, -0.127, 0.040}, 0.0074},
                 {{-0.090, -0.121, 0.054}, 0.0120}},
                0.008);
  hip.addStroke({{{-0.098, -0.064, 0.058}, 0.0085}, {{-0.113, -0.064, 0.047}, 0.0042}}, 0.010);
}

Mesh makeHipBone() {
  Solid hip;
  addIliacWing(hip);
  hip.addEllipsoid({-0.058, -0.074, 0.066}, {0.0330, 0.0340, 0.0250}, 0.014);
  addBrim(hip);
  addIschium(hip);
  // Acetabulum: room for the femur's head.
  hip.carveEllipsoid({-0.0563, -0.0785, 0.0840}, {0.0262, 0.0262, 0.0270}, 0.004);
  return hip.makeMesh({0.0086, 0.0092, 0.0056});
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
  return sacrum.makeMesh(Vector3d::Constant(0.0074));
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
