#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/data/time_series.h"

namespace gaitmill {

/// Interpolating natural splines through all columns of a table at once (spec/signal.md 6): degree
/// 3 (external loads) or 5 (coordinates). Outside the data the polynomial of degree (degree-1)/2
/// continues: straight line, parabola. Immutable, may be shared between threads.
class NaturalSpline {
 public:
  /// @param time    strictly increasing, any spacing
  /// @param values  (time.size() x n_columns), finite
  /// @param degree  3 or 5; needs degree + 1 rows at least
  /// @throws Error kTableShape, kTableTimeOrder, kTableNumber
  NaturalSpline(std::vector<double> time, const Eigen::Ref<const RowMatrix>& values, int degree);

  int columnCount() const { return columns_; }
  double startTime() const { return time_.front(); }
  double endTime() const { return time_.back(); }

  /// Value, first and second derivative at t; each result is (n_columns), already of that size, or
  /// an empty vector to leave it out. Does not allocate.
  void evaluate(double t,
                Eigen::Ref<Eigen::VectorXd> value,
                Eigen::Ref<Eigen::VectorXd> first,
                Eigen::Ref<Eigen::VectorXd> second) const;
  /// Value only.
  void evaluate(double t, Eigen::Ref<Eigen::VectorXd> value) const;

 private:
  int findInterval(double t) const;

  std::vector<double> time_;
  int columns_ = 0;
  int degree_ = 0;
  /// Taylor coefficients about each knot: row-major (knots x (degree+1) x columns).
  std::vector<double> coefficients_;
};

}  // namespace gaitmill
