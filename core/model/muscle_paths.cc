#include "core/model/muscle_paths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/base/error.h"
#include "core/base/where.h"
#include "core/math/scalar_function.h"
#include "core/model/wrap_surface.h"

namespace gaitmill {

namespace {

using Eigen::Vector3d;

/// Points of one path while it is being computed: the document's and two per surface that it
/// touches.
constexpr int kMaxPathPoints = 24;
constexpr int kMaxWraps = 4;
constexpr int kMaxNodes = kMaxPathPoints + 2 * kMaxWraps;

/// Tangent points of coupled surfaces are iterated until they move less than this [m]: moment arms
/// are first order in their error and shall equal the length's derivative to 1e-8.
constexpr double kTangentTolerance = 1e-12;
constexpr int kMaxPasses = 100;
/// Points closer than this [m] have no direction from one to the other (spec/path.md 3).
constexpr double kCoincident = 2.01e-14;

struct Point {
  BodyIndex body;
  int slot = 0;  ///< which of the path's distinct bodies
  Vector3d p_B = Vector3d::Zero();
};

/// A document's limits of a coordinate are met within this [rad|m] (spec/path.md 1).
constexpr double kConditionTolerance = 1e-5;

/// A point that is part of the path only while its coordinate is in a range.
struct Condition {
  int point = 0;
  int coordinate = -1;  ///< −1 = never
  double min = 0;
  double max = 0;
  bool holds(const Eigen::VectorXd& q) const {
    return coordinate >= 0 && q[coordinate] >= min && q[coordinate] <= max;
  }
};

/// A point whose place on its body is a function of a coordinate, held still beyond its range.
struct Motion {
  int point = 0;
  int coordinate = 0;
  double min = 0;
  double max = 0;
  std::array<ScalarFunction, 3> location;
};

struct Wrap {
  BodyIndex body;
  int slot = 0;
  WrapSurface surface;
  Pose X_BW;
  int first_point = 0;  ///< 0-based, inclusive
  int last_point = 0;
};

/// A coordinate that changes a path, with the path's bodies that it moves.
struct Arm {
  int coordinate = 0;
  unsigned distal_slots = 0;
};

struct Node {
  Vector3d p_G;
  int slot = 0;
  int point = -1;      ///< document point, or
  int wrap = -1;       ///< the wrap object whose tangent point this is
  double surface = 0;  ///< length to the next node where both are tangent points of one surface
};

struct Path {
  std::vector<Point> points;
  std::vector<Condition> conditions;  ///< by point
  std::vector<Motion> motions;        ///< by point
  std::vector<Wrap> wraps;
  std::vector<BodyIndex> bodies;
  std::vector<Arm> arms;
};

struct NodeList {
  std::array<Node, kMaxNodes> nodes;
  int count = 0;

  void insert(int position, const Node& first, const Node& second) {
    for (int i = count - 1; i >= position; --i) {
      nodes[static_cast<std::size_t>(i + 2)] = nodes[static_cast<std::size_t>(i)];
    }
    nodes[static_cast<std::size_t>(position)] = first;
    nodes[static_cast<std::size_t>(position + 1)] = second;
    count += 2;
  }
  void removeWrap(int wrap) {
    int kept = 0;
    for (int i = 0; i < count; ++i) {
      if (nodes[static_cast<std::size_t>(i)].wrap != wrap) {
        nodes[static_cast<std::size_t>(kept++)] = nodes[static_cast<std::size_t>(i)];
      }
    }
    count = kept;
  }
  const Node& operator[](int i) const { return nodes[static_cast<std::size_t>(i)]; }
};

Pose makePose(const Vector3d& rotation, const Vector3d& translation) {
  Pose pose;
  pose.R = (Eigen::AngleAxisd(rotation.x(), Vector3d::UnitX()) *
            Eigen::AngleAxisd(rotation.y(), Vector3d::UnitY()) *
            Eigen::AngleAxisd(rotation.z(), Vector3d::UnitZ()))
               .toRotationMatrix();
  pose.p = translation;
  return pose;
}

Pose compose(const Pose& X_AB, const Pose& X_BC) {
  return {X_AB.R * X_BC.R, X_AB * X_BC.p};
}

int findSlot(Path& path, BodyIndex body) {
  const auto found = std::find(path.bodies.begin(), path.bodies.end(), body);
  if (found != path.bodies.end()) {
    return static_cast<int>(found - path.bodies.begin());
  }
  path.bodies.push_back(body);
  return static_cast<int>(path.bodies.size()) - 1;
}

struct NamedWrap {
  BodyIndex body;
  const WrapObjectSpec* spec = nullptr;
};

NamedWrap findWrapObject(const Model& model, const std::string& name, const std::string& muscle) {
  for (int b = 0; b < model.bodyCount(); ++b) {
    for (const WrapObjectSpec& wrap :
         model.spec().bodies[static_cast<std::size_t>(b)].wrap_objects) {
      if (wrap.name == name) {
        return {BodyIndex(b), &wrap};
      }
    }
  }
  for (const WrapObjectSpec& wrap : model.spec().ground_wrap_objects) {
    if (wrap.name == name) {
      return {kGround, &wrap};
    }
  }
  throw Error(ErrorCode::kModelReference,
              "muscle '" + muscle + "' wraps over '" + name + "', which is not in the model",
              atMuscle(muscle));
}

void addWraps(const Model& model, const MuscleSpec& muscle, Path& path) {
  for (const PathWrapSpec& spec : muscle.wraps) {
    const NamedWrap named = findWrapObject(model, spec.wrap_object, muscle.name);
    if (!named.spec->active) {
      continue;
    }
    Wrap wrap;
    wrap.body = named.body;
    wrap.slot = findSlot(path, named.body);
    wrap.surface = makeWrapSurface(*named.spec);
    wrap.X_BW = makePose(named.spec->rotation, named.spec->translation);
    const int last = static_cast<int>(muscle.path.size()) - 1;
    wrap.first_point = spec.first_point < 1 ? 0 : spec.first_point - 1;
    wrap.last_point = spec.last_point < 1 ? last : std::min(spec.last_point - 1, last);
    path.wraps.push_back(wrap);
  }
}

void addPoint(const Model& model, const PathPointSpec& spec, Path& path) {
  const BodyIndex body = model.getBody(spec.body);
  const int index = static_cast<int>(path.points.size());
  path.points.push_back({body, findSlot(path, body), spec.location});
  if (spec.kind == PathPointSpec::Kind::kConditional) {
    const int c = spec.coordinate.empty() ? -1 : model.getCoordinate(spec.coordinate).value();
    path.conditions.push_back(
        {index, c, spec.range_min - kConditionTolerance, spec.range_max + kConditionTolerance});
  } else if (spec.kind == PathPointSpec::Kind::kMoving && spec.coordinate.empty()) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      path.points.back().p_B[static_cast<Eigen::Index>(axis)] =
          ScalarFunction(spec.location_functions[axis]).evaluate(0).value;
    }
  } else if (spec.kind == PathPointSpec::Kind::kMoving) {
    const CoordinateIndex c = model.getCoordinate(spec.coordinate);
    const CoordinateSpec& coordinate = model.coordinate(c);
    path.motions.push_back({index,
                            c.value(),
                            coordinate.range_min,
                            coordinate.range_max,
                            {ScalarFunction(spec.location_functions[0]),
                             ScalarFunction(spec.location_functions[1]),
                             ScalarFunction(spec.location_functions[2])}});
  }
}

/// Finds the coordinates that change the path's length, by moving its bodies against each other or
/// a point on its body.
void addArms(const Model& model, Path& path) {
  const unsigned all = (1U << path.bodies.size()) - 1U;
  for (int c = 0; c < model.coordinateCount(); ++c) {
    Arm arm{c, 0};
    for (std::size_t slot = 0; slot < path.bodies.size(); ++slot) {
      arm.distal_slots |= model.isDistal(CoordinateIndex(c), path.bodies[slot]) ? 1U << slot : 0U;
    }
    // A coordinate that moves all of the path's bodies, or none, leaves its length alone.
    arm.distal_slots = arm.distal_slots == all ? 0U : arm.distal_slots;
    const bool moves_point = std::any_of(path.motions.begin(),
                                         path.motions.end(),
                                         [c](const Motion& m) { return m.coordinate == c; });
    if (arm.distal_slots != 0 || moves_point) {
      path.arms.push_back(arm);
    }
  }
}

Path makePath(const Model& model, const MuscleSpec& muscle) {
  require(muscle.path.size() >= 2 && muscle.path.size() <= kMaxPathPoints &&
              muscle.wraps.size() <= kMaxWraps,
          ErrorCode::kModelUnsupported,
          "muscle '" + muscle.name + "' has " + std::to_string(muscle.path.size()) +
              " path points and " + std::to_string(muscle.wraps.size()) +
              " wraps; expected 2 to 24 points and at most 4 wraps",
          atMuscle(muscle.name));
  Path path;
  for (const PathPointSpec& point : muscle.path) {
    addPoint(model, point, path);
  }
  addWraps(model, muscle, path);
  addArms(model, path);
  return path;
}

/// The surface placed in ground for one pose.
struct PlacedWrap {
  Pose X_GW;
  int first_point = 0;  ///< of the points that are part of the path, those in the wrap's range
  int last_point = 0;
  Vector3d toLocal(const Vector3d& p_G) const { return X_GW.R.transpose() * (p_G - X_GW.p); }
};

/// Where an object's scan of the path ended.
struct Scan {
  int segment = -1;  ///< insert behind this node, -1 = no wrap
  WrapContact contact;
  WrapContact::Status last = WrapContact::Status::kNone;
};

/// Tests the segments in the wrap's range: the first mandatory wrap wins, else the shortest dragged
/// one.
Scan scanSegments(const Wrap& wrap, const PlacedWrap& placed, const NodeList& path) {
  Scan scan;
  double least_detour = std::numeric_limits<double>::infinity();
  bool in_range = false;
  for (int i = 0; i + 1 < path.count; ++i) {
    in_range = in_range || path[i].point == placed.first_point;
    if (path[i].point >= placed.last_point) {
      break;
    }
    const bool same_surface = path[i].wrap >= 0 && path[i].wrap == path[i + 1].wrap;
    if (!in_range || same_surface) {
      continue;
    }
    const Vector3d P1 = placed.toLocal(path[i].p_G);
    const Vector3d P2 = placed.toLocal(path[i + 1].p_G);
    const WrapContact contact = calcWrapContact(wrap.surface, P1, P2);
    scan.last = contact.status;
    if (!contact.wraps()) {
      continue;
    }
    const double detour = (contact.r1 - P1).norm() + contact.surface_length +
                          (P2 - contact.r2).norm() - (P2 - P1).norm();
    if (contact.status == WrapContact::Status::kMandatory || detour < least_detour) {
      least_detour = detour;
      scan.segment = i;
      scan.contact = contact;
    }
    if (contact.status == WrapContact::Status::kMandatory) {
      break;
    }
  }
  return scan;
}

}  // namespace

struct MusclePaths::Impl {
  explicit Impl(const Model& m);

  void calcPath(const ModelState& state, std::size_t muscle);
  void placeNodes(const ModelState& state, const Path& path);
  void moveNode(const ModelState& state, const Path& path, const Motion& motion);
  void dropInactiveNodes(const ModelState& state, const Path& path);
  void addMotionArm(const ModelState& state, const Path& path, const Motion& motion, int muscle);
  void wrapOnce(const Path& path, int w);
  void wrapToConvergence(const Path& path);
  void sumPath(const ModelState& state, const Path& path, int muscle);
  void traceArc(const Path& path, int first, double step, std::vector<PathVertex>& vertices) const;
  void traceHelix(const Path& path,
                  int first,
                  double step,
                  std::vector<PathVertex>& vertices) const;

  const Model& model;
  std::vector<Path> paths;
  Eigen::VectorXd lengths;
  RowMatrix arms;
  std::vector<int> wrap_counts;
  // Workspace of the path at hand.
  NodeList nodes;
  int point_count = 0;  ///< nodes that are path points
  std::array<PlacedWrap, kMaxWraps> placed;
  std::array<WrapContact::Status, kMaxWraps> last_status{};
  double tangent_move = 0;
};

MusclePaths::Impl::Impl(const Model& m)
    : model(m),
      lengths(Eigen::VectorXd::Zero(m.muscleCount())),
      arms(RowMatrix::Zero(m.muscleCount(), m.coordinateCount())),
      wrap_counts(static_cast<std::size_t>(m.muscleCount()), 0) {
  for (const MuscleSpec& muscle : m.spec().muscles) {
    paths.push_back(makePath(m, muscle));
  }
}

void MusclePaths::Impl::placeNodes(const ModelState& state, const Path& path) {
  nodes.count = 0;
  for (const Point& point : path.points) {
    Node& node = nodes.nodes[static_cast<std::size_t>(nodes.count)];
    node = Node{state.pose(point.body) * point.p_B, point.slot, nodes.count, -1, 0.0};
    ++nodes.count;
  }
  for (std::size_t w = 0; w < path.wraps.size(); ++w) {
    placed[w].X_GW = compose(state.pose(path.wraps[w].body), path.wraps[w].X_BW);
    placed[w].first_point = path.wraps[w].first_point;
    placed[w].last_point = path.wraps[w].last_point;
  }
  for (const Motion& motion : path.motions) {
    moveNode(state, path, motion);
  }
  if (!path.conditions.empty()) {
    dropInactiveNodes(state, path);
  }
  point_count = nodes.count;
}

void MusclePaths::Impl::moveNode(const ModelState& state, const Path& path, const Motion& motion) {
  const double x = std::clamp(state.q()[motion.coordinate], motion.min, motion.max);
  const Vector3d p_B(motion.location[0].evaluate(x).value,
                     motion.location[1].evaluate(x).value,
                     motion.location[2].evaluate(x).value);
  const auto i = static_cast<std::size_t>(motion.point);
  nodes.nodes[i].p_G = state.pose(path.points[i].body) * p_B;
}

/// Takes points out whose condition does not hold, and with them the ends of wrap ranges: a range
/// counts all points of the document, and reaches from the first to the last of those that are left
/// in it (spec/path.md 4).
void MusclePaths::Impl::dropInactiveNodes(const ModelState& state, const Path& path) {
  auto condition = path.conditions.begin();
  int kept = 0;
  for (int i = 0; i < nodes.count; ++i) {
    const bool conditional = condition != path.conditions.end() && condition->point == i;
    const bool active = !conditional || condition->holds(state.q());
    condition += conditional ? 1 : 0;
    if (active) {
      nodes.nodes[static_cast<std::size_t>(kept++)] = nodes.nodes[static_cast<std::size_t>(i)];
    }
  }
  nodes.count = kept;
  for (std::size_t w = 0; w < path.wraps.size(); ++w) {
    placed[w].first_point = std::numeric_limits<int>::max();
    placed[w].last_point = -1;
    for (int i = 0; i < nodes.count; ++i) {
      const int point = nodes[i].point;
      if (point >= path.wraps[w].first_point && point <= path.wraps[w].last_point) {
        placed[w].first_point = std::min(placed[w].first_point, point);
        placed[w].last_point = point;
      }
    }
  }
}

/// Replaces one object's tangent points by those for the present neighbours.
void MusclePaths::Impl::wrapOnce(const Path& path, int w) {
  const auto i = static_cast<std::size_t>(w);
  Vector3d before = Vector3d::Constant(std::numeric_limits<double>::infinity());
  Vector3d before2 = before;
  for (int n = 0; n + 1 < nodes.count; ++n) {
    if (nodes[n].wrap == w) {
      before = nodes[n].p_G;
      before2 = nodes[n + 1].p_G;
      break;
    }
  }
  const bool had = before.allFinite();
  nodes.removeWrap(w);
  const Scan scan = scanSegments(path.wraps[i], placed[i], nodes);
  last_status[i] = scan.last;
  if (scan.segment < 0) {
    tangent_move = std::max(tangent_move, had ? 1.0 : 0.0);
    return;
  }
  const Vector3d r1 = placed[i].X_GW * scan.contact.r1;
  const Vector3d r2 = placed[i].X_GW * scan.contact.r2;
  const double move = had ? std::max((r1 - before).norm(), (r2 - before2).norm()) : 1.0;
  tangent_move = std::max(tangent_move, move);
  nodes.insert(scan.segment + 1,
               Node{r1, path.wraps[i].slot, -1, w, scan.contact.surface_length},
               Node{r2, path.wraps[i].slot, -1, w, 0.0});
}

/// Several objects: each one's tangents depend on the others', so they take turns until none moves
/// (spec/path.md 6, without its cap on the passes).
void MusclePaths::Impl::wrapToConvergence(const Path& path) {
  const int count = static_cast<int>(path.wraps.size());
  std::array<int, kMaxWraps> order = {0, 1, 2, 3};
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    tangent_move = 0;
    for (int k = 0; k < count; ++k) {
      wrapOnce(path, order[static_cast<std::size_t>(k)]);
    }
    const bool swap = pass == 0 && last_status[0] == WrapContact::Status::kNone &&
                      last_status[1] == WrapContact::Status::kInside;
    if (swap) {
      std::swap(order[0], order[1]);
      nodes.removeWrap(0);
    } else if (tangent_move < kTangentTolerance) {
      break;
    }
  }
}

/// Adds up the length, and projects unit tension along the path on the coordinates.
void MusclePaths::Impl::sumPath(const ModelState& state, const Path& path, int muscle) {
  double length = 0;
  std::array<Vector6, kMaxPathPoints + kMaxWraps> wrench;
  for (std::size_t slot = 0; slot < path.bodies.size(); ++slot) {
    wrench[slot].setZero();
  }
  for (int i = 0; i + 1 < nodes.count; ++i) {
    const Node& a = nodes[i];
    const Node& b = nodes[i + 1];
    if (a.wrap >= 0 && a.wrap == b.wrap) {
      length += a.surface;
      continue;
    }
    const Vector3d d = b.p_G - a.p_G;
    const double distance = d.norm();
    length += distance;
    if (a.slot == b.slot || distance < kCoincident) {
      continue;
    }
    // A force along the line of a and b has the same moment about the origin from either point.
    const Vector3d e = d / distance;
    Vector6 pull;
    pull << a.p_G.cross(e), e;
    wrench[static_cast<std::size_t>(a.slot)] += pull;
    wrench[static_cast<std::size_t>(b.slot)] -= pull;
  }
  lengths[muscle] = length;
  for (const Arm& arm : path.arms) {
    Vector6 distal = Vector6::Zero();
    for (std::size_t slot = 0; slot < path.bodies.size(); ++slot) {
      if ((arm.distal_slots >> slot & 1U) != 0) {
        distal += wrench[slot];
      }
    }
    arms(muscle, arm.coordinate) = state.screws().col(arm.coordinate).dot(distal);
  }
  for (const Motion& motion : path.motions) {
    addMotionArm(state, path, motion, muscle);
  }
}

/// What the motion of a point on its body adds: tension pulls the point towards both neighbours,
/// whether they are on its body or not, and does work along dp/dq. Beyond the coordinate's range
/// the point rests.
void MusclePaths::Impl::addMotionArm(const ModelState& state,
                                     const Path& path,
                                     const Motion& motion,
                                     int muscle) {
  const double x = state.q()[motion.coordinate];
  if (x < motion.min || x > motion.max) {
    return;
  }
  const Vector3d slope_B(motion.location[0].evaluate(x).first,
                         motion.location[1].evaluate(x).first,
                         motion.location[2].evaluate(x).first);
  const Pose& X_GB = state.pose(path.points[static_cast<std::size_t>(motion.point)].body);
  Vector3d pull = Vector3d::Zero();
  for (int i = 0; i < nodes.count; ++i) {
    if (nodes[i].point != motion.point) {
      continue;
    }
    for (const int neighbour : {i - 1, i + 1}) {
      if (neighbour >= 0 && neighbour < nodes.count) {
        const Vector3d d = nodes[neighbour].p_G - nodes[i].p_G;
        const double distance = d.norm();
        pull += distance < kCoincident ? d : Vector3d(d / distance);
      }
    }
  }
  arms(muscle, motion.coordinate) += (X_GB.R * slope_B).dot(pull);
}

void MusclePaths::Impl::calcPath(const ModelState& state, std::size_t muscle) {
  const Path& path = paths[muscle];
  placeNodes(state, path);
  if (path.wraps.size() == 1) {
    wrapOnce(path, 0);
  } else if (path.wraps.size() > 1) {
    wrapToConvergence(path);
  }
  wrap_counts[muscle] = (nodes.count - point_count) / 2;
  sumPath(state, path, static_cast<int>(muscle));
}

/// The points strictly between node `first` and the next one, which lie on one surface.
void MusclePaths::Impl::traceArc(const Path& path,
                                 int first,
                                 double step,
                                 std::vector<PathVertex>& vertices) const {
  const auto w = static_cast<std::size_t>(nodes[first].wrap);
  const WrapSurface& surface = path.wraps[w].surface;
  if (surface.kind == WrapObjectSpec::Kind::kCylinder) {
    traceHelix(path, first, step, vertices);
    return;
  }
  WrapContact contact;
  const Vector3d P1 = placed[w].toLocal(nodes[first - 1].p_G);
  const Vector3d P2 = placed[w].toLocal(nodes[first + 2].p_G);
  contact.r1 = placed[w].toLocal(nodes[first].p_G);
  contact.r2 = placed[w].toLocal(nodes[first + 1].p_G);
  contact.surface_length = nodes[first].surface;
  const double cosine =
      (contact.r1 - P1).stableNormalized().dot((P2 - contact.r2).stableNormalized());
  const int chords = static_cast<int>(std::ceil(std::acos(std::clamp(cosine, -1.0, 1.0)) / step));
  std::vector<Vector3d> points;
  if (surface.kind == WrapObjectSpec::Kind::kSphere) {
    traceSurface(surface.sphere, P1, contact, std::max(0, chords - 1), points);
  } else {
    traceSurface(surface.ellipsoid, P1, contact, std::max(0, chords - 1), points);
  }
  for (const Vector3d& point : points) {
    vertices.push_back({placed[w].X_GW * point, path.wraps[w].body});
  }
}

/// The same over a cylinder: on the helix, so that equal turns are equal steps along the axis.
void MusclePaths::Impl::traceHelix(const Path& path,
                                   int first,
                                   double step,
                                   std::vector<PathVertex>& vertices) const {
  const Node& node = nodes[first];
  const auto w = static_cast<std::size_t>(node.wrap);
  const Vector3d r1 = placed[w].toLocal(node.p_G);
  const Vector3d r2 = placed[w].toLocal(nodes[first + 1].p_G);
  const double radius = path.wraps[w].surface.cylinder.radius;
  const double rise = r2.z() - r1.z();
  const double around = std::sqrt(std::max(0.0, node.surface * node.surface - rise * rise));
  const double turn = radius > 0 ? around / radius : 0.0;
  // The length tells how far the path turns, the end point which way.
  const Eigen::Rotation2Dd forth(turn);
  const Eigen::Vector2d start = r1.head<2>();
  const Eigen::Vector2d end = r2.head<2>();
  const bool is_forth =
      (forth * start - end).squaredNorm() <= (forth.inverse() * start - end).squaredNorm();
  const int chords = static_cast<int>(std::ceil(turn / step));
  for (int i = 1; i < chords; ++i) {
    const double share = static_cast<double>(i) / chords;
    Vector3d local;
    local << Eigen::Rotation2Dd(is_forth ? share * turn : -share * turn) * start,
        r1.z() + share * rise;
    vertices.push_back({placed[w].X_GW * local, path.wraps[w].body});
  }
}

MusclePaths::MusclePaths(const Model& model) : impl_(std::make_unique<Impl>(model)) {}
MusclePaths::~MusclePaths() = default;
MusclePaths::MusclePaths(MusclePaths&&) noexcept = default;

void MusclePaths::calc(const ModelState& state) {
  for (std::size_t m = 0; m < impl_->paths.size(); ++m) {
    impl_->calcPath(state, m);
  }
}

const Eigen::VectorXd& MusclePaths::lengths() const {
  return impl_->lengths;
}
const RowMatrix& MusclePaths::momentArms() const {
  return impl_->arms;
}

void MusclePaths::calcSpeeds(const Eigen::Ref<const Eigen::VectorXd>& u,
                             Eigen::Ref<Eigen::VectorXd> speeds) const {
  for (std::size_t m = 0; m < impl_->paths.size(); ++m) {
    double speed = 0;
    for (const Arm& arm : impl_->paths[m].arms) {
      speed -= impl_->arms(static_cast<int>(m), arm.coordinate) * u[arm.coordinate];
    }
    speeds[static_cast<int>(m)] = speed;
  }
}

int MusclePaths::findWrapCount(MuscleIndex muscle) const {
  return impl_->wrap_counts[static_cast<std::size_t>(muscle.value())];
}

void MusclePaths::tracePath(const ModelState& state,
                            MuscleIndex muscle,
                            double arc_step,
                            std::vector<PathVertex>& vertices) {
  const auto index = static_cast<std::size_t>(muscle.value());
  impl_->calcPath(state, index);
  const Path& path = impl_->paths[index];
  const NodeList& nodes = impl_->nodes;
  vertices.clear();
  for (int i = 0; i < nodes.count; ++i) {
    vertices.push_back({nodes[i].p_G, path.bodies[static_cast<std::size_t>(nodes[i].slot)]});
    if (i + 1 < nodes.count && nodes[i].wrap >= 0 && nodes[i].wrap == nodes[i + 1].wrap) {
      impl_->traceArc(path, i, arc_step, vertices);
    }
  }
}

}  // namespace gaitmill
