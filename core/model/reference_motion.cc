#include "core/model/reference_motion.h"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/math/table_filters.h"

namespace gaitmill {
namespace {

constexpr int kDegree = 5;

// Spline through the first derivatives of `spline` at `times`.
NaturalSpline differentiate(const NaturalSpline& spline, const std::vector<double>& times) {
  RowMatrix slopes(static_cast<Eigen::Index>(times.size()), spline.columnCount());
  Eigen::VectorXd value(spline.columnCount());
  Eigen::VectorXd first(spline.columnCount());
  Eigen::VectorXd second(spline.columnCount());
  for (std::size_t i = 0; i < times.size(); ++i) {
    spline.evaluate(times[i], value, first, second);
    slopes.row(static_cast<Eigen::Index>(i)) = first.transpose();
  }
  return NaturalSpline(times, slopes, kDegree);
}

std::optional<int> findCoordinateColumn(const TimeSeries& table, const std::string& coordinate) {
  if (const auto column = table.findColumn(coordinate)) {
    return column;
  }
  const std::string ending = "/" + coordinate + "/value";
  for (std::size_t i = 0; i < table.labels.size(); ++i) {
    const std::string& label = table.labels[i];
    if (label.size() > ending.size() &&
        label.compare(label.size() - ending.size(), ending.size(), ending) == 0) {
      return static_cast<int>(i);
    }
  }
  return std::nullopt;
}

}  // namespace

ReferenceMotion::ReferenceMotion(const Model& model,
                                 const FreeCoordinates& free,
                                 const TimeSeries& table)
    : ReferenceMotion(collect(model, free, table)) {}

ReferenceMotion::ReferenceMotion(Rows rows)
    : times_(std::move(rows.time)),
      pose_(times_, rows.q, kDegree),
      speed_(differentiate(pose_, times_)),
      acceleration_(differentiate(speed_, times_)) {}

ReferenceMotion::Rows ReferenceMotion::collect(const Model& model,
                                               const FreeCoordinates& free,
                                               const TimeSeries& table) {
  const TimeSeries distinct = dropRepeatedRows(table);
  require(distinct.rowCount() > kDegree,
          ErrorCode::kTableNoRows,
          "coordinates '" + table.name + "' have " + std::to_string(distinct.rowCount()) +
              " distinct times, a quintic spline needs 6");

  Rows rows;
  rows.time = distinct.time;
  rows.q.setZero(distinct.rowCount(), free.count());
  for (int f = 0; f < free.count(); ++f) {
    const CoordinateIndex c = free.indices()[static_cast<std::size_t>(f)];
    const auto column = findCoordinateColumn(
        distinct, model.coordinateNames()[static_cast<std::size_t>(c.value())]);
    if (column) rows.q.col(f) = distinct.values.col(*column);
  }
  return rows;
}

void ReferenceMotion::calcPose(double t, Eigen::Ref<Eigen::VectorXd> q) const {
  pose_.evaluate(t, q);
}

void ReferenceMotion::calcPose(double t,
                               Eigen::Ref<Eigen::VectorXd> q,
                               Eigen::Ref<Eigen::VectorXd> q_dot) const {
  Eigen::Matrix<double, 0, 1> none;
  pose_.evaluate(t, q, q_dot, none);
}

void ReferenceMotion::calcSpeed(double t, Eigen::Ref<Eigen::VectorXd> u) const {
  speed_.evaluate(t, u);
}

void ReferenceMotion::calcAcceleration(double t, Eigen::Ref<Eigen::VectorXd> u_dot) const {
  acceleration_.evaluate(t, u_dot);
}

}  // namespace gaitmill
