#include "core/data/model_spec.h"

#include <cmath>
#include <cstddef>

#include "core/base/error.h"
#include "core/base/where.h"

namespace gaitmill {

namespace {

template <class List>
int findByName(const List& list, const std::string& name) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].name == name) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

bool drivesOneToOne(const TransformAxisSpec& axis, const std::string& coordinate) {
  return axis.coordinate == coordinate && axis.function.kind == FunctionSpec::Kind::kLinear &&
         std::abs(std::abs(axis.function.scale * axis.function.y.at(0)) - 1.0) < 1e-12;
}

}  // namespace

double ModelSpec::calcTotalMass() const {
  double total = 0;
  for (const BodySpec& body : bodies) {
    total += body.mass;
  }
  return total;
}

int ModelSpec::findBody(const std::string& body_name) const {
  return findByName(bodies, body_name);
}

int ModelSpec::findMuscle(const std::string& muscle_name) const {
  return findByName(muscles, muscle_name);
}

int ModelSpec::findMarker(const std::string& marker_name) const {
  return findByName(markers, marker_name);
}

const JointSpec* ModelSpec::findJointOf(const std::string& coordinate_name) const {
  for (const JointSpec& joint : joints) {
    if (findByName(joint.coordinates, coordinate_name) >= 0) {
      return &joint;
    }
  }
  return nullptr;
}

const CoordinateSpec* ModelSpec::findCoordinate(const std::string& coordinate_name) const {
  const JointSpec* joint = findJointOf(coordinate_name);
  if (joint == nullptr) {
    return nullptr;
  }
  const int found = findByName(joint->coordinates, coordinate_name);
  return &joint->coordinates[static_cast<std::size_t>(found)];
}

void setTotalMass(ModelSpec& spec, double total_mass, InertiaScaling inertia) {
  require(std::isfinite(total_mass) && total_mass > 0,
          ErrorCode::kInputValue,
          "total mass must be a positive number of kilograms, found " + std::to_string(total_mass),
          {{}, 0, 0, "mass"});
  const double factor = total_mass / spec.calcTotalMass();
  for (BodySpec& body : spec.bodies) {
    body.mass *= factor;
    if (inertia == InertiaScaling::kWithMass) {
      for (double& entry : body.inertia) {
        entry *= factor;
      }
    }
  }
}

MotionKind findMotionKind(const JointSpec& joint, const std::string& coordinate) {
  const int slot = findByName(joint.coordinates, coordinate);
  switch (joint.kind) {
    case JointSpec::Kind::kPin:
    case JointSpec::Kind::kUniversal:
    case JointSpec::Kind::kGimbal:
      return MotionKind::kRotational;
    case JointSpec::Kind::kSlider:
      return MotionKind::kTranslational;
    case JointSpec::Kind::kPlanar:
      return slot == 0 ? MotionKind::kRotational : MotionKind::kTranslational;
    case JointSpec::Kind::kWeld:
    case JointSpec::Kind::kCustom:
      break;
  }
  MotionKind kind = MotionKind::kCoupled;
  for (std::size_t i = 0; i < joint.axes.size(); ++i) {
    if (drivesOneToOne(joint.axes[i], coordinate)) {
      kind = i < 3 ? MotionKind::kRotational : MotionKind::kTranslational;
    }
  }
  return kind;
}

MotionKind findMotionKind(const ModelSpec& spec, const std::string& coordinate) {
  for (const JointSpec& joint : spec.joints) {
    if (findByName(joint.coordinates, coordinate) >= 0) {
      return findMotionKind(joint, coordinate);
    }
  }
  throw Error(ErrorCode::kInputCoordinates,
              "the model has no coordinate '" + coordinate + "'",
              atCoordinate(coordinate));
}

}  // namespace gaitmill
