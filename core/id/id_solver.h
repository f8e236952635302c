#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/base/progress.h"
#include "core/data/time_series.h"
#include "core/id/id_options.h"
#include "core/id/id_result.h"
#include "core/math/natural_spline.h"
#include "core/model/external_loads.h"
#include "core/model/model.h"

namespace gaitmill {

/// Inverse dynamics of a measured motion (spec/id.md):
///   tau = M(q) q'' + C(q, q') - G(q) - sum J^T F_ext
/// q, q', q'' come from one natural quintic spline through the rows; a coordinate without a column
/// stays at its default. Constraints carry nothing: rows of locked coordinates are what their locks
/// must bear, those of the patella its own weight and inertia.
class IdSolver {
 public:
  IdSolver(const Model& model, const IdOptions& options);  ///< keeps a reference to the model

  /// @param coordinates  columns under plain coordinate names [rad|m]; others are ignored
  /// @param loads        ground reactions, or null for none
  /// @throws Error kTableNoRows, kTableShape (fewer than six rows), kInputCoordinates if no column
  /// is
  ///   a coordinate, kInputTimeRange if no row lies in the range, kCancelled
  IdResult solve(const TimeSeries& coordinates,
                 const ExternalLoads* loads,
                 const Progress& progress = {});

 private:
  struct Range {
    int first = 0;
    int last = 0;
  };

  /// A coupler: the independent coordinate carries slope times the force on the dependent one.
  struct CoupledSum {
    CoordinateIndex independent;
    CoordinateIndex dependent;
    double slope = 0;
  };

  TimeSeries prepare(const TimeSeries& coordinates) const;
  Range findRange(const std::vector<double>& time,
                  double recorded_start,
                  double recorded_end) const;
  IdResult makeResult(const TimeSeries& motion, Range range) const;
  void solveRow(const NaturalSpline& motion, const ExternalLoads* loads, int row, IdResult& result);
  void setResidualWrench(int row, IdResult& result) const;

  const Model& model_;
  IdOptions options_;
  ModelState state_;
  std::vector<CoupledSum> sums_;
  std::vector<int> root_;  ///< the six coordinates that move every body, else empty
  std::vector<BodyWrench> wrenches_;
  Eigen::VectorXd q_, u_, udot_, tau_;
};

}  // namespace gaitmill
