#include "core/io/mesh_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

namespace gaitmill {

namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Vector3d = Eigen::Vector3d;
using Vector3f = Eigen::Vector3f;

constexpr std::size_t kMaximumElements =
    2000000;                       // the largest bone of the OpenSim folder has 5434
constexpr float kLargest = 1e18F;  // its square is still a float

// One more loop per corner of a polygon and per triangle of a vertex: bounded where a hostile file
// would make it quadratic.
constexpr std::size_t kMaximumEarCorners = 256;
constexpr std::size_t kMaximumCreaseTriangles = 64;

Vector3d calcAreaVector(const Mesh& mesh, const Triangle& t) {
  const Vector3d a = mesh.vertices[t[0]].cast<double>();
  return 0.5 *
         (mesh.vertices[t[1]].cast<double>() - a).cross(mesh.vertices[t[2]].cast<double>() - a);
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

bool isClosed(const Mesh& mesh) {
  std::vector<Edge> forth, back;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      forth.emplace_back(t[k], t[(k + 1) % 3]);
      back.emplace_back(t[(k + 1) % 3], t[k]);
    }
  }
  std::sort(forth.begin(), forth.end());
  std::sort(back.begin(), back.end());
  return forth == back;
}

double calcVolume(const Mesh& mesh) {
  const Vector3d origin = mesh.vertices.front().cast<double>();
  double volume = 0;
  for (const Triangle& t : mesh.triangles) {
    volume += (mesh.vertices[t[0]].cast<double>() - origin).dot(calcAreaVector(mesh, t)) / 3;
  }
  return volume;
}

void turnOutside(Mesh& mesh) {
  if (calcVolume(mesh) < 0 && isClosed(mesh)) {
    for (Triangle& t : mesh.triangles) {
      std::swap(t[1], t[2]);
    }
  }
}

void turnToNormals(Mesh& mesh) {
  for (Vector3f& normal : mesh.normals) {
    const float length = normal.norm();
    normal = length > 0 && std::isfinite(length) ? Vector3f(normal / length) : Vector3f::UnitY();
  }
  for (Triangle& t : mesh.triangles) {
    const Vector3f sum = mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]];
    if (calcAreaVector(mesh, t).dot(sum.cast<double>()) < 0) {
      std::swap(t[1], t[2]);
    }
  }
}

/// A polygon in its plane, of which ears are cut off.
class EarCutter {
 public:
  EarCutter(const std::vector<Vector3f>& vertices, std::vector<std::uint32_t> corners)
      : corners_(std::move(corners)) {
    Vector3d normal = Vector3d::Zero();
    const std::size_t n = corners_.size();
    for (std::size_t i = 0; i < n; ++i) {
      normal += vertices[corners_[i]].cast<double>().cross(
          vertices[corners_[(i + 1) % n]].cast<double>());
    }
    const Vector3d x = normal.unitOrthogonal();
    const Vector3d y = normal.stableNormalized().cross(x);
    for (const std::uint32_t corner : corners_) {
      const Vector3d p = vertices[corner].cast<double>();
      points_.emplace_back(p.dot(x), p.dot(y));
    }
  }

  std::vector<Triangle> cut() {
    std::vector<Triangle> triangles;
    while (corners_.size() > 3) {
      const std::size_t ear = findEar();
      triangles.push_back({before(ear), corners_[ear], after(ear)});
      corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(ear));
      points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    triangles.push_back({corners_[0], corners_[1], corners_[2]});
    return triangles;
  }

 private:
  using Point = Eigen::Vector2d;
  std::uint32_t before(std::size_t i) const {
    return corners_[(i + corners_.size() - 1) % corners_.size()];
  }
  std::uint32_t after(std::size_t i) const { return corners_[(i + 1) % corners_.size()]; }

  static double calcTurn(const Point& a, const Point& b, const Point& c) {
    return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
  }

  bool isEar(std::size_t i) const {
    const std::size_t n = points_.size();
    const Point& a = points_[(i + n - 1) % n];
    const Point& b = points_[i];
    const Point& c = points_[(i + 1) % n];
    if (calcTurn(a, b, c) <= 0) {
      return false;
    }
    for (std::size_t k = 2; k + 1 < n; ++k) {
      const Point& p = points_[(i + k) % n];
      if (calcTurn(a, b, p) >= 0 && calcTurn(b, c, p) >= 0 && calcTurn(c, a, p) >= 0) {
        return false;
      }
    }
    return true;
  }

  // The ear with the shortest cut; any corner of a polygon that is not simple.
  std::size_t findEar() const {
    const std::size_t n = points_.size();
    std::size_t best = 0;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < n; ++i) {
      const double cut = (points_[(i + 1) % n] - points_[(i + n - 1) % n]).squaredNorm();
      if (cut < shortest && isEar(i)) {
        shortest = cut;
        best = i;
      }
    }
    return best;
  }

  std::vector<std::uint32_t> corners_;
  std::vector<Point> points_;
};

/// The triangles at each vertex: positions in `triangles` from start[v] to start[v + 1].
struct Neighbours {
  std::vector<std::uint32_t> start, triangles;
};

Neighbours findNeighbours(const Mesh& mesh) {
  Neighbours result;
  result.start.assign(mesh.vertices.size() + 1, 0);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      ++result.start[v + 1];
    }
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    result.start[v + 1] += result.start[v];
  }
  std::vector<std::uint32_t> next(result.start.begin(), result.start.end() - 1);
  result.triangles.resize(3 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t v : mesh.triangles[i]) {
      result.triangles[next[v]++] = static_cast<std::uint32_t>(i);
    }
  }
  return result;
}

/// Splits the vertices of a mesh along its creases.
class CreaseSplitter {
 public:
  explicit CreaseSplitter(Mesh& mesh) : mesh_(mesh), neighbours_(findNeighbours(mesh)) {
    for (const Triangle& t : mesh.triangles) {
      areas_.push_back(calcAreaVector(mesh, t));
    }
  }

  void split() {
    const std::size_t count = mesh_.vertices.size();
    mesh_.normals.assign(count, Vector3f::UnitY());
    for (std::uint32_t v = 0; v < count; ++v) {
      splitVertex(v);
    }
  }

 private:
  void splitVertex(std::uint32_t v) {
    const std::uint32_t* first = neighbours_.triangles.data() + neighbours_.start[v];
    const std::uint32_t* last = neighbours_.triangles.data() + neighbours_.start[v + 1];
    const bool smooth = static_cast<std::size_t>(last - first) > kMaximumCreaseTriangles;
    std::vector<std::pair<Vector3f, std::uint32_t>>
        made;  // normals, and the vertices that have them
    for (const std::uint32_t* i = first; i != last; ++i) {
      const Vector3f normal = calcNormal(first, last, smooth ? nullptr : &areas_[*i]);
      const auto known = std::find_if(made.begin(), made.end(), [&](const auto& one) {
        return (one.first - normal).squaredNorm() < 1e-6F;
      });
      const std::uint32_t vertex =
          known == made.end() ? addVertex(v, normal, made.empty()) : known->second;
      if (known == made.end()) {
        made.emplace_back(normal, vertex);
      }
      Triangle& t = mesh_.triangles[*i];
      *std::find(t.begin(), t.end(), v) = vertex;
      if (smooth) {
        return;  // all others keep the vertex as it is
      }
    }
  }

  // Mean of those triangles that face about as `own` does; of all if that is null.
  Vector3f calcNormal(const std::uint32_t* first,
                      const std::uint32_t* last,
                      const Vector3d* own) const {
    constexpr double kCosineOfCrease = 0.5;
    Vector3d sum = Vector3d::Zero();
    for (const std::uint32_t* i = first; i != last; ++i) {
      const Vector3d& area = areas_[*i];
      if (own == nullptr || own->dot(area) >= kCosineOfCrease * own->norm() * area.norm()) {
        sum += area;
      }
    }
    const double length = sum.norm();
    return length > 0 ? Vector3f((sum / length).cast<float>()) : Vector3f::UnitY();
  }

  std::uint32_t addVertex(std::uint32_t v, const Vector3f& normal, bool is_first) {
    if (is_first) {
      mesh_.normals[v] = normal;
      return v;
    }
    mesh_.vertices.push_back(Vector3f(mesh_.vertices[v]));
    mesh_.normals.push_back(normal);
    return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  }

  Mesh& mesh_;
  Neighbours neighbours_;
  std::vector<Vector3d> areas_;
};

}  // namespace

std::vector<Triangle> triangulate(const std::vector<Vector3f>& vertices,
                                  std::vector<std::uint32_t> corners) {
  if (corners.size() < 3) {
    return {};
  }
  if (corners.size() <= kMaximumEarCorners) {
    return EarCutter(vertices, std::move(corners)).cut();
  }
  std::vector<Triangle> fan;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    fan.push_back({corners[0], corners[i], corners[i + 1]});
  }
  return fan;
}

void calcCreasedNormals(Mesh& mesh) {
  CreaseSplitter(mesh).split();
}

void MeshBuilder::fail(const std::string& message, int line) const {
  throw Error(ErrorCode::kMeshFormat, message, {file_name_, line, 0, {}});
}

void MeshBuilder::addVertex(double x, double y, double z, int line) {
  if (mesh_.vertices.size() >= kMaximumElements) {
    fail("the mesh has more than " + std::to_string(kMaximumElements) + " vertices", line);
  }
  const Vector3f p(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
  if (!p.allFinite() || p.cwiseAbs().maxCoeff() > kLargest) {
    fail("a vertex has a coordinate that is not finite", line);
  }
  mesh_.vertices.push_back(p);
}

void MeshBuilder::addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, int line) {
  for (const std::uint32_t corner : {a, b, c}) {
    if (corner >= mesh_.vertices.size()) {
      fail("a polygon names vertex " + std::to_string(corner) + "; there are " +
               std::to_string(mesh_.vertices.size()),
           line);
    }
  }
  if (mesh_.triangles.size() >= kMaximumElements) {
    fail("the mesh has more than " + std::to_string(kMaximumElements) + " triangles", line);
  }
  if (a != b && b != c && c != a) {
    mesh_.triangles.push_back({a, b, c});
  }
}

void MeshBuilder::addPolygon(const std::vector<std::uint32_t>& corners, int line) {
  std::vector<std::uint32_t> distinct;
  for (const std::uint32_t corner : corners) {
    if (corner >= mesh_.vertices.size()) {
      addTriangle(corner, corner, corner, line);  // says what is wrong
    }
    if (distinct.empty() || distinct.back() != corner) {
      distinct.push_back(corner);
    }
  }
  for (const auto& [a, b, c] : triangulate(mesh_.vertices, std::move(distinct))) {
    addTriangle(a, b, c, line);
  }
}

Mesh MeshBuilder::finish() {
  if (mesh_.triangles.empty()) {
    fail("there is no triangle in the file", 0);
  }
  if (mesh_.normals.size() == mesh_.vertices.size()) {
    turnToNormals(mesh_);
  } else {
    turnOutside(mesh_);
    calcCreasedNormals(mesh_);
  }
  return std::move(mesh_);
}

}  // namespace gaitmill
