#include "core/cmc/path_table.h"

#include <algorithm>
#include <cstddef>

#include "core/base/error.h"

namespace gaitmill {

PathTable::PathTable(int muscles, int max_intervals)
    : stride_(max_intervals + 1),
      nodes_(static_cast<std::size_t>(muscles) * static_cast<std::size_t>(stride_)) {}

void PathTable::start(double interval, int intervals) {
  check(intervals >= 1 && intervals < stride_, "path table intervals");
  interval_ = interval;
  intervals_ = intervals;
}

void PathTable::setNode(int k,
                        const Eigen::Ref<const Eigen::VectorXd>& lengths,
                        const Eigen::Ref<const Eigen::VectorXd>& slopes) {
  for (Eigen::Index muscle = 0; muscle < lengths.size(); ++muscle) {
    nodes_[static_cast<std::size_t>(muscle * stride_ + k)] = {lengths[muscle],
                                                              slopes[muscle] * interval_};
  }
}

double PathTable::calcLength(int muscle, double elapsed) const noexcept {
  const double position = elapsed / interval_;
  const int piece = std::clamp(static_cast<int>(position), 0, intervals_ - 1);
  const Node* node = &nodes_[static_cast<std::size_t>(muscle * stride_ + piece)];
  const double s = position - piece;
  const double change = node[1].length - node[0].length;
  // Newton form of the cubic through both ends and slopes.
  const double quadratic = change - node[0].slope;
  const double cubic = node[0].slope + node[1].slope - 2 * change;
  return node[0].length + s * (node[0].slope + s * (quadratic + (s - 1) * cubic));
}

}  // namespace gaitmill
