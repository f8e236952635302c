#include "core/render/solid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace gaitmill {

namespace {

using Vector3d = Eigen::Vector3d;
using Vector2d = Eigen::Vector2d;

constexpr int kStrokePieces = 4;  // straight pieces between two points of a stroke
constexpr int kSheetPieces = 2;   // plane pieces between two points of a net, either way

double smoothMinimum(double a, double b, double width) {
  const double h = width > 0 ? std::max(width - std::abs(a - b), 0.0) / width : 0.0;
  return std::min(a, b) - h * h * width / 4;
}

// An ellipsoid's distance to first order: exact on the surface, with the right gradient there.
double calcScaledDistance(const Vector3d& local, const Vector3d& radii) {
  const Vector3d scaled = local.cwiseQuotient(radii);
  const double slope = scaled.cwiseQuotient(radii).norm();
  const double k = scaled.norm();
  return slope < 1e-12 ? -radii.minCoeff() : k * (k - 1) / slope;
}

// Weights of the triangle's corners for its point nearest to p.
Vector3d findNearestWeights(const Vector3d& first_side,
                            const Vector3d& second_side,
                            const Eigen::Matrix2d& inverse_gram,
                            const Vector3d& p) {
  const Vector2d uv = inverse_gram * Vector2d(first_side.dot(p), second_side.dot(p));
  if (uv[0] >= 0 && uv[1] >= 0 && uv.sum() <= 1) {
    return {1 - uv.sum(), uv[0], uv[1]};
  }
  const Vector3d third_side = second_side - first_side;
  const double a = std::clamp(first_side.dot(p) / first_side.squaredNorm(), 0.0, 1.0);
  const double b = std::clamp(second_side.dot(p) / second_side.squaredNorm(), 0.0, 1.0);
  const double c = std::clamp(third_side.dot(p - first_side) / third_side.squaredNorm(), 0.0, 1.0);
  const Vector3d candidates[3] = {{1 - a, a, 0}, {1 - b, 0, b}, {0, 1 - c, c}};
  const Vector3d* best = candidates;
  double best_distance = std::numeric_limits<double>::infinity();
  for (const Vector3d& weights : candidates) {
    const double distance = (p - weights[1] * first_side - weights[2] * second_side).squaredNorm();
    if (distance < best_distance) {
      best_distance = distance;
      best = &weights;
    }
  }
  return *best;
}

void extendBox(Eigen::AlignedBox3d& box, const Vector3d& p, double radius) {
  box.extend(p + Vector3d::Constant(radius));
  box.extend(p - Vector3d::Constant(radius));
}

template <class List, class Test>
void keepIf(List& list, Test&& test) {
  list.erase(std::remove_if(list.begin(), list.end(), [&](const auto& one) { return !test(one); }),
             list.end());
}

std::vector<StrokePoint> takeColumn(const std::vector<std::vector<StrokePoint>>& rows,
                                    std::size_t column) {
  std::vector<StrokePoint> points;
  for (const auto& row : rows) {
    points.push_back(row[column]);
  }
  return points;
}

}  // namespace

double Solid::calcDistance(const Segment& segment, const CrossSection& section, const Vector3d& p) {
  const Vector3d along = segment.to - segment.from;
  const double t = std::clamp((p - segment.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  const Vector3d offset = p - segment.from - t * along;
  const double radius = segment.from_radius + t * (segment.to_radius - segment.from_radius);
  if (section.flatness == 1) {
    return offset.norm() - radius;
  }
  const double through = offset.dot(section.thin_direction);
  const double across = std::sqrt(std::max(0.0, offset.squaredNorm() - through * through));
  return calcScaledDistance({across, through, 0}, {radius, radius * section.flatness, radius});
}

double Solid::calcDistance(const Stroke& stroke, const Vector3d& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Segment& segment : stroke.segments) {
    nearest = std::min(nearest, calcDistance(segment, stroke.section, p));
  }
  return nearest;
}

double Solid::calcDistance(const Ellipsoid& ellipsoid, const Vector3d& p) {
  return calcScaledDistance(ellipsoid.axes.transpose() * (p - ellipsoid.center), ellipsoid.radii);
}

double Solid::calcDistance(const Triangle& triangle, const Vector3d& p) {
  const Vector3d local = p - triangle.corner;
  const Vector3d weights =
      findNearestWeights(triangle.first_side, triangle.second_side, triangle.inverse_gram, local);
  const Vector3d offset =
      local - weights[1] * triangle.first_side - weights[2] * triangle.second_side;
  return offset.norm() - weights.dot(triangle.radii);
}

double Solid::calcDistance(const Sheet& sheet, const Vector3d& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Triangle& triangle : sheet.triangles) {
    nearest = std::min(nearest, calcDistance(triangle, p));
  }
  return nearest;
}

double Solid::calcDistance(const HalfSpace& space, const Vector3d& p) {
  return space.normal.dot(space.point - p);
}

double Solid::calcDistance(const Part& part, const Vector3d& p) {
  return std::visit([&](const auto& shape) { return calcDistance(shape, p); }, part.shape);
}

double Solid::combine(double distance, const Part& part, double part_distance) {
  return part.carves ? -smoothMinimum(-distance, part_distance, part.blend)
                     : smoothMinimum(distance, part_distance, part.blend);
}

double Solid::calcDistance(const Vector3d& p) const {
  double distance = 1e3;  // nothing yet; finite, so that blending has a difference to take
  for (const Part& part : parts_) {
    distance = combine(distance, part, calcDistance(part, p));
  }
  return distance;
}

Solid& Solid::add(Part part, bool carves, double blend) {
  part.carves = carves;
  part.blend = blend;
  parts_.push_back(std::move(part));
  return *this;
}

Solid::Part Solid::makeStroke(const std::vector<StrokePoint>& points, const CrossSection& section) {
  Part part;
  Stroke stroke;
  stroke.section = section;
  const std::vector<StrokePoint> curve = refineStroke(points, kStrokePieces);
  for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
    const Segment segment = {
        curve[i].position, curve[i + 1].position, curve[i].radius, curve[i + 1].radius};
    extendBox(part.box, segment.from, segment.from_radius);
    extendBox(part.box, segment.to, segment.to_radius);
    stroke.segments.push_back(segment);
  }
  part.shape = std::move(stroke);
  return part;
}

Solid::Part Solid::makeEllipsoid(const Vector3d& center,
                                 const Vector3d& radii,
                                 const Eigen::Matrix3d& axes) {
  Part part;
  part.shape = Ellipsoid{center, radii, axes};
  extendBox(part.box, center, radii.maxCoeff());
  return part;
}

Solid& Solid::addStroke(const std::vector<StrokePoint>& points,
                        double blend,
                        const CrossSection& section) {
  return add(makeStroke(points, section), false, blend);
}

Solid& Solid::carveStroke(const std::vector<StrokePoint>& points, double blend) {
  return add(makeStroke(points, {}), true, blend);
}

Solid& Solid::addEllipsoid(const Vector3d& center,
                           const Vector3d& radii,
                           double blend,
                           const Eigen::Matrix3d& axes) {
  return add(makeEllipsoid(center, radii, axes), false, blend);
}

Solid& Solid::carveEllipsoid(const Vector3d& center,
                             const Vector3d& radii,
                             double blend,
                             const Eigen::Matrix3d& axes) {
  return add(makeEllipsoid(center, radii, axes), true, blend);
}

void Solid::addTriangle(Part& part,
                        const StrokePoint& a,
                        const StrokePoint& b,
                        const StrokePoint& c) {
  const Vector3d first = b.position - a.position;
  const Vector3d second = c.position - a.position;
  if (first.cross(second).norm() < 1e-12) {
    return;  // two corners of the net fall together
  }
  Eigen::Matrix2d gram;
  gram << first.squaredNorm(), first.dot(second), first.dot(second), second.squaredNorm();
  std::get<Sheet>(part.shape)
      .triangles.push_back(
          {a.position, first, second, {a.radius, b.radius, c.radius}, gram.inverse()});
  for (const StrokePoint* corner : {&a, &b, &c}) {
    extendBox(part.box, corner->position, corner->radius);
  }
}

Solid& Solid::addSheet(const std::vector<std::vector<StrokePoint>>& net, double blend) {
  std::vector<std::vector<StrokePoint>> rows;
  for (const auto& row : net) {
    rows.push_back(refineStroke(row, kSheetPieces));
  }
  std::vector<std::vector<StrokePoint>> columns;
  for (std::size_t i = 0; i < rows.front().size(); ++i) {
    columns.push_back(refineStroke(takeColumn(rows, i), kSheetPieces));
  }
  Part part;
  part.shape = Sheet{};
  for (std::size_t i = 0; i + 1 < columns.size(); ++i) {
    for (std::size_t j = 0; j + 1 < columns[i].size(); ++j) {
      addTriangle(part, columns[i][j], columns[i + 1][j], columns[i + 1][j + 1]);
      addTriangle(part, columns[i][j], columns[i + 1][j + 1], columns[i][j + 1]);
    }
  }
  return add(std::move(part), false, blend);
}

Solid& Solid::cut(const Vector3d& point, const Vector3d& normal, double blend) {
  Part part;
  part.shape = HalfSpace{point, normal.normalized()};
  return add(std::move(part), true, blend);
}

Eigen::AlignedBox3d Solid::findBox() const {
  Eigen::AlignedBox3d box;
  for (const Part& part : parts_) {
    if (!part.carves) {
      box.extend(part.box);
    }
  }
  return box;
}

Solid Solid::selectNear(const Vector3d& center, double radius) const {
  // The distances of stretched parts change up to this much faster than the way to them.
  constexpr double kSlack = 1.4;
  const double reach = kSlack * radius;
  Solid near;
  for (const Part& part : parts_) {
    // A part more than a fillet away from the surface does not move it.
    const double limit = reach + part.blend;
    const double distance = calcDistance(part, center);
    if (distance > limit) {
      continue;
    }
    near.parts_.push_back(part);
    // Of a part's pieces those that can be the nearest one.
    const double piece_limit = std::min(distance + 2 * reach, limit);
    if (auto* stroke = std::get_if<Stroke>(&near.parts_.back().shape)) {
      keepIf(stroke->segments, [&](const Segment& segment) {
        return calcDistance(segment, stroke->section, center) <= piece_limit;
      });
    } else if (auto* sheet = std::get_if<Sheet>(&near.parts_.back().shape)) {
      keepIf(sheet->triangles, [&](const Triangle& triangle) {
        return calcDistance(triangle, center) <= piece_limit;
      });
    }
  }
  return near;
}

}  // namespace gaitmill
