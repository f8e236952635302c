#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/base/index.h"
#include "core/model/free_coordinates.h"
#include "core/model/model.h"

namespace gaitmill {

/// Which model coordinates move which bodies once couplers and locks are eliminated, and in what
/// order along the tree: what first and second derivatives of marker positions need. Immutable.
class CoordinateMovers {
 public:
  /// A model coordinate that moves a body, and the free coordinate it follows.
  struct Mover {
    int coordinate;
    int free;
    double slope;  ///< d coordinate / d free
  };

  CoordinateMovers(const Model& model, const FreeCoordinates& free);

  /// Every coordinate that follows a free one.
  const std::vector<Mover>& all() const { return all_; }
  /// Those that move the body; none for ground.
  const std::vector<Mover>& of(BodyIndex body) const;

  /// Pairs (j, k) of all() with j proximal to k or equal: d2x/dq_j dq_k = w_j x dx/dq_k, with w_j
  /// the angular part of the screw of j. For a coordinate that moves several axes of its joint (a
  /// spline knee) with itself the formula leaves out the second derivative of the splines.
  const std::vector<std::pair<std::size_t, std::size_t>>& proximalPairs() const {
    return proximal_pairs_;
  }

 private:
  void findProximalPairs(const Model& model);

  std::vector<Mover> all_;
  std::vector<std::vector<Mover>> of_body_;
  std::vector<std::pair<std::size_t, std::size_t>> proximal_pairs_;
  std::vector<Mover> none_;
};

}  // namespace gaitmill
