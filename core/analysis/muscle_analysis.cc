#include "core/analysis/muscle_analysis.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/analysis/table_columns.h"
#include "core/base/error.h"
#include "core/model/free_coordinates.h"
#include "core/model/muscle_paths.h"
#include "core/muscle/muscle.h"

namespace gaitmill {

namespace {

using Columns = std::vector<int>;

/// One muscle at one instant.
struct Sample {
  double activation;
  double tendon_force;
  double fiber_length;  ///< NaN unless it was simulated
  double path_length;
  double path_speed;
};

/// Forces along the tendon.
struct FiberForces {
  double active;
  double passive;
};

class Analyst {
 public:
  Analyst(const Model& model, const MuscleRecord& record)
      : model_(model),
        record_(record),
        names_(listMuscles(model)),
        pose_columns_(getColumns(record.pose, model.coordinateNames())),
        speed_columns_(getColumns(record.speed, model.coordinateNames())),
        activation_columns_(getColumns(record.activation, names_)),
        force_columns_(getColumns(record.tendon_force, names_)),
        free_(model),
        state_(model),
        paths_(model),
        muscles_(makeMuscles(model.spec().muscles)),
        q_(model.coordinateCount()),
        u_(model.coordinateCount()),
        path_speeds_(model.muscleCount()),
        arms_(RowMatrix::Zero(model.muscleCount(), free_.count())),
        largest_arms_(Eigen::VectorXd::Zero(free_.count())),
        total_(makeMoments()),
        passive_(makeMoments()) {
    if (record.fiber_length != nullptr) {
      length_columns_ = getColumns(*record.fiber_length, names_);
    }
    const bool has_lengths = record.fiber_length != nullptr;
    check(has_lengths == (record.source == FiberSource::kSimulated),
          "fiber lengths come with a simulation, and only with it");
    result_.active_fiber_forces = makeTable("active_fiber_forces", "N");
    result_.passive_fiber_forces = makeTable("passive_fiber_forces", "N");
    result_.norm_fiber_lengths = makeTable("norm_fiber_lengths", "");
    result_.norm_fiber_velocities = makeTable("norm_fiber_velocities", "");
    result_.pennation_angles = makeTable("pennation_angles", "rad");
    result_.fiber_active_powers = makeTable("fiber_active_powers", "W");
    result_.fiber_passive_powers = makeTable("fiber_passive_powers", "W");
    result_.tendon_powers = makeTable("tendon_powers", "W");
    result_.muscle_powers = makeTable("muscle_powers", "W");
  }

  MuscleAnalysis analyze() {
    for (int row = 0; row < record_.tendon_force.rowCount(); ++row) {
      placePaths(row);
      for (int muscle = 0; muscle < model_.muscleCount(); ++muscle) {
        analyzeMuscle(row, muscle);
      }
      sumMoments(row);
    }
    result_.muscle_moments = joinMoments();
    return std::move(result_);
  }

 private:
  TimeSeries makeTable(const char* name, const char* unit) const {
    TimeSeries table = makeTimeSeries(name, names_, record_.tendon_force.time);
    table.units.assign(names_.size(), unit);
    return table;
  }

  RowMatrix makeMoments() const {
    return RowMatrix::Zero(record_.tendon_force.rowCount(), free_.count());
  }

  void placePaths(int row) {
    pickRow(record_.pose, row, pose_columns_, q_);
    pickRow(record_.speed, row, speed_columns_, u_);
    state_.setPose(q_);
    paths_.calc(state_);
    paths_.calcSpeeds(u_, path_speeds_);
    free_.reduceColumns(paths_.momentArms(), arms_);
    for (int muscle = 0; muscle < model_.muscleCount(); ++muscle) {
      largest_arms_ = largest_arms_.cwiseMax(arms_.row(muscle).cwiseAbs().transpose());
    }
  }

  Sample readSample(int row, int muscle) const {
    const auto m = static_cast<std::size_t>(muscle);
    double fiber_length = std::numeric_limits<double>::quiet_NaN();
    if (record_.fiber_length != nullptr) {
      fiber_length = record_.fiber_length->values(row, length_columns_[m]);
    }
    return {record_.activation.values(row, activation_columns_[m]),
            record_.tendon_force.values(row, force_columns_[m]),
            fiber_length,
            paths_.lengths()[muscle],
            path_speeds_[muscle]};
  }

  FiberState calcFiber(const Muscle& muscle, const Sample& sample) const {
    return record_.source == FiberSource::kSimulated
               ? muscle.calcState(
                     sample.activation, sample.fiber_length, sample.path_length, sample.path_speed)
               : muscle.calcRigid(sample.activation, sample.path_length, sample.path_speed);
  }

  FiberForces splitForce(const Muscle& muscle,
                         const Sample& sample,
                         const FiberState& fiber) const {
    switch (record_.source) {
      case FiberSource::kSimulated:
        return {fiber.active_force * fiber.cos_pennation,
                fiber.passive_force * fiber.cos_pennation};
      case FiberSource::kRigidActive:
        return {sample.tendon_force, 0.0};
      case FiberSource::kRigidWithPassive:
        break;
    }
    const double passive =
        muscle.maxIsometricForce() * fiber.passive_multiplier * fiber.cos_pennation;
    return {sample.tendon_force - passive, passive};
  }

  void analyzeMuscle(int row, int m) {
    const Muscle& muscle = muscles_[static_cast<std::size_t>(m)];
    const Sample sample = readSample(row, m);
    const FiberState fiber = calcFiber(muscle, sample);
    const FiberForces force = splitForce(muscle, sample, fiber);
    // The fiber keeps its height, so that its projection on the tendon moves at v / cos(alpha).
    const double along_speed = fiber.velocity / fiber.cos_pennation;
    result_.active_fiber_forces.values(row, m) = force.active;
    result_.passive_fiber_forces.values(row, m) = force.passive;
    result_.norm_fiber_lengths.values(row, m) = fiber.length / muscle.optimalFiberLength();
    result_.norm_fiber_velocities.values(row, m) = fiber.norm_velocity;
    result_.pennation_angles.values(row, m) = std::acos(std::min(1.0, fiber.cos_pennation));
    result_.fiber_active_powers.values(row, m) = -force.active * along_speed;
    result_.fiber_passive_powers.values(row, m) = -force.passive * along_speed;
    result_.tendon_powers.values(row, m) = -sample.tendon_force * (sample.path_speed - along_speed);
    result_.muscle_powers.values(row, m) = -sample.tendon_force * sample.path_speed;
  }

  void sumMoments(int row) {
    for (int m = 0; m < model_.muscleCount(); ++m) {
      const double force =
          record_.tendon_force.values(row, force_columns_[static_cast<std::size_t>(m)]);
      total_.row(row) += force * arms_.row(m);
      passive_.row(row) += result_.passive_fiber_forces.values(row, m) * arms_.row(m);
    }
  }

  TimeSeries joinMoments() const {
    TimeSeries moments = makeTimeSeries("muscle_moments", {}, record_.tendon_force.time);
    std::vector<int> moved;
    for (int c = 0; c < free_.count(); ++c) {
      if (largest_arms_[c] > 0) {
        const CoordinateIndex index = free_.indices()[static_cast<std::size_t>(c)];
        for (const char* part : {"_muscle_moment", "_active_moment", "_passive_moment"}) {
          moments.labels.push_back(model_.coordinate(index).name + part);
          moments.units.emplace_back(
              model_.motionKind(index) == MotionKind::kTranslational ? "N" : "N.m");
        }
        moved.push_back(c);
      }
    }
    moments.values.resize(moments.rowCount(), moments.columnCount());
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(3 * i);
      moments.values.col(column) = total_.col(moved[i]);
      moments.values.col(column + 1) = total_.col(moved[i]) - passive_.col(moved[i]);
      moments.values.col(column + 2) = passive_.col(moved[i]);
    }
    return moments;
  }

  const Model& model_;
  const MuscleRecord& record_;
  std::vector<std::string> names_;
  Columns pose_columns_, speed_columns_, activation_columns_, force_columns_, length_columns_;
  FreeCoordinates free_;
  ModelState state_;
  MusclePaths paths_;
  std::vector<Muscle> muscles_;
  Eigen::VectorXd q_, u_;         // (n_coordinates)
  Eigen::VectorXd path_speeds_;   // (n_muscles)
  RowMatrix arms_;                // (n_muscles x n_free)
  Eigen::VectorXd largest_arms_;  // (n_free) over all rows
  RowMatrix total_, passive_;     // (n_rows x n_free)
  MuscleAnalysis result_;
};

}  // namespace

MuscleAnalysis analyzeMuscles(const Model& model, const MuscleRecord& record) {
  return Analyst(model, record).analyze();
}

}  // namespace gaitmill
