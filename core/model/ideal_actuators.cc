#include "core/model/ideal_actuators.h"

#include <cstddef>
#include <set>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "core/base/error.h"

namespace gaitmill {

IdealActuators::IdealActuators(const Model& model,
                               const FreeCoordinates& free,
                               std::vector<ActuatorSpec> specs)
    : free_(free),
      specs_(std::move(specs)),
      optimal_forces_(static_cast<Eigen::Index>(specs_.size())),
      min_forces_(optimal_forces_.size()),
      max_forces_(optimal_forces_.size()),
      tau_(model.coordinateCount()) {
  std::set<std::string> names;
  for (std::size_t k = 0; k < specs_.size(); ++k) {
    const ActuatorSpec& spec = specs_[k];
    require(names.insert(spec.name).second,
            ErrorCode::kModelDuplicateName,
            "two actuators are called '" + spec.name + "'",
            {{}, 0, 0, spec.name});
    Resolved resolved;
    resolved.kind = spec.kind;
    if (spec.kind == ActuatorSpec::Kind::kCoordinate) {
      resolved.coordinate = model.getCoordinate(spec.coordinate);
    } else {
      resolved.body = model.getBody(spec.body);
      resolved.reaction_body =
          spec.reaction_body.empty() ? kGround : model.getBody(spec.reaction_body);
    }
    resolved_.push_back(resolved);
    const auto i = static_cast<Eigen::Index>(k);
    optimal_forces_[i] = spec.optimal_force;
    min_forces_[i] = spec.min_control * spec.optimal_force;
    max_forces_[i] = spec.max_control * spec.optimal_force;
  }
}

BodyWrench IdealActuators::calcUnitWrench(std::size_t k, const ModelState& state) const {
  const ActuatorSpec& spec = specs_[k];
  const Pose& X_GB = state.pose(resolved_[k].body);
  const Eigen::Vector3d direction =
      (spec.direction_in_ground ? spec.direction : X_GB.R * spec.direction).normalized();
  BodyWrench load{resolved_[k].body, Vector6::Zero()};
  if (resolved_[k].kind == ActuatorSpec::Kind::kPoint) {
    load.wrench << (X_GB * spec.point).cross(direction), direction;
  } else {
    load.wrench.head<3>() = direction;
  }
  return load;
}

void IdealActuators::addWrenches(const ModelState& state,
                                 const Eigen::Ref<const Eigen::VectorXd>& forces,
                                 std::vector<BodyWrench>& wrenches) const {
  for (std::size_t k = 0; k < specs_.size(); ++k) {
    if (resolved_[k].kind == ActuatorSpec::Kind::kCoordinate) {
      continue;
    }
    BodyWrench load = calcUnitWrench(k, state);
    load.wrench *= forces[static_cast<Eigen::Index>(k)];
    wrenches.push_back(load);
    if (resolved_[k].kind == ActuatorSpec::Kind::kTorque) {
      wrenches.push_back({resolved_[k].reaction_body, -load.wrench});
    }
  }
}

void IdealActuators::calcColumns(const ModelState& state, Eigen::Ref<Eigen::MatrixXd> columns) {
  for (std::size_t k = 0; k < specs_.size(); ++k) {
    const Resolved& resolved = resolved_[k];
    tau_.setZero();
    if (resolved.kind == ActuatorSpec::Kind::kCoordinate) {
      tau_[resolved.coordinate.value()] = 1;
    } else {
      const BodyWrench load = calcUnitWrench(k, state);
      if (resolved.kind == ActuatorSpec::Kind::kTorque) {
        state.addWrench({resolved.reaction_body, -load.wrench}, tau_);
      }
      state.addWrench(load, tau_);
    }
    free_.reduceForces(tau_, columns.col(static_cast<Eigen::Index>(k)));
  }
}

}  // namespace gaitmill
