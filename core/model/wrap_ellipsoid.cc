#include "core/model/wrap_ellipsoid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "core/base/error.h"
#include "core/base/units.h"

namespace gaitmill {

namespace {

using Eigen::Vector3d;
using Status = WrapContact::Status;

// Coordinates divided by the semi-axes ("unit space") turn the ellipsoid into the unit sphere and
// keep planes, tangents and sides; only lengths and directions must be measured outside of it.

/// A point of a geodesic with the distance to its neighbour, which leaves P1 at a small angle.
struct GeodesicPoint {
  Vector3d x;             ///< on the ellipsoid
  Vector3d t;             ///< unit direction
  double s = 0;           ///< arc length from the start
  double apart = 1;       ///< Jacobi field: distance of the neighbour, 1 at the start
  double apart_rate = 0;  ///< its derivative by arc length
};

GeodesicPoint operator+(const GeodesicPoint& a, const GeodesicPoint& b) {
  return {a.x + b.x, a.t + b.t, a.s + b.s, a.apart + b.apart, a.apart_rate + b.apart_rate};
}
GeodesicPoint operator*(double k, const GeodesicPoint& a) {
  return {k * a.x, k * a.t, k * a.s, k * a.apart, k * a.apart_rate};
}

/// Derivative of a geodesic by the angle travelled in unit space, which resolves sharp edges as
/// well as flat sides. M = 1 / semi_axes^2 as a diagonal:
///   x' = t,  t' = -(t M t) M x / |M x|^2,  apart'' = -K apart,  K = det M / |M x|^4   by arc
///   length
GeodesicPoint calcDerivative(const Vector3d& M, double det_M, const GeodesicPoint& at) {
  const Vector3d Mx = M.cwiseProduct(at.x);
  const double Mx2 = Mx.squaredNorm();
  const double tMt = at.t.dot(M.cwiseProduct(at.t));
  const double rate = 1 / std::sqrt(tMt);
  return {rate * at.t,
          (-rate * tMt / Mx2) * Mx,
          rate,
          rate * at.apart_rate,
          -rate * det_M / (Mx2 * Mx2) * at.apart};
}

/// One step of Butcher's Runge-Kutta method of sixth order in seven stages (1964).
GeodesicPoint step(const Vector3d& M, double det_M, const GeodesicPoint& at, double h) {
  const auto slope = [&](const GeodesicPoint& point) {
    return calcDerivative(M, det_M, point);
  };
  const GeodesicPoint k1 = slope(at);
  const GeodesicPoint k2 = slope(at + h / 3 * k1);
  const GeodesicPoint k3 = slope(at + h * 2 / 3 * k2);
  const GeodesicPoint k4 = slope(at + h / 12 * (k1 + 4 * k2 + -1 * k3));
  const GeodesicPoint k5 = slope(at + h / 48 * (25 * k1 + -110 * k2 + 35 * k3 + 90 * k4));
  const GeodesicPoint k6 =
      slope(at + h / 120 * (18 * k1 + -55 * k2 + -15 * k3 + 60 * k4 + 12 * k5));
  const GeodesicPoint k7 =
      slope(at + h / 780 * (-783 * k1 + 1980 * k2 + 215 * k3 + -2360 * k4 + 128 * k5 + 1600 * k6));
  return at + h / 200 * (13 * (k1 + k7) + 55 * (k3 + k4) + 32 * (k5 + k6));
}

/// A path over the ellipsoid: where it starts, in unit space, and the angle that it travels there.
struct Start {
  Vector3d xi = Vector3d::UnitX();
  double angle = 0;
};

/// The section of a plane through the ends, in unit space: a circle with tangents from both ends.
struct Section {
  Start start;
  Vector3d xi2 = Vector3d::UnitX();  ///< where it ends
  Vector3d center = Vector3d::Zero();
  Vector3d normal = Vector3d::UnitZ();  ///< about which it turns
  double turn = 0;                      ///< > 0
};

/// @param crest  point of the plane, in unit space, on the side that the path goes over
Section makeSection(const Vector3d& eta1, const Vector3d& eta2, const Vector3d& crest) {
  Section section;
  // Seen along the normal, the path over the crest turns forward.
  section.normal = (crest - eta1).cross(eta2 - eta1).normalized();
  const Vector3d& n = section.normal;
  const double height = n.dot(eta1);
  section.center = height * n;
  const double rho2 = 1 - height * height;
  const auto touch = [&](const Vector3d& eta, double side) -> Vector3d {
    const Vector3d v = eta - section.center;
    const double d2 = v.squaredNorm();
    const double c = rho2 / d2;
    const double s = std::sqrt(std::fmax(0.0, rho2 * (d2 - rho2))) / d2;
    return section.center + c * v + side * s * n.cross(v);
  };
  section.start.xi = touch(eta1, 1);
  section.xi2 = touch(eta2, -1);
  const Vector3d from = section.start.xi - section.center;
  const Vector3d to = section.xi2 - section.center;
  section.turn = std::atan2(n.dot(from.cross(to)), from.dot(to));
  section.turn += section.turn < 0 ? 2 * kPi : 0.0;
  section.start.angle = section.turn * std::sqrt(rho2);
  return section;
}

/// Length of a section's arc: the integral of a smooth function of the turn, by Simpson's rule.
double calcSectionLength(const Vector3d& semi_axes, const Section& section, int intervals) {
  const Vector3d from = section.start.xi - section.center;
  const Vector3d across = section.normal.cross(from);
  double sum = 0;
  for (int i = 0; i <= intervals; ++i) {
    const double angle = section.turn * i / intervals;
    const Vector3d along = std::cos(angle) * across - std::sin(angle) * from;
    const double weight = i == 0 || i == intervals ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    sum += weight * semi_axes.cwiseProduct(along).norm();
  }
  return sum * section.turn / (3 * intervals);
}

/// Solves for the geodesic between the tangents from P1 and to P2.
class GeodesicShooter {
 public:
  GeodesicShooter(const WrapEllipsoid& ellipsoid, const Vector3d& P1, const Vector3d& P2)
      : ellipsoid_(ellipsoid),
        P1_(P1),
        P2_(P2),
        M_(ellipsoid.semi_axes.cwiseAbs2().cwiseInverse()),
        det_M_(M_.prod()) {}

  /// @param contact  out: tangent points and length
  /// @param middle   out: a point half way
  /// @returns false if no geodesic was found from this start
  bool solve(const Start& guess, WrapContact& contact, Vector3d& middle) const {
    Start start = guess;
    Start last = guess;
    double shift = 0;
    double last_miss = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
      const Shot shot = shoot(ellipsoid_.semi_axes.cwiseProduct(start.xi), start.angle, middle);
      const bool usable = shot.left > 0 && std::isfinite(shot.miss) && start.angle > 0;
      if (!usable || std::abs(shot.miss) > last_miss) {
        // Too far: half the way from the last start that was better.
        shift *= 0.5;
        start = turnStart(last, shift);
        continue;
      }
      const double spread = shot.end.apart + shot.end.apart_rate * shot.left;
      if (std::abs(shot.miss) < kMissTolerance && std::abs(shot.angle_change) < kAngleTolerance) {
        contact.r1 = ellipsoid_.semi_axes.cwiseProduct(start.xi);
        contact.r2 = shot.end.x;
        contact.surface_length = shot.end.s;
        return spread > 0;
      }
      last_miss = std::max(std::abs(shot.miss), kMissTolerance);
      last = {start.xi, start.angle + shot.angle_change};
      // Beyond a conjugate point neighbours have crossed; the miss still tells the slope of the
      // length, so the step stays one downhill.
      const double reach = 0.5 * ellipsoid_.semi_axes.minCoeff();
      shift = std::clamp(shot.miss / std::max(std::abs(spread), kLeastSpread), -reach, reach);
      start = turnStart(last, shift);
    }
    return false;
  }

 private:
  static constexpr int kMaxIterations = 40;
  static constexpr double kMissTolerance = 1e-12;  // [m]: moment arms are first order in it
  static constexpr double kAngleTolerance = 1e-7;  // [rad]: the end itself is exact
  static constexpr double kLeastSpread = 1e-3;     // neighbours meet: no unique shortest path

  struct Shot {
    GeodesicPoint end;
    double angle_change = 0;  ///< from the angle asked for to the edge as P2 sees it
    double left = 0;          ///< from the end on along the tangent, to beside P2 [m]
    double miss = 0;          ///< of P2 to the side of the tangent [m]
  };

  /// Goes from r1 by `angle`, then on or back to where P2 is seen edge-on.
  Shot shoot(const Vector3d& r1, double angle, Vector3d& middle) const {
    const double distance = (r1 - P1_).norm();
    Shot shot{{r1, (r1 - P1_) / distance, 0.0, 1.0, 1.0 / distance}, 0.0, 0.0, 0.0};
    const double h = angle / ellipsoid_.steps;
    for (int i = 0; i < ellipsoid_.steps; ++i) {
      if (i == ellipsoid_.steps / 2) {
        middle = shot.end.x;
      }
      shot.end = step(M_, det_M_, shot.end, h);
    }
    for (int i = 0; i < 3; ++i) {
      // On along the path by d, P2 stands over the tangent plane by H + curvature (left d - d^2 /
      // 2).
      const Vector3d to_P2 = P2_ - shot.end.x;
      const double tMt = shot.end.t.dot(M_.cwiseProduct(shot.end.t));
      const double left = to_P2.dot(shot.end.t);
      const double drop = 2 * to_P2.dot(M_.cwiseProduct(shot.end.x)) / tMt;
      const double root = std::sqrt(std::fmax(0.0, left * left + drop));
      const double on = left > 0 ? -drop / (left + root) : left - root;
      const double change = std::clamp(on * std::sqrt(tMt), -0.2, 0.2);
      if (!std::isfinite(change) || std::abs(change) < 1e-16) {
        break;
      }
      shot.end = step(M_, det_M_, shot.end, change);
      shot.angle_change += change;
    }
    const Vector3d n = M_.cwiseProduct(shot.end.x).normalized();
    const Vector3d to_P2 = P2_ - shot.end.x;
    shot.left = to_P2.dot(shot.end.t);
    shot.miss = to_P2.dot(n.cross(shot.end.t));
    return shot;
  }

  /// Moves a start by `shift` [m] sideways, on the edge that P1 sees: in unit space a circle about
  /// the direction of P1.
  Start turnStart(const Start& start, double shift) const {
    const Vector3d& axes = ellipsoid_.semi_axes;
    const Vector3d eta1 = P1_.cwiseQuotient(axes).normalized();
    const Vector3d r1 = axes.cwiseProduct(start.xi);
    const Vector3d along_edge = axes.cwiseProduct(eta1.cross(start.xi));
    const Vector3d n1 = M_.cwiseProduct(r1).normalized();
    const double edge_side = along_edge.dot(n1.cross((r1 - P1_).normalized()));
    constexpr double kMaximumTurn = 0.4;  // [rad]
    const double turn = std::clamp(shift / edge_side, -kMaximumTurn, kMaximumTurn);
    return {(Eigen::AngleAxisd(turn, eta1) * start.xi).normalized(), start.angle};
  }

  const WrapEllipsoid& ellipsoid_;
  Vector3d P1_;
  Vector3d P2_;
  Vector3d M_;
  double det_M_;
};

/// Where the shortest way out of the ellipsoid leads from a point of the line, at right angles to
/// the line, and the second shortest: the ends of a path's crest.
struct Crests {
  Vector3d near = Vector3d::Zero();
  Vector3d far = Vector3d::Zero();
  bool is_close = false;  ///< the two are nearly as far
};

/// The point of the ellipse (x/a)^2 + (y/b)^2 = 1, a >= b, nearest to a point inside it, by
/// Newton's method on the multiplier: monotone from the left (Eberly, Distance from a point to an
/// ellipse).
Eigen::Vector2d findNearest(double a, double b, Eigen::Vector2d p) {
  constexpr double kOnAxis = 1e-9;
  constexpr int kIterations = 12;  // it is but a first guess of the crest
  p.y() = std::copysign(std::fmax(std::abs(p.y()), kOnAxis * b), p.y());
  double multiplier = -b * b + b * std::abs(p.y());
  for (int i = 0; i < kIterations; ++i) {
    const double u = a * p.x() / (a * a + multiplier);
    const double v = b * p.y() / (b * b + multiplier);
    const double value = u * u + v * v - 1;
    const double slope = -2 * (u * u / (a * a + multiplier) + v * v / (b * b + multiplier));
    multiplier -= value / slope;
    if (std::abs(value) < 1e-6) {
      break;
    }
  }
  return {a * a * p.x() / (a * a + multiplier), b * b * p.y() / (b * b + multiplier)};
}

/// @param m  point of the line inside the ellipsoid
/// @param d  direction of the line
Crests findCrests(const Vector3d& semi_axes, const Vector3d& m, const Vector3d& d) {
  const Vector3d M = semi_axes.cwiseAbs2().cwiseInverse();
  // The section across the line: an ellipse in the plane of e1 and e2.
  const Vector3d e1 = d.unitOrthogonal();
  const Vector3d e2 = d.normalized().cross(e1);
  const double A11 = e1.dot(M.cwiseProduct(e1));
  const double A12 = e1.dot(M.cwiseProduct(e2));
  const double A22 = e2.dot(M.cwiseProduct(e2));
  const Eigen::Vector2d g(e1.dot(M.cwiseProduct(m)), e2.dot(M.cwiseProduct(m)));
  const double det = A11 * A22 - A12 * A12;
  const Eigen::Vector2d center(-(A22 * g.x() - A12 * g.y()) / det,
                               -(A11 * g.y() - A12 * g.x()) / det);
  const double size = 1 - m.dot(M.cwiseProduct(m)) - g.dot(center);
  // Its principal axes, the longer one first.
  const double angle = 0.5 * std::atan2(2 * A12, A11 - A22) + kPi / 2;
  const Eigen::Vector2d major(std::cos(angle), std::sin(angle));
  const Eigen::Vector2d minor(-major.y(), major.x());
  const auto radius = [&](const Eigen::Vector2d& along) {
    const double curvature =
        A11 * along.x() * along.x() + 2 * A12 * along.x() * along.y() + A22 * along.y() * along.y();
    return std::sqrt(size / curvature);
  };
  const double a = radius(major);
  const double b = radius(minor);
  const Eigen::Vector2d inside(-center.dot(major), -center.dot(minor));
  const Eigen::Vector2d near = findNearest(a, b, inside);
  const auto place = [&](double along_major, double along_minor) -> Vector3d {
    const Eigen::Vector2d at = center + along_major * major + along_minor * minor;
    return m + at.x() * e1 + at.y() * e2;
  };
  // Far enough off the longer axis, the other side is a detour.
  constexpr double kClose = 0.3;
  return {place(near.x(), near.y()), place(near.x(), -near.y()), std::abs(inside.y()) < kClose * b};
}

/// Takes the geodesic over the crest, failing that the plane's section.
void followCrest(const WrapEllipsoid& ellipsoid,
                 const Vector3d& P1,
                 const Vector3d& P2,
                 const Vector3d& crest,
                 WrapContact& contact) {
  // From the end nearer to the surface: small as the edge is that it sees, the geodesics fan out
  // from it, where towards it they all but miss.
  if (P2.cwiseQuotient(ellipsoid.semi_axes).squaredNorm() <
      P1.cwiseQuotient(ellipsoid.semi_axes).squaredNorm()) {
    followCrest(ellipsoid, P2, P1, crest, contact);
    std::swap(contact.r1, contact.r2);
    return;
  }
  const Section section = makeSection(P1.cwiseQuotient(ellipsoid.semi_axes),
                                      P2.cwiseQuotient(ellipsoid.semi_axes),
                                      crest.cwiseQuotient(ellipsoid.semi_axes));
  Vector3d middle = Vector3d::Zero();
  if (GeodesicShooter(ellipsoid, P1, P2).solve(section.start, contact, middle) &&
      ellipsoid.half_space.holds(middle)) {
    return;
  }
  contact.r1 = ellipsoid.semi_axes.cwiseProduct(section.start.xi);
  contact.r2 = ellipsoid.semi_axes.cwiseProduct(section.xi2);
  contact.surface_length = calcSectionLength(ellipsoid.semi_axes, section, 2 * ellipsoid.steps);
}

double calcTotal(const WrapContact& contact, const Vector3d& P1, const Vector3d& P2) {
  return (contact.r1 - P1).norm() + contact.surface_length + (P2 - contact.r2).norm();
}

}  // namespace

WrapEllipsoid makeWrapEllipsoid(const WrapObjectSpec& spec) {
  require(spec.semi_axes.allFinite() && spec.semi_axes.minCoeff() > 0,
          ErrorCode::kModelValue,
          "wrap ellipsoid '" + spec.name + "' needs three positive dimensions",
          {{}, 0, 0, spec.name});
  WrapEllipsoid ellipsoid{spec.semi_axes, parseQuadrant(spec.quadrant, spec.name), 0};
  // Enough for 1e-9 of the length up to an axis ratio of 10, the largest of the Arnold leg's.
  constexpr double kLeastSteps = 12;
  constexpr double kStepsPerRatio = 2.5;
  const double ratio = spec.semi_axes.maxCoeff() / spec.semi_axes.minCoeff();
  ellipsoid.steps = static_cast<int>(std::fmin(kLeastSteps + kStepsPerRatio * (ratio - 1), 100.0));
  return ellipsoid;
}

WrapContact calcWrapContact(const WrapEllipsoid& ellipsoid,
                            const Vector3d& P1,
                            const Vector3d& P2) {
  WrapContact contact;
  const Vector3d eta1 = P1.cwiseQuotient(ellipsoid.semi_axes);
  const Vector3d eta2 = P2.cwiseQuotient(ellipsoid.semi_axes);
  if (eta1.squaredNorm() <= 1 || eta2.squaredNorm() <= 1) {
    contact.status = Status::kInside;
    return contact;
  }
  const Vector3d d = eta2 - eta1;
  const double t = -eta1.dot(d) / d.squaredNorm();
  const Vector3d foot = eta1 + t * d;
  if (!(t > 0 && t < 1 && foot.squaredNorm() < 1)) {
    return contact;
  }
  contact.status = Status::kMandatory;

  Crests crests = findCrests(ellipsoid.semi_axes, ellipsoid.semi_axes.cwiseProduct(foot), P2 - P1);
  const HalfSpace& half = ellipsoid.half_space;
  if (!half.holds(crests.near)) {
    crests.near[half.axis] = -crests.near[half.axis];
  }
  followCrest(ellipsoid, P1, P2, crests.near, contact);
  if (half.axis < 0 && crests.is_close) {
    WrapContact other = contact;
    followCrest(ellipsoid, P1, P2, crests.far, other);
    contact = calcTotal(other, P1, P2) < calcTotal(contact, P1, P2) ? other : contact;
  }
  return contact;
}

void traceSurface(const WrapEllipsoid& ellipsoid,
                  const Vector3d& P1,
                  const WrapContact& contact,
                  int count,
                  std::vector<Vector3d>& points) {
  const Vector3d M = ellipsoid.semi_axes.cwiseAbs2().cwiseInverse();
  const std::size_t first = points.size();
  GeodesicPoint at{contact.r1, (contact.r1 - P1).stableNormalized(), 0.0, 1.0, 0.0};
  const double ds = contact.surface_length / (count + 1);
  constexpr int kSubsteps = 4;
  for (int i = 1; i <= count + 1; ++i) {
    for (int k = 0; k < kSubsteps; ++k) {
      const double rate = std::sqrt(at.t.dot(M.cwiseProduct(at.t)));
      at = step(M, M.prod(), at, ds / kSubsteps * rate);
    }
    points.push_back(at.x);
  }
  // Steps are equal in arc length only nearly: what is left at the end is shared out.
  const Vector3d gap = contact.r2 - points.back();
  points.pop_back();
  for (std::size_t i = first; i < points.size(); ++i) {
    points[i] += static_cast<double>(i - first + 1) / (count + 1) * gap;
  }
}

}  // namespace gaitmill
