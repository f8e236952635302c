#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/data/time_series.h"
#include "core/math/natural_spline.h"
#include "core/model/free_coordinates.h"
#include "core/model/model.h"

namespace gaitmill {

/// Desired motion of the free coordinates over time, as forward stages track it (spec/signal.md 6):
/// three natural quintic splines,
///   q_ref     through the table's rows,
///   u_ref     through the first derivatives of q_ref at the rows,
///   udot_ref  through the first derivatives of u_ref at the rows.
/// They differ slightly from the derivatives of q_ref; controllers use u_ref and udot_ref,
/// predictions of the pose q_ref and its own derivative. Immutable, may be shared between threads;
/// evaluation does not allocate. Each result is (free.count()) [rad|m, per s, per s^2].
class ReferenceMotion {
 public:
  /// @param table  rows of coordinates [rad|m], padded and filtered already if that is wanted.
  ///               Columns are coordinate names or paths that end in "/<name>/value"; absent ones
  ///               are 0. A row that repeats the time of the one before, to 1e-9 s, is dropped.
  /// @throws Error kTableNoRows if fewer than 6 rows remain, kTableNumber
  ReferenceMotion(const Model& model, const FreeCoordinates& free, const TimeSeries& table);

  int count() const { return pose_.columnCount(); }
  /// Rows that define the splines, [s].
  const std::vector<double>& times() const { return times_; }

  void calcPose(double t, Eigen::Ref<Eigen::VectorXd> q) const;
  /// q_ref and its own derivative.
  void calcPose(double t, Eigen::Ref<Eigen::VectorXd> q, Eigen::Ref<Eigen::VectorXd> q_dot) const;
  void calcSpeed(double t, Eigen::Ref<Eigen::VectorXd> u) const;
  void calcAcceleration(double t, Eigen::Ref<Eigen::VectorXd> u_dot) const;

 private:
  struct Rows {
    std::vector<double> time;
    RowMatrix q;  ///< (rows x free coordinates)
  };
  explicit ReferenceMotion(Rows rows);
  static Rows collect(const Model& model, const FreeCoordinates& free, const TimeSeries& table);

  std::vector<double> times_;
  NaturalSpline pose_;
  NaturalSpline speed_;
  NaturalSpline acceleration_;
};

}  // namespace gaitmill
