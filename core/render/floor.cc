#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/units.h"
#include "core/render/color_scale.h"
#include "core/render/scene.h"

namespace gaitmill {

namespace {

constexpr Rgb kFloorColor{214, 219, 226};
constexpr Rgb kShadowColor{120, 130, 146};
constexpr Rgb kGridColor{150, 160, 174};
constexpr double kGridWidth = 0.006;  // [m]
constexpr double kLineWidth = 0.03;   // [m] seen at a flat angle
constexpr double kGridOpacity = 0.7;
constexpr int kRadialSteps = 40;
constexpr int kAngularSteps = 64;
constexpr int kGridSteps = 24;

// A bone above the floor darkens what lies below it, more softly the higher it is.
struct Shade {
  Eigen::Vector2d center;  // x and z in ground [m]
  double spread = 0;       // [m]
  double strength = 0;
};

// A box around the bones of one body, in its frame.
struct BodyBox {
  Eigen::Vector3f lowest = Eigen::Vector3f::Constant(1e9F);
  Eigen::Vector3f highest = Eigen::Vector3f::Constant(-1e9F);
};

std::vector<Shade> makeShades(const Subject& subject) {
  std::map<int, BodyBox> boxes;
  for (const BodyMesh& bone : subject.bones()) {
    BodyBox& box = boxes[bone.body.value()];
    for (const Eigen::Vector3f& v : bone.mesh.vertices) {
      box.lowest = box.lowest.cwiseMin(v);
      box.highest = box.highest.cwiseMax(v);
    }
  }
  std::vector<Shade> shades;
  for (const auto& [body, box] : boxes) {
    if (!(box.lowest.array() <= box.highest.array()).all()) continue;
    const Eigen::Vector3d middle = (0.5F * (box.lowest + box.highest)).cast<double>();
    const double size = 0.5 * static_cast<double>((box.highest - box.lowest).norm());
    const Eigen::Vector3d p = subject.pose(BodyIndex(body)) * middle;
    const double spread = 0.03 + 0.45 * size + 0.2 * std::max(0.0, p.y());
    shades.push_back({{p.x(), p.z()}, spread, 0.6 * size / (spread + size)});
  }
  return shades;
}

double findShade(const std::vector<Shade>& shades, double x, double z) {
  double light = 1;
  for (const Shade& shade : shades) {
    const double distance = (shade.center - Eigen::Vector2d(x, z)).squaredNorm();
    const double exponent = distance / (shade.spread * shade.spread);
    if (exponent < 9) light *= 1 - shade.strength * std::exp(-exponent);
  }
  return 1 - light;
}

// Opaque in the middle, gone at the rim.
double calcFade(double distance, double radius) {
  const double t = std::clamp(distance / radius, 0.0, 1.0);
  return (1 - t * t) * (1 - t * t);
}

void addFloorVertex(double x, double z, const Rgb& color, double opacity, Surface& surface) {
  surface.vertices.push_back(
      {Eigen::Vector3d(x, 0, z).cast<float>(),
       Eigen::Vector3f::UnitY(),
       color,
       static_cast<std::uint8_t>(std::lround(255 * std::clamp(opacity, 0.0, 1.0)))});
}

void addDisc(const Eigen::Vector3d& center,
             double radius,
             const std::vector<Shade>& shades,
             Surface& surface) {
  const std::uint32_t first = surface.nextIndex();
  for (int ring = 0; ring <= kRadialSteps; ++ring) {
    // Finer near the feet.
    const double share = static_cast<double>(ring) / kRadialSteps;
    const double distance = radius * share * (0.4 + 0.6 * share);
    for (int side = 0; side < kAngularSteps; ++side) {
      const double angle = 2 * kPi * side / kAngularSteps;
      const double x = center.x() + distance * std::cos(angle);
      const double z = center.z() + distance * std::sin(angle);
      const double shade = findShade(shades, x, z);
      const double fade = calcFade(distance, radius);
      addFloorVertex(x, z, blend(kFloorColor, kShadowColor, shade), fade, surface);
    }
  }
  const auto n = static_cast<std::uint32_t>(kAngularSteps);
  for (std::uint32_t ring = 0; ring < kRadialSteps; ++ring) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = first + ring * n + i, b = first + ring * n + (i + 1) % n;
      surface.addTriangle(a, b, a + n);
      surface.addTriangle(b, b + n, a + n);
    }
  }
}

// One line of the grid along x or z, cut into pieces so that its fading follows the circle.
void addGridLine(
    const Eigen::Vector3d& center, int axis, double offset, double radius, Surface& s) {
  const double half = std::sqrt(std::max(0.0, radius * radius - offset * offset));
  for (int step = 0; step <= kGridSteps; ++step) {
    const double along = half * (2.0 * step / kGridSteps - 1);
    const double opacity = kGridOpacity * calcFade(std::hypot(along, offset), radius);
    for (const double side : {-0.5 * kGridWidth, 0.5 * kGridWidth}) {
      const double x = center.x() + (axis == 0 ? along : offset + side);
      const double z = center.z() + (axis == 0 ? offset + side : along);
      addFloorVertex(x, z, kGridColor, opacity, s);
    }
    if (step == kGridSteps) break;
    const std::uint32_t next = s.nextIndex();
    s.addTriangle(next - 2, next - 1, next);
    s.addTriangle(next - 1, next, next + 1);
  }
}

// From one edge of a strip's pose to the other.
void addLine(const Eigen::Vector3d& center, const Eigen::Vector3d& half_line, Surface& surface) {
  const Eigen::Vector3d along = half_line.normalized();
  const Eigen::Vector3d across = 0.5 * kLineWidth * Eigen::Vector3d(-along.z(), 0, along.x());
  const std::uint32_t first = surface.nextIndex();
  for (const double end : {-1.0, 1.0}) {
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Vector3d p = center + end * half_line + side * across;
      addFloorVertex(p.x(), p.z(), kGridColor, 1, surface);
    }
  }
  surface.addTriangle(first, first + 1, first + 2);
  surface.addTriangle(first + 1, first + 3, first + 2);
}

}  // namespace

void makeFloor(const Subject& subject, const FloorStyle& style, Surface& surface) {
  const Eigen::Vector3d center = subject.findFollowPoint();
  addDisc(center, style.radius, makeShades(subject), surface);
  if (style.half_line.norm() > 0) addLine(center, style.half_line, surface);
  if (style.grid_spacing <= 0) return;
  for (const int axis : {0, 1}) {
    // Lines stand still in the laboratory while the camera goes along.
    const double across = axis == 0 ? center.z() : center.x();
    const double spacing = style.grid_spacing;
    const int first = static_cast<int>(std::ceil((across - style.radius) / spacing));
    const int last = static_cast<int>(std::floor((across + style.radius) / spacing));
    for (int line = first; line <= last; ++line) {
      addGridLine(center, axis, line * spacing - across, style.radius, surface);
    }
  }
}

}  // namespace gaitmill
