#include "core/id/id_solver.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/base/error.h"
#include "core/math/scalar_function.h"
#include "core/math/table_filters.h"

namespace gaitmill {
namespace {

constexpr int kRootFreedoms = 6;
constexpr int kDegree = 5;

std::string makeForceLabel(const Model& model, CoordinateIndex c) {
  const std::string& name = model.coordinateNames()[static_cast<std::size_t>(c.value())];
  return name + (model.motionKind(c) == MotionKind::kRotational ? "_moment" : "_force");
}

// The coordinates that move all bodies, if they are six: then their screws span every wrench.
std::vector<int> findRoot(const Model& model) {
  std::vector<int> root;
  for (int c = 0; c < model.coordinateCount(); ++c) {
    bool moves_all = true;
    for (int b = 0; b < model.bodyCount(); ++b) {
      moves_all = moves_all && model.isDistal(CoordinateIndex(c), BodyIndex(b));
    }
    if (moves_all) root.push_back(c);
  }
  if (root.size() != kRootFreedoms) root.clear();
  return root;
}

std::vector<std::string> listUnits(const Model& model) {
  std::vector<std::string> units;
  for (int c = 0; c < model.coordinateCount(); ++c) {
    const bool slides = model.motionKind(CoordinateIndex(c)) == MotionKind::kTranslational;
    units.push_back(slides ? "m" : "rad");
  }
  return units;
}

TimeSeries makeMotionTable(const Model& model,
                           const std::string& name,
                           const std::string& per_time,
                           const std::vector<double>& time) {
  TimeSeries table = makeTimeSeries(name, model.coordinateNames(), time);
  table.units = listUnits(model);
  for (std::string& unit : table.units) unit += per_time;
  return table;
}

}  // namespace

IdSolver::IdSolver(const Model& model, const IdOptions& options)
    : model_(model),
      options_(options),
      state_(model),
      root_(findRoot(model)),
      q_(model.coordinateCount()),
      u_(model.coordinateCount()),
      udot_(model.coordinateCount()),
      tau_(model.coordinateCount()) {
  options.validate();
  for (const CouplerSpec& coupler : model.spec().couplers) {
    sums_.push_back({model.getCoordinate(coupler.independent),
                     model.getCoordinate(coupler.dependent),
                     coupler.scale * ScalarFunction(coupler.function).evaluate(0).first});
  }
}

IdResult IdSolver::solve(const TimeSeries& coordinates,
                         const ExternalLoads* loads,
                         const Progress& progress) {
  require(coordinates.rowCount() > 0, ErrorCode::kTableNoRows, "the motion has no rows");
  const TimeSeries motion = prepare(dropRepeatedRows(coordinates));
  const Range range = findRange(motion.time, coordinates.time.front(), coordinates.time.back());
  const NaturalSpline spline(motion.time, motion.values, kDegree);
  IdResult result = makeResult(motion, range);
  const int rows = range.last - range.first + 1;
  wrenches_.clear();
  for (int row = 0; row < rows; ++row) {
    reportProgress(progress, static_cast<double>(row) / rows);
    solveRow(spline, loads, row, result);
  }
  reportProgress(progress, 1.0);
  return result;
}

// All model coordinates in model order, filtered if asked.
TimeSeries IdSolver::prepare(const TimeSeries& coordinates) const {
  TimeSeries motion = makeTimeSeries(coordinates.name, model_.coordinateNames(), coordinates.time);
  int found = 0;
  for (int c = 0; c < model_.coordinateCount(); ++c) {
    const auto column = coordinates.findColumn(motion.labels[static_cast<std::size_t>(c)]);
    if (column) {
      motion.values.col(c) = coordinates.values.col(*column);
      ++found;
    } else {
      motion.values.col(c).setConstant(model_.defaultPose()(c));
    }
  }
  require(found > 0,
          ErrorCode::kInputCoordinates,
          "no column of '" + coordinates.name + "' is a coordinate of the model");
  if (!options_.lowpass_cutoff) return motion;
  return filterRecursive(padOdd(motion, motion.rowCount() / 2), *options_.lowpass_cutoff);
}

// Never beyond what was recorded: the padding is no motion.
IdSolver::Range IdSolver::findRange(const std::vector<double>& time,
                                    double recorded_start,
                                    double recorded_end) const {
  const double start = std::max(options_.start_time, recorded_start);
  const double end = std::min(options_.end_time, recorded_end);
  const auto after = [&](double t) {
    return static_cast<int>(std::upper_bound(time.begin(), time.end(), t) - time.begin());
  };
  const Range range{std::max(after(start) - 1, 0), after(end) - 1};
  require(start <= end && range.last >= range.first,
          ErrorCode::kInputTimeRange,
          "the motion has no rows in the time range",
          {{}, 0, 0, "time_range_s"});
  return range;
}

IdResult IdSolver::makeResult(const TimeSeries& motion, Range range) const {
  const std::vector<double> time(motion.time.begin() + range.first,
                                 motion.time.begin() + range.last + 1);
  IdResult result;
  result.lowpass_cutoff = options_.lowpass_cutoff.value_or(-1.0);
  std::vector<std::string> labels;
  std::vector<std::string> units;
  for (int c = 0; c < model_.coordinateCount(); ++c) {
    const CoordinateIndex index(c);
    labels.push_back(makeForceLabel(model_, index));
    units.push_back(model_.motionKind(index) == MotionKind::kTranslational ? "N" : "N.m");
  }
  for (const CoupledSum& sum : sums_) {
    labels.push_back(makeForceLabel(model_, sum.independent) + "_with_" +
                     motion.labels[static_cast<std::size_t>(sum.dependent.value())]);
    units.push_back("N.m");
  }
  result.generalized_forces = makeTimeSeries("Inverse Dynamics Generalized Forces", labels, time);
  result.generalized_forces.units = units;
  result.coordinates = makeMotionTable(model_, "Coordinates", "", time);
  result.speeds = makeMotionTable(model_, "Speeds", "/s", time);
  result.accelerations = makeMotionTable(model_, "Accelerations", "/s^2", time);
  result.residual_wrench = makeTimeSeries("Residual wrench about the mass center", {}, time);
  if (!root_.empty()) {
    result.residual_wrench = makeTimeSeries("Residual wrench about the mass center",
                                            {"residual_force_x",
                                             "residual_force_y",
                                             "residual_force_z",
                                             "residual_moment_x",
                                             "residual_moment_y",
                                             "residual_moment_z"},
                                            time);
    result.residual_wrench.units = {"N", "N", "N", "N.m", "N.m", "N.m"};
  }
  return result;
}

void IdSolver::solveRow(const NaturalSpline& motion,
                        const ExternalLoads* loads,
                        int row,
                        IdResult& result) {
  const double t = result.coordinates.time[static_cast<std::size_t>(row)];
  motion.evaluate(t, q_, u_, udot_);
  if (loads != nullptr) loads->calc(t, wrenches_);
  state_.setMotion(q_, u_);
  state_.calcInverseDynamics(udot_, wrenches_, tau_);

  result.coordinates.values.row(row) = q_.transpose();
  result.speeds.values.row(row) = u_.transpose();
  result.accelerations.values.row(row) = udot_.transpose();
  auto forces = result.generalized_forces.values.row(row);
  forces.head(tau_.size()) = tau_.transpose();
  Eigen::Index column = tau_.size();
  for (const CoupledSum& sum : sums_) {
    forces(column++) = tau_(sum.independent.value()) + sum.slope * tau_(sum.dependent.value());
  }
  if (!root_.empty()) setResidualWrench(row, result);
}

// The wrench W at the ground origin with screw_c . W = tau_c for the six root coordinates, moved to
// the mass center.
void IdSolver::setResidualWrench(int row, IdResult& result) const {
  Eigen::Matrix<double, kRootFreedoms, kRootFreedoms> screws;
  Vector6 tau;
  for (int i = 0; i < kRootFreedoms; ++i) {
    const int c = root_[static_cast<std::size_t>(i)];
    screws.row(i) = state_.screws().col(c).transpose();
    tau(i) = tau_(c);
  }
  const Vector6 wrench = screws.partialPivLu().solve(tau);
  const Eigen::Vector3d force = wrench.tail<3>();
  const Eigen::Vector3d moment = wrench.head<3>() - state_.calcMassCenter().cross(force);
  result.residual_wrench.values.row(row) << force.transpose(), moment.transpose();
}

}  // namespace gaitmill
