#include "core/analysis/force_replay.h"

#include <cstddef>
#include <string>

#include <Eigen/Geometry>

#include "core/analysis/table_columns.h"
#include "core/base/units.h"

namespace gaitmill {

namespace {

// Chords of an arc lie on one body and pull it both ways: how many there are does not matter.
constexpr double kArcStep = kPi;  // [rad]

std::vector<std::string> listActuators(const std::vector<ActuatorSpec>& actuators) {
  std::vector<std::string> names;
  for (const ActuatorSpec& actuator : actuators) {
    names.push_back(actuator.name);
  }
  return names;
}

}  // namespace

ForceReplay::ForceReplay(const Model& model, const ForceRecord& record)
    : model_(model),
      record_(record),
      free_(model),
      actuators_(model, free_, record.actuators),
      state_(model),
      paths_(model),
      pose_columns_(getColumns(record.pose, model.coordinateNames())),
      speed_columns_(getColumns(record.speed, model.coordinateNames())),
      muscle_columns_(getColumns(record.muscle_forces, listMuscles(model))),
      actuator_columns_(getColumns(record.actuator_forces, listActuators(record.actuators))),
      q_(model.coordinateCount()),
      u_(model.coordinateCount()),
      u_dot_(model.coordinateCount()),
      zero_(Eigen::VectorXd::Zero(model.coordinateCount())),
      tau_(model.coordinateCount()),
      u_free_(free_.count()),
      demand_(free_.count()),
      muscle_forces_(model.muscleCount()),
      path_speeds_(model.muscleCount()),
      actuator_forces_(actuators_.count()),
      actuator_rates_(actuators_.count()),
      arms_(RowMatrix::Zero(model.muscleCount(), free_.count())),
      columns_(free_.count(), actuators_.count()),
      full_mass_(model.coordinateCount(), model.coordinateCount()),
      mass_(free_.count(), free_.count()),
      factor_(free_.count()),
      pulls_(6, model.bodyCount()) {}

void ForceReplay::setRow(int row) {
  pickRow(record_.pose, row, pose_columns_, q_);
  pickRow(record_.speed, row, speed_columns_, u_);
  pickRow(record_.muscle_forces, row, muscle_columns_, muscle_forces_);
  pickRow(record_.actuator_forces, row, actuator_columns_, actuator_forces_);
  state_.setMotion(q_, u_);
  paths_.calc(state_);
  record_.loads.calc(times()[static_cast<std::size_t>(row)], loads_);
  actuators_.calcColumns(state_, columns_);
}

const Eigen::VectorXd& ForceReplay::calcAcceleration() {
  state_.calcMassMatrix(full_mass_);
  free_.reduceMassMatrix(full_mass_, mass_);
  state_.calcInverseDynamics(zero_, loads_, tau_);
  free_.reduceForces(tau_, demand_);
  demand_ = -demand_;
  free_.reduceColumns(paths_.momentArms(), arms_);
  demand_.noalias() += arms_.transpose() * muscle_forces_;
  demand_.noalias() += columns_ * actuator_forces_;
  factor_.compute(mass_);
  demand_ = factor_.solve(demand_);
  free_.expandRates(demand_, u_dot_);
  return u_dot_;
}

const std::vector<BodyWrench>& ForceReplay::calcBodyForces() {
  forces_ = loads_;
  actuators_.addWrenches(state_, actuator_forces_, forces_);
  addMusclePulls();
  return forces_;
}

void ForceReplay::addMusclePulls() {
  pulls_.setZero();
  const auto pull = [&](BodyIndex body, double tension, const Vector6& wrench) {
    if (body != kGround) {
      pulls_.col(body.value()) += tension * wrench;
    }
  };
  for (int muscle = 0; muscle < model_.muscleCount(); ++muscle) {
    const double tension = muscle_forces_[muscle];
    paths_.tracePath(state_, MuscleIndex(muscle), kArcStep, path_);
    for (std::size_t i = 0; i + 1 < path_.size(); ++i) {
      const PathVertex& a = path_[i];
      const PathVertex& b = path_[i + 1];
      const Eigen::Vector3d step = b.p_G - a.p_G;
      if (a.body == b.body || step.isZero(0.0)) {
        continue;
      }
      const Eigen::Vector3d e = step.normalized();
      Vector6 wrench;
      wrench << a.p_G.cross(e), e;
      pull(a.body, tension, wrench);
      pull(b.body, -tension, wrench);
    }
  }
  for (int body = 0; body < model_.bodyCount(); ++body) {
    forces_.push_back({BodyIndex(body), pulls_.col(body)});
  }
}

ForceReplay::Powers ForceReplay::calcPowers() {
  Powers powers;
  paths_.calcSpeeds(u_, path_speeds_);
  powers.muscles = -muscle_forces_.dot(path_speeds_);
  free_.pick(u_, u_free_);
  actuator_rates_.noalias() = columns_.transpose() * u_free_;
  for (int k = 0; k < actuators_.count(); ++k) {
    const bool across_joint =
        actuators_.specs()[static_cast<std::size_t>(k)].kind == ActuatorSpec::Kind::kCoordinate;
    (across_joint ? powers.actuators : powers.residuals) +=
        actuator_forces_[k] * actuator_rates_[k];
  }
  powers.actuators += state_.calcPassivePower();
  for (const BodyWrench& load : loads_) {
    powers.ground += load.wrench.dot(state_.calcBodyVelocity(load.body));
  }
  return powers;
}

}  // namespace gaitmill
