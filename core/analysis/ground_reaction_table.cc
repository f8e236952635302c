#include "core/analysis/ground_reaction_table.h"

#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "core/base/error.h"

namespace gaitmill {

namespace {

// Below this a centre of pressure is a quotient of noise; the usual threshold of a loaded plate.
constexpr double kLeastForce = 20;  // [N]
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kTimeSlack = 1e-9;  // [s]
constexpr Eigen::Index kColumnsPerFoot = 7;

/// Samples inside the interval, none closer than the step to the one before.
std::vector<Eigen::Index> pickSamples(const std::vector<double>& time,
                                      double start,
                                      double end,
                                      double least_step) {
  std::vector<Eigen::Index> samples;
  double last = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < time.size(); ++i) {
    const bool inside = time[i] >= start - kTimeSlack && time[i] <= end + kTimeSlack;
    if (inside && time[i] - last >= least_step - kTimeSlack) {
      samples.push_back(static_cast<Eigen::Index>(i));
      last = time[i];
    }
  }
  return samples;
}

/// All forces on one foot at one sample.
struct FootLoad {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< about the ground origin
  double floor = 0;                                  ///< height, weighted with the vertical forces

  void add(const ExternalForce& one, Eigen::Index sample) {
    const Eigen::Vector3d F = one.force.col(sample);
    const Eigen::Vector3d T = one.torque.col(sample);
    if (F.isZero(0.0) && T.isZero(0.0)) {
      return;
    }
    const Eigen::Vector3d p = one.point.col(sample);
    force += F;
    moment += p.cross(F) + T;
    floor += p.y() * F.y();
  }

  /// fx fy fz px py pz my
  Eigen::Matrix<double, 1, kColumnsPerFoot> report() const {
    Eigen::Matrix<double, 1, kColumnsPerFoot> row;
    row << force.transpose(), kNan, kNan, kNan, 0;
    if (force.y() < kLeastForce) {
      return row;
    }
    // p x F + (0, T, 0) = moment with p on the floor.
    Eigen::Vector3d p(0, floor / force.y(), 0);
    p.x() = (moment.z() + p.y() * force.x()) / force.y();
    p.z() = (p.y() * force.z() - moment.x()) / force.y();
    row.segment<3>(3) = p.transpose();
    row[6] = moment.y() - p.cross(force).y();
    return row;
  }
};

}  // namespace

TimeSeries makeGroundReactionTable(const GroundReaction& reaction,
                                   const std::vector<Foot>& feet,
                                   double start,
                                   double end,
                                   double least_step) {
  check(feet.size() == reaction.forces.size(), "every force needs its foot, known or not");
  const std::vector<Eigen::Index> samples = pickSamples(reaction.time, start, end, least_step);
  std::vector<double> time;
  for (const Eigen::Index sample : samples) {
    time.push_back(reaction.time[static_cast<std::size_t>(sample)]);
  }
  TimeSeries table = makeTimeSeries("ground_reactions", {}, std::move(time));
  for (const char* foot : {"right", "left"}) {
    for (const char* axis : {"_fx", "_fy", "_fz", "_px", "_py", "_pz", "_my"}) {
      table.labels.push_back(std::string(foot) + axis);
      table.units.emplace_back(axis[1] == 'f' ? "N" : axis[1] == 'p' ? "m" : "N.m");
    }
  }
  table.values.resize(table.rowCount(), table.columnCount());
  for (int row = 0; row < table.rowCount(); ++row) {
    FootLoad right;
    FootLoad left;
    for (std::size_t i = 0; i < feet.size(); ++i) {
      if (feet[i] != Foot::kUnknown) {
        (feet[i] == Foot::kRight ? right : left)
            .add(reaction.forces[i], samples[static_cast<std::size_t>(row)]);
      }
    }
    table.values.row(row) << right.report(), left.report();
  }
  return table;
}

}  // namespace gaitmill
