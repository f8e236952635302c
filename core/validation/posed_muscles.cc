#include "core/validation/posed_muscles.h"

#include <algorithm>

namespace gaitmill {

namespace {

// Locks are released. Masses play no part in paths and arms: replaced, so that a document whose
// inertia no body can have (the toes of Rajagopal2015) can be posed.
ModelSpec makePosable(ModelSpec spec) {
  for (JointSpec& joint : spec.joints) {
    for (CoordinateSpec& coordinate : joint.coordinates) {
      coordinate.locked = false;
    }
  }
  for (BodySpec& body : spec.bodies) {
    body.mass = 1;
    body.mass_center.setZero();
    body.inertia = {1, 1, 1, 0, 0, 0};
  }
  return spec;
}

double findNeutral(const CoordinateSpec& coordinate) {
  if (coordinate.locked) {
    return coordinate.default_value;
  }
  return coordinate.clamped ? std::max(coordinate.range_min, std::min(0.0, coordinate.range_max))
                            : 0.0;
}

}  // namespace

IsometricForce calcIsometricForce(const Muscle& muscle, double activation, double path_length) {
  const double length =
      muscle.hasRigidTendon() ? 0.0 : muscle.solveStaticLength(activation, path_length);
  const FiberState state = muscle.calcState(activation, length, path_length, 0);
  return {state.tendon_force, state.passive_force * state.cos_pennation, state.length};
}

PosedMuscles::PosedMuscles(const ModelSpec& model)
    : model_(makePosable(model)),
      free_(model_),
      muscles_(makeMuscles(model.muscles)),
      neutral_(model_.coordinateCount()),
      q_(model_.coordinateCount()),
      state_(model_),
      paths_(model_),
      arms_(model_.muscleCount(), free_.count()) {
  for (int c = 0; c < model_.coordinateCount(); ++c) {
    const std::string& name = model_.coordinateNames()[static_cast<std::size_t>(c)];
    neutral_[c] = findNeutral(*model.findCoordinate(name));
  }
  setPose(std::vector<CoordinateValue>{});
}

void PosedMuscles::setPose(const std::vector<CoordinateValue>& pose) {
  q_ = neutral_;
  for (const CoordinateValue& at : pose) {
    q_[model_.getCoordinate(at.coordinate).value()] = at.value;
  }
  setPose(Eigen::VectorXd(q_));
}

void PosedMuscles::setPose(const Eigen::Ref<const Eigen::VectorXd>& q) {
  q_ = q;
  free_.conformPose(q_);
  state_.setPose(q_);
  paths_.calc(state_);
  free_.reduceColumns(paths_.momentArms(), arms_);
}

double PosedMuscles::findMomentArm(MuscleIndex m, CoordinateIndex free) const {
  return arms_(m.value(), free_.findFree(free));
}

}  // namespace gaitmill
