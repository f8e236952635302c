#include "core/io/model_table.h"

#include <cstddef>
#include <string_view>

#include "core/base/text.h"
#include "core/base/units.h"

namespace gaitmill {

namespace {

constexpr double kCentimetresPerMetre = 100.0;

/// Without the sign of a zero.
std::string fixed(double value, int decimals) {
  const std::string text = formatFixed(value, decimals);
  const bool minus_zero = text.front() == '-' && text.find_first_not_of("-0.") == std::string::npos;
  return minus_zero ? text.substr(1) : text;
}

std::string padLeft(const std::string& text, std::size_t width) {
  return text.size() >= width ? text : std::string(width - text.size(), ' ') + text;
}

std::string padRight(const std::string& text, std::size_t width) {
  return text.size() >= width ? text + " " : text + std::string(width - text.size(), ' ');
}

bool endsWith(std::string_view text, std::string_view ending) {
  return text.size() > ending.size() && text.substr(text.size() - ending.size()) == ending;
}

bool haveSameParameters(const MuscleSpec& a, const MuscleSpec& b) {
  return a.max_isometric_force == b.max_isometric_force &&
         a.optimal_fiber_length == b.optimal_fiber_length &&
         a.tendon_slack_length == b.tendon_slack_length &&
         a.pennation_at_optimal == b.pennation_at_optimal && a.tendon == b.tendon;
}

/// Row name of a muscle: "soleus" for soleus_r where soleus_l is the same, "" for that soleus_l.
std::string findRowName(const ModelSpec& spec, const MuscleSpec& muscle) {
  const std::string stem = muscle.name.substr(0, muscle.name.size() - 1);
  const bool right = endsWith(muscle.name, "_r");
  if (!right && !endsWith(muscle.name, "_l")) {
    return muscle.name;
  }
  const int other = spec.findMuscle(stem + (right ? "l" : "r"));
  if (other < 0 || !haveSameParameters(muscle, spec.muscles[static_cast<std::size_t>(other)])) {
    return muscle.name;
  }
  return right ? stem.substr(0, stem.size() - 1) : "";
}

void appendCounts(std::string& text, const ModelSpec& spec) {
  const ModelCounts counts = countModel(spec);
  const auto n = [](int count) {
    return std::to_string(count);
  };
  text += "Model " + spec.name + "\n";
  if (!spec.credits.empty()) {
    text += spec.credits + "\n";
  }
  text += "\n" + n(counts.bodies) + " bodies, " + fixed(spec.calcTotalMass(), 4) + " kg\n";
  text += n(counts.joints) + " joints, " + n(counts.coordinates) + " coordinates (" +
          n(counts.coupled_coordinates) + " coupled, " + n(counts.locked_coordinates) +
          " locked)\n";
  text += n(counts.muscles) + " muscles (" + n(counts.rigid_tendons) + " with rigid tendon), " +
          n(counts.wrap_cylinders) + " wrap cylinders";
  text += counts.wrap_spheres > 0 ? ", " + n(counts.wrap_spheres) + " wrap spheres" : "";
  text += counts.wrap_ellipsoids > 0 ? ", " + n(counts.wrap_ellipsoids) + " wrap ellipsoids" : "";
  text += counts.passive_forces > 0 ? ", " + n(counts.passive_forces) + " passive forces" : "";
  text += "\n";
  text += n(counts.actuators) + " actuators, " + n(counts.markers) + " markers\n";
}

void appendMuscles(std::string& text, const ModelSpec& spec) {
  text += "\nMuscle            F0M [N]  l0M [cm]  lsT [cm]  alpha0 [deg]\n";
  for (const MuscleSpec& muscle : spec.muscles) {
    const std::string name = findRowName(spec, muscle);
    if (name.empty()) {
      continue;
    }
    const std::string mark = muscle.tendon == TendonKind::kRigid ? "*" : " ";
    text += padRight(name, 16) + padLeft(fixed(muscle.max_isometric_force, 0), 9) +
            padLeft(fixed(muscle.optimal_fiber_length * kCentimetresPerMetre, 1), 10) +
            padLeft(fixed(muscle.tendon_slack_length * kCentimetresPerMetre, 1) + mark, 11) +
            padLeft(fixed(toDegrees(muscle.pennation_at_optimal), 1), 13) + "\n";
  }
  text += "* rigid tendon; names without side hold for left and right\n";
}

void appendBodies(std::string& text, const ModelSpec& spec) {
  text += "\nBody              mass [kg]    mass center [m]\n";
  for (const BodySpec& body : spec.bodies) {
    text += padRight(body.name, 16) + padLeft(fixed(body.mass, 4), 11) + "  ";
    for (const double component : body.mass_center) {
      text += padLeft(fixed(component, 4), 9);
    }
    text += "\n";
  }
}

void appendCoordinate(std::string& text, const JointSpec& joint, const CoordinateSpec& coordinate) {
  const bool angle = findMotionKind(joint, coordinate.name) == MotionKind::kRotational;
  const double factor = angle ? kDegreesPerRadian : 1.0;
  const int decimals = angle ? 1 : 3;
  text += padRight(coordinate.name, 22) + padRight(joint.name, 20) +
          padLeft(fixed(coordinate.range_min * factor, decimals), 12) +
          padLeft(fixed(coordinate.range_max * factor, decimals), 12) + (angle ? " deg" : "    ") +
          (coordinate.clamped ? "  clamped" : "") + (coordinate.locked ? "  locked" : "") + "\n";
}

void appendCoordinates(std::string& text, const ModelSpec& spec) {
  text += "\nCoordinate            joint                    minimum     maximum\n";
  for (const JointSpec& joint : spec.joints) {
    for (const CoordinateSpec& coordinate : joint.coordinates) {
      appendCoordinate(text, joint, coordinate);
    }
  }
}

void appendActuators(std::string& text, const ModelSpec& spec) {
  if (spec.actuators.empty()) {
    return;
  }
  text += "\nActuator              on                    optimal force\n";
  for (const ActuatorSpec& actuator : spec.actuators) {
    const bool on_coordinate = actuator.kind == ActuatorSpec::Kind::kCoordinate;
    text += padRight(actuator.name, 22) +
            padRight(on_coordinate ? actuator.coordinate : actuator.body, 22) +
            padLeft(fixed(actuator.optimal_force, 3), 13) + "\n";
  }
}

void countWraps(const std::vector<WrapObjectSpec>& wraps, ModelCounts& counts) {
  for (const WrapObjectSpec& wrap : wraps) {
    switch (wrap.kind) {
      case WrapObjectSpec::Kind::kCylinder:
        ++counts.wrap_cylinders;
        break;
      case WrapObjectSpec::Kind::kSphere:
        ++counts.wrap_spheres;
        break;
      case WrapObjectSpec::Kind::kEllipsoid:
        ++counts.wrap_ellipsoids;
        break;
    }
  }
}

}  // namespace

ModelCounts countModel(const ModelSpec& spec) {
  ModelCounts counts;
  counts.bodies = static_cast<int>(spec.bodies.size());
  counts.joints = static_cast<int>(spec.joints.size());
  counts.muscles = static_cast<int>(spec.muscles.size());
  counts.actuators = static_cast<int>(spec.actuators.size());
  counts.markers = static_cast<int>(spec.markers.size());
  counts.passive_forces = static_cast<int>(spec.passive_forces.size());
  countWraps(spec.ground_wrap_objects, counts);
  for (const JointSpec& joint : spec.joints) {
    counts.coordinates += static_cast<int>(joint.coordinates.size());
    for (const CoordinateSpec& coordinate : joint.coordinates) {
      counts.locked_coordinates += coordinate.locked ? 1 : 0;
    }
  }
  for (const CouplerSpec& coupler : spec.couplers) {
    counts.coupled_coordinates += coupler.enforced ? 1 : 0;
  }
  for (const MuscleSpec& muscle : spec.muscles) {
    counts.rigid_tendons += muscle.tendon == TendonKind::kRigid ? 1 : 0;
  }
  for (const BodySpec& body : spec.bodies) {
    countWraps(body.wrap_objects, counts);
  }
  return counts;
}

std::string formatModelTable(const ModelSpec& spec) {
  std::string text;
  appendCounts(text, spec);
  appendMuscles(text, spec);
  appendBodies(text, spec);
  appendCoordinates(text, spec);
  appendActuators(text, spec);
  return text;
}

}  // namespace gaitmill
