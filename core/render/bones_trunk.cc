// Spine, ribcage and shoulder girdle.

#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "core/render/bone_shapes.h"
#include "core/render/mesh_kit.h"
#include "core/render/solid.h"

namespace gaitmill {

namespace {

using Vector3d = Eigen::Vector3d;

constexpr int kVertebrae = 24;  // 5 lumbar, 12 thoracic, 7 cervical, counted from below
constexpr int kFirstThoracic = 5;
constexpr int kFirstCervical = 17;

// Centres of the vertebral bodies, from the sacrum to the skull: lordosis, kyphosis, lordosis.
const std::vector<StrokePoint>& getSpineCurve() {
  static const std::vector<StrokePoint> curve = {{{-0.002, 0.000, 0}, 0.0255},
                                                 {{0.012, 0.050, 0}, 0.0250},
                                                 {{0.004, 0.100, 0}, 0.0240},
                                                 {{-0.014, 0.150, 0}, 0.0215},
                                                 {{-0.034, 0.205, 0}, 0.0190},
                                                 {{-0.047, 0.265, 0}, 0.0175},
                                                 {{-0.048, 0.320, 0}, 0.0165},
                                                 {{-0.035, 0.375, 0}, 0.0150},
                                                 {{-0.015, 0.425, 0}, 0.0125},
                                                 {{-0.006, 0.470, 0}, 0.0115},
                                                 {{-0.010, 0.508, 0}, 0.0110}};
  return curve;
}

/// Place on the spine: t = 0 at the sacrum, 1 at the skull.
struct SpinePlace {
  Vector3d position, up;
  double radius;
};

SpinePlace findOnSpine(double t) {
  static const std::vector<StrokePoint> fine = refineStroke(getSpineCurve(), 12);
  const double at = t * static_cast<double>(fine.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), fine.size() - 2);
  const double f = at - static_cast<double>(i);
  return {fine[i].position + f * (fine[i + 1].position - fine[i].position),
          (fine[i + 1].position - fine[i].position).normalized(),
          fine[i].radius + f * (fine[i + 1].radius - fine[i].radius)};
}

// Vertebrae get lower towards the head: the gaps between 25 boundaries along the curve.
double findBoundary(int boundary) {
  const double s = static_cast<double>(boundary) / kVertebrae;
  return s * (1.42 - 0.42 * s);
}

SpinePlace findVertebra(int index) {
  return findOnSpine(0.5 * (findBoundary(index) + findBoundary(index + 1)));
}

/// Sizes of a vertebra relative to its body's radius, by region.
struct VertebraForm {
  double spinous;     ///< length behind the arch
  double drop;        ///< of its tip, relative to the vertebra's height
  double transverse;  ///< reach to the side
  double backward;    ///< of the transverse process's tip
  double thickness;   ///< of the processes
};

const VertebraForm& getForm(int index) {
  static const VertebraForm lumbar = {1.10, 0.30, 1.60, 0.10, 0.26};
  static const VertebraForm thoracic = {1.45, 0.95, 1.50, 0.55, 0.25};
  static const VertebraForm cervical = {1.60, 0.40, 1.70, 0.10, 0.27};
  return index >= kFirstCervical ? cervical : index >= kFirstThoracic ? thoracic : lumbar;
}

// In its own frame: x forward, y up. `radius` is the body's, `height` that of body and disc.
Mesh makeVertebra(const VertebraForm& form, double radius, double height) {
  const TubeForm drum = {10, 1, 0.10, {Vector3d::UnitX(), 0.78}};
  Mesh mesh = makeTube({{{0, -0.36 * height, 0}, radius},
                        {{0, 0, 0}, 0.84 * radius},
                        {{0, 0.36 * height, 0}, radius}},
                       drum);
  const double arch = -1.15 * radius;  // behind the canal
  const TubeForm thin = {6, 1, 1, {Vector3d::UnitZ(), 0.6}};
  appendMesh(mesh,
             makeTube({{{arch + 0.2 * radius, 0.10 * height, 0}, 1.3 * form.thickness * radius},
                       {{arch - 0.5 * form.spinous * radius, -0.35 * form.drop * height, 0},
                        1.2 * form.thickness * radius},
                       {{arch - form.spinous * radius, -form.drop * height, 0},
                        1.2 * form.thickness * radius}},
                      thin));
  const TubeForm round = {5, 1, 1, {}};
  for (const double side : {-1.0, 1.0}) {
    const double arm = form.thickness * radius;
    // Pedicle, then the transverse process.
    appendMesh(mesh,
               makeTube({{{-0.55 * radius, 0.12 * height, 0.55 * side * radius}, arm},
                         {{arch, 0.10 * height, 0.50 * side * radius}, 1.3 * arm}},
                        round));
    appendMesh(mesh,
               makeTube({{{arch - 0.1 * radius, 0.10 * height, 0}, 1.2 * arm},
                         {{arch + 0.1 * radius, 0.12 * height, 0.7 * side * radius}, 1.2 * arm},
                         {{arch + (0.3 - form.backward) * radius,
                           0.14 * height,
                           side * form.transverse * radius},
                          0.8 * arm}},
                        round));
  }
  return mesh;
}

}  // namespace

Mesh makeSpine() {
  Mesh mesh;
  for (int i = 0; i < kVertebrae; ++i) {
    const SpinePlace place = findVertebra(i);
    const double height =
        (findOnSpine(findBoundary(i + 1)).position - findOnSpine(findBoundary(i)).position).norm();
    Mesh vertebra = makeVertebra(getForm(i), place.radius, height);
    const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitY(), place.up);
    moveMesh(vertebra, turn.toRotationMatrix(), place.position);
    appendMesh(mesh, vertebra);
  }
  return mesh;
}

namespace {

/// Course of one rib of the right side: from its vertebra back and out, around, and down to the
/// front, where cartilage joins it to the sternum.
struct Rib {
  double side_z, side_x, side_drop;  ///< widest place, below the vertebra
  Vector3d front;                    ///< end of the bone
  bool to_sternum;                   ///< cartilage to the sternum (or, from 8, to the rib above)
};

const std::array<Rib, 12> kRibs = {{
    {0.052, -0.016, 0.010, {0.022, 0.372, 0.030}, true},
    {0.082, -0.022, 0.018, {0.040, 0.348, 0.040}, true},
    {0.102, -0.024, 0.030, {0.056, 0.322, 0.044}, true},
    {0.115, -0.020, 0.040, {0.068, 0.294, 0.050}, true},
    {0.124, -0.012, 0.050, {0.078, 0.264, 0.058}, true},
    {0.130, -0.006, 0.058, {0.086, 0.234, 0.070}, true},
    {0.134, 0.000, 0.066, {0.090, 0.204, 0.082}, true},
    {0.136, 0.000, 0.072, {0.086, 0.176, 0.094}, true},
    {0.135, -0.004, 0.076, {0.074, 0.150, 0.104}, true},
    {0.131, -0.008, 0.078, {0.056, 0.128, 0.112}, true},
    {0.118, -0.030, 0.070, {0.016, 0.118, 0.116}, false},
    {0.088, -0.062, 0.050, {-0.040, 0.120, 0.096}, false},
}};

Vector3d findSternum(double t) {
  return Vector3d(0.030, 0.374, 0) + t * Vector3d(0.062, -0.150, 0);
}

Mesh makeRib(int number) {
  const Rib& rib = kRibs[static_cast<std::size_t>(number)];
  const SpinePlace spine = findVertebra(kFirstCervical - 1 - number);
  const Vector3d root = spine.position + Vector3d(-0.6 * spine.radius, 0.004, 0.6 * spine.radius);
  const Vector3d angle = root + Vector3d(-0.022, -0.004, 0.030 - 0.012 * (number == 0));
  const Vector3d side(rib.side_x, root.y() - rib.side_drop, rib.side_z);
  const Vector3d back = 0.5 * (angle + side) + Vector3d(-0.024, 0.006, 0.020);
  const Vector3d fore = 0.5 * (side + rib.front) + Vector3d(0.022, -0.006, 0.020);
  TubeForm bone = {6, 2, 1, {Vector3d::UnitX(), 0.5}};
  bone.thin_from_axis = true;
  Mesh mesh = makeTube({{root, 0.0052},
                        {angle, 0.0068},
                        {back, 0.0075},
                        {side, 0.0072},
                        {fore, 0.0070},
                        {rib.front, 0.0066}},
                       bone);
  if (rib.to_sternum) {
    const double t = std::min(1.0, 0.06 + 0.145 * number);
    const Vector3d end = findSternum(t) + Vector3d(0, 0, 0.012);
    const Vector3d knee =
        0.5 * (rib.front + end) + Vector3d(0.010, number < 4 ? 0.0 : -0.006 * (number - 3), 0.004);
    appendMesh(mesh, makeTube({{rib.front, 0.0060}, {knee, 0.0056}, {end, 0.0054}}, {6, 2, 1, {}}));
  }
  return mesh;
}

Mesh makeSternum() {
  Solid sternum;
  const CrossSection flat = {Vector3d(0.92, 0.38, 0).normalized(), 0.38};
  sternum.addStroke({{{0.030, 0.378, 0}, 0.0230}, {{0.040, 0.352, 0}, 0.0150}}, 0.0, flat);
  sternum.addStroke(
      {{{0.041, 0.348, 0}, 0.0140}, {{0.066, 0.290, 0}, 0.0160}, {{0.088, 0.236, 0}, 0.0150}},
      0.006,
      flat);
  sternum.addStroke({{{0.090, 0.230, 0}, 0.0090}, {{0.094, 0.206, 0}, 0.0050}}, 0.006, flat);
  return sternum.makeMesh(Vector3d::Constant(0.0085));
}

}  // namespace

Mesh makeRibcage() {
  Mesh mesh;
  for (int number = 0; number < static_cast<int>(kRibs.size()); ++number) {
    appendMesh(mesh, makeRib(number));
  }
  Mesh left = mesh;
  scaleMesh(left, {1, 1, -1});
  appendMesh(mesh, left);
  appendMesh(mesh, makeSternum());
  return mesh;
}

namespace {

Mesh makeScapula() {
  Solid scapula;
  // Blade behind the ribs: rows from the upper edge to the lower angle, from the spine outward.
  scapula.addSheet({{{{-0.072, 0.386, 0.072}, 0.0042},
                     {{-0.056, 0.390, 0.100}, 0.0048},
                     {{-0.030, 0.386, 0.130}, 0.0040}},
                    {{{-0.088, 0.352, 0.066}, 0.0042},
                     {{-0.074, 0.354, 0.096}, 0.0048},
                     {{-0.026, 0.368, 0.140}, 0.0060}},
                    {{{-0.094, 0.310, 0.074}, 0.0042},
                     {{-0.084, 0.312, 0.094}, 0.0048},
                     {{-0.056, 0.324, 0.122}, 0.0040}},
                    {{{-0.092, 0.266, 0.088}, 0.0048},
                     {{-0.088, 0.264, 0.095}, 0.0048},
                     {{-0.080, 0.270, 0.102}, 0.0048}}},
                   0.0);
  // Spine with acromion, coracoid process, socket.
  scapula.addStroke({{{-0.092, 0.358, 0.070}, 0.0045},
                     {{-0.088, 0.374, 0.106}, 0.0052},
                     {{-0.056, 0.396, 0.150}, 0.0062},
                     {{-0.022, 0.404, 0.172}, 0.0080},
                     {{0.002, 0.402, 0.170}, 0.0065}},
                    0.006);
  scapula.addStroke({{{-0.024, 0.380, 0.134}, 0.0070},
                     {{0.006, 0.392, 0.132}, 0.0062},
                     {{0.024, 0.380, 0.144}, 0.0058}},
                    0.008);
  scapula.addEllipsoid({-0.014, 0.368, 0.142}, {0.0125, 0.0190, 0.0090}, 0.010);
  scapula.carveEllipsoid({0.003, 0.3715, 0.170}, {0.0255, 0.0255, 0.0255}, 0.003);
  return scapula.makeMesh({0.0048, 0.0095, 0.0056});
}

Mesh makeClavicle() {
  return makeTube({{{0.034, 0.386, 0.016}, 0.0100},
                   {{0.046, 0.392, 0.044}, 0.0068},
                   {{0.040, 0.400, 0.082}, 0.0058},
                   {{0.010, 0.408, 0.124}, 0.0062},
                   {{0.000, 0.408, 0.156}, 0.0075}},
                  {9, 3, 1, {}});
}

}  // namespace

Mesh makeShoulderGirdle() {
  Mesh mesh = makeScapula();
  appendMesh(mesh, makeClavicle());
  Mesh left = mesh;
  scaleMesh(left, {1, 1, -1});
  appendMesh(mesh, left);
  return mesh;
}

Mesh makeTorsoBones() {
  Mesh mesh = makeSpine();
  appendMesh(mesh, makeRibcage());
  appendMesh(mesh, makeShoulderGirdle());
  appendMesh(mesh, makeSkull());
  return mesh;
}

}  // namespace gaitmill
