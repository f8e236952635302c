#pragma once

#include <vector>

#include <Eigen/Core>

namespace gaitmill {

/// Lengths of all muscle paths over one window as cubic Hermite pieces between equally spaced
/// nodes. With 5 ms between nodes the error is of the order of 1e-8 m (spec/cmc.md 6a).
class PathTable {
 public:
  PathTable(int muscles, int max_intervals);

  /// Begins a window of `intervals` pieces of `interval` seconds each.
  void start(double interval, int intervals);
  /// Node k: lengths [m] and their time derivatives [m/s] at k * interval.
  void setNode(int k,
               const Eigen::Ref<const Eigen::VectorXd>& lengths,
               const Eigen::Ref<const Eigen::VectorXd>& slopes);

  /// Length of one path `elapsed` seconds after the start of the window [m].
  double calcLength(int muscle, double elapsed) const noexcept;

 private:
  struct Node {
    double length = 0;
    double slope = 0;  ///< times interval
  };
  int stride_;
  double interval_ = 1;
  int intervals_ = 0;
  std::vector<Node> nodes_;  ///< (muscles x stride)
};

}  // namespace gaitmill
