// The surface of a Solid as a mesh: surface nets after Gibson (1998), "Constrained elastic surface
// nets". One vertex in each cell of a grid that the surface crosses, one square around each edge of
// the grid that it crosses.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/render/solid.h"

namespace gaitmill {

namespace {

using Vector3d = Eigen::Vector3d;
using Index3 = std::array<int, 3>;

constexpr int kBlock = 4;  // cells of a block along an edge: what lies near is looked up per block
constexpr double kOutside =
    1;  // distance where there is certainly no surface; only its sign counts
constexpr std::uint32_t kNone = 0xffffffffu;

}  // namespace

class SolidMesher {
 public:
  SolidMesher(const Solid& solid, const Vector3d& cell);
  Mesh make();

 private:
  std::size_t at(const Index3& i) const {
    return static_cast<std::size_t>((i[2] * count_[1] + i[1]) * count_[0] + i[0]);
  }
  Vector3d pointAt(const Index3& i) const {
    return origin_ + Vector3d(i[0], i[1], i[2]).cwiseProduct(cell_);
  }
  void fillBlock(const Index3& first);
  void placeVertex(const Index3& cell);
  void joinAround(const Index3& node, int axis);
  Vector3d calcGradient(const Solid& solid, const Vector3d& p) const;
  template <class Visit>
  void forEach(const Index3& first, const Index3& end, Visit&& visit) const;

  const Solid& solid_;
  Vector3d cell_;
  Vector3d origin_;
  Index3 count_ = {0, 0, 0};             ///< nodes
  std::vector<float> distance_;          ///< at the nodes
  std::vector<std::uint32_t> vertex_;    ///< of the cell above each node
  std::vector<Solid> near_;              ///< per block that the surface may cross
  std::vector<std::uint32_t> block_of_;  ///< per node, of the cell above it
  Mesh mesh_;
};

SolidMesher::SolidMesher(const Solid& solid, const Vector3d& cell) : solid_(solid), cell_(cell) {
  // Fillets stick out of the parts' boxes a little.
  const Eigen::AlignedBox3d box = solid.findBox();
  origin_ = box.min() - 2.5 * cell;
  const Vector3d size = box.max() + 2.5 * cell - origin_;
  for (int i = 0; i < 3; ++i) {
    const auto cells = static_cast<int>(std::ceil(size[i] / cell[i] / kBlock)) * kBlock;
    count_[static_cast<std::size_t>(i)] = cells + 1;
  }
  const std::size_t nodes = at({count_[0] - 1, count_[1] - 1, count_[2] - 1}) + 1;
  distance_.assign(nodes, static_cast<float>(kOutside));
  vertex_.assign(nodes, kNone);
  block_of_.assign(nodes, kNone);
}

template <class Visit>
void SolidMesher::forEach(const Index3& first, const Index3& end, Visit&& visit) const {
  for (int z = first[2]; z < end[2]; ++z) {
    for (int y = first[1]; y < end[1]; ++y) {
      for (int x = first[0]; x < end[0]; ++x) {
        visit(Index3{x, y, z});
      }
    }
  }
}

void SolidMesher::fillBlock(const Index3& first) {
  const Vector3d half = 0.5 * kBlock * cell_;
  Solid near = solid_.selectNear(pointAt(first) + half, half.norm());
  const auto block = static_cast<std::uint32_t>(near_.size());
  const Index3 end = {first[0] + kBlock, first[1] + kBlock, first[2] + kBlock};
  if (!near.isEmpty()) {
    forEach(first, {end[0] + 1, end[1] + 1, end[2] + 1}, [&](const Index3& node) {
      distance_[at(node)] = static_cast<float>(near.calcDistance(pointAt(node)));
    });
  }
  forEach(first, end, [&](const Index3& node) { block_of_[at(node)] = block; });
  near_.push_back(std::move(near));
}

Vector3d SolidMesher::calcGradient(const Solid& solid, const Vector3d& p) const {
  // Central differences over a tenth of a cell: short against the details, long against rounding.
  const double step = 0.1 * cell_.minCoeff();
  Vector3d gradient;
  for (int i = 0; i < 3; ++i) {
    const Vector3d h = step * Vector3d::Unit(i);
    gradient[i] = (solid.calcDistance(p + h) - solid.calcDistance(p - h)) / (2 * step);
  }
  return gradient;
}

void SolidMesher::placeVertex(const Index3& cell) {
  Vector3d sum = Vector3d::Zero();
  int crossings = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (int corner = 0; corner < 4; ++corner) {
      Index3 from = cell;
      from[static_cast<std::size_t>((axis + 1) % 3)] += corner & 1;
      from[static_cast<std::size_t>((axis + 2) % 3)] += corner >> 1;
      Index3 to = from;
      ++to[static_cast<std::size_t>(axis)];
      const double a = static_cast<double>(distance_[at(from)]);
      const double b = static_cast<double>(distance_[at(to)]);
      if ((a < 0) != (b < 0)) {
        sum += pointAt(from) + a / (a - b) * (pointAt(to) - pointAt(from));
        ++crossings;
      }
    }
  }
  if (crossings == 0) {
    return;
  }
  const Solid& near = near_[block_of_[at(cell)]];
  Vector3d p = sum / crossings;
  const Vector3d gradient = calcGradient(near, p);
  // One Newton step onto the surface, but not out of the cell.
  const Vector3d corner = pointAt(cell);
  p -= near.calcDistance(p) / std::max(gradient.squaredNorm(), 0.1) * gradient;
  p = p.cwiseMax(corner).cwiseMin(corner + cell_);
  vertex_[at(cell)] = static_cast<std::uint32_t>(mesh_.vertices.size());
  mesh_.vertices.push_back(p.cast<float>());
  mesh_.normals.push_back(gradient.stableNormalized().cast<float>());
}

// The square through the four cells around the edge from `node` along `axis`.
void SolidMesher::joinAround(const Index3& node, int axis) {
  Index3 to = node;
  ++to[static_cast<std::size_t>(axis)];
  const bool inside = distance_[at(node)] < 0;
  if (inside == (distance_[at(to)] < 0)) {
    return;
  }
  const auto u = static_cast<std::size_t>((axis + 1) % 3);
  const auto v = static_cast<std::size_t>((axis + 2) % 3);
  std::array<std::uint32_t, 4> corner = {};
  constexpr int kBack[4][2] = {{1, 1}, {0, 1}, {0, 0}, {1, 0}};
  for (std::size_t i = 0; i < 4; ++i) {
    Index3 cell = node;
    cell[u] -= kBack[i][0];
    cell[v] -= kBack[i][1];
    corner[i] = vertex_[at(cell)];
  }
  if (!inside) {
    std::swap(corner[1], corner[3]);
  }
  const auto length = [&](std::size_t a, std::size_t b) {
    return (mesh_.vertices[corner[a]] - mesh_.vertices[corner[b]]).squaredNorm();
  };
  const std::size_t s = length(0, 2) <= length(1, 3) ? 0 : 1;
  mesh_.triangles.push_back({corner[s], corner[s + 1], corner[s + 2]});
  mesh_.triangles.push_back({corner[s], corner[s + 2], corner[(s + 3) % 4]});
}

Mesh SolidMesher::make() {
  const Index3 cells = {count_[0] - 1, count_[1] - 1, count_[2] - 1};
  forEach({0, 0, 0},
          {cells[0] / kBlock, cells[1] / kBlock, cells[2] / kBlock},
          [&](const Index3& block) {
            fillBlock({block[0] * kBlock, block[1] * kBlock, block[2] * kBlock});
          });
  forEach({0, 0, 0}, cells, [&](const Index3& cell) { placeVertex(cell); });
  forEach({1, 1, 1}, cells, [&](const Index3& node) {
    for (int axis = 0; axis < 3; ++axis) {
      joinAround(node, axis);
    }
  });
  return std::move(mesh_);
}

Mesh Solid::makeMesh(const Vector3d& cell) const {
  return SolidMesher(*this, cell).make();
}

}  // namespace gaitmill
