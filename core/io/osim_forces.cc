#include "core/io/osim_forces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/base/units.h"
#include "core/io/number_text.h"
#include "core/io/osim_joints.h"

namespace gaitmill {

namespace {

using Vector3d = Eigen::Vector3d;

// "-Inf" and "Inf" of a document, as ActuatorSpec states them.
constexpr double kNoLimit = 1e300;

// Documents below this wrote a muscle's lower control limit even where it was the old class default
// 0, which counts as not stated (spec/model.md 9).
constexpr int kFirstVersionWithMeantControls = 30513;

constexpr std::array<const char*, 13> kQuadrants = {
    "all", "x", "+x", "-x", "y", "+y", "-y", "z", "+z", "-z", "X", "Y", "Z"};

double limitedControl(double value) {
  return std::clamp(value, -kNoLimit, kNoLimit);
}

/// Sizes of a wrap object of the kind that the element's type names.
void readWrapSize(const OsimElement& element, WrapObjectSpec& spec) {
  if (element.type() == "WrapCylinder") {
    spec.kind = WrapObjectSpec::Kind::kCylinder;
    spec.radius = element.number("radius", 1.0);
    spec.length = element.number("length", 1.0);
  } else if (element.type() == "WrapSphere") {
    spec.kind = WrapObjectSpec::Kind::kSphere;
    spec.radius = element.number("radius", 0.05);
  } else if (element.type() == "WrapEllipsoid") {
    spec.kind = WrapObjectSpec::Kind::kEllipsoid;
    spec.semi_axes = element.vector3("dimensions", spec.semi_axes);
  } else if (element.type() == "WrapTorus") {
    element.fail(ErrorCode::kModelUnsupported,
                 element.describe() +
                     ": paths through a torus follow no rigid surface, so that their moment arms "
                     "would not be those of their lengths");
  } else {
    element.fail(
        ErrorCode::kModelUnsupported,
        element.describe() + ": muscle paths over this kind of surface are not known here");
  }
  if (!(spec.radius > 0) || !(spec.length > 0) || !(spec.semi_axes.minCoeff() > 0)) {
    element.fail(ErrorCode::kModelValue, element.describe() + " needs sizes above 0");
  }
}

/// One number of a muscle with the interval it must lie in.
struct MuscleField {
  const char* tag;
  double minimum;
  bool minimum_allowed;
  double fallback;
};

double readField(const OsimElement& muscle, const MuscleField& field) {
  const double value = muscle.number(field.tag, field.fallback);
  const bool high_enough = field.minimum_allowed ? value >= field.minimum : value > field.minimum;
  if (!high_enough || !std::isfinite(value)) {
    const OsimElement place = muscle.property(field.tag);
    (place ? place : muscle)
        .fail(ErrorCode::kMuscleParameter,
              muscle.describe() + ": " + field.tag + " is " + formatNumber(value) + ", expected " +
                  (field.minimum_allowed ? ">= " : "> ") + formatNumber(field.minimum));
  }
  return value;
}

void readControlLimits(const OsimElement& muscle, MuscleSpec& spec) {
  // The default is the class's minimum activation, whatever minimum this muscle states.
  const double fallback = spec.kind == MuscleKind::kSchutte1993 ? 0.0 : 0.01;
  spec.min_control = muscle.number("min_control", fallback);
  spec.max_control = muscle.number("max_control", 1.0);
  if (muscle.document().version() < kFirstVersionWithMeantControls && spec.min_control == 0.0) {
    spec.min_control = fallback;
  }
  spec.min_control = limitedControl(spec.min_control);
  spec.max_control = limitedControl(spec.max_control);
}

struct MuscleType {
  std::string_view name;
  MuscleKind kind;
};
constexpr std::array<MuscleType, 4> kMuscleTypes = {{
    {"Millard2012EquilibriumMuscle", MuscleKind::kMillard2012},
    {"Thelen2003Muscle", MuscleKind::kThelen2003},
    {"Schutte1993Muscle_Deprecated", MuscleKind::kSchutte1993},
    {"Schutte1993Muscle", MuscleKind::kSchutte1993},
}};

const MuscleType* findMuscleType(const OsimElement& force) {
  const auto* const found =
      std::find_if(kMuscleTypes.begin(), kMuscleTypes.end(), [&](const MuscleType& type) {
        return force.type() == type.name;
      });
  return found == kMuscleTypes.end() ? nullptr : found;
}

/// What all kinds of muscles state, with the class defaults of spec/muscle.md 2.
void readMuscleParameters(const OsimElement& muscle, MuscleSpec& spec) {
  spec.max_isometric_force = readField(muscle, {"max_isometric_force", 0, false, 1000});
  spec.optimal_fiber_length = readField(muscle, {"optimal_fiber_length", 0, false, 0.1});
  spec.tendon_slack_length = readField(muscle, {"tendon_slack_length", 0, false, 0.2});
  spec.pennation_at_optimal = readField(muscle, {"pennation_angle_at_optimal", 0, true, 0});
  spec.max_contraction_velocity = readField(muscle, {"max_contraction_velocity", 0, false, 10});
  spec.default_activation = readField(muscle, {"default_activation", 0, true, 0.05});
  spec.default_fiber_length = readField(muscle, {"default_fiber_length", 0, false, 0.1});
  spec.maximum_pennation = readField(muscle, {"maximum_pennation_angle", 0, false, std::acos(0.1)});
  if (spec.pennation_at_optimal >= kPi / 2) {
    muscle.property("pennation_angle_at_optimal")
        .fail(ErrorCode::kMuscleParameter,
              muscle.describe() +
                  ": pennation_angle_at_optimal must be below a right angle, in "
                  "radians");
  }
  if (muscle.boolean("ignore_activation_dynamics", false)) {
    muscle.fail(ErrorCode::kModelUnsupported,
                muscle.describe() + ": muscles without activation dynamics cannot be simulated");
  }
}

/// Whether the last three, optional properties of a curve are stated. One or two of three is an
/// error in the format.
bool hasAllOptional(const OsimElement& curve, std::initializer_list<const char*> tags) {
  const auto stated =
      std::count_if(tags.begin(), tags.end(), [&](const char* tag) { return curve.has(tag); });
  if (stated != 0 && stated != static_cast<std::ptrdiff_t>(tags.size())) {
    curve.fail(
        ErrorCode::kMuscleParameter,
        curve.describe() + " states some of its optional properties; all or none are needed");
  }
  return stated != 0;
}

void readActiveCurve(const OsimElement& curve, MuscleCurvesSpec& spec) {
  spec.active_min_length = curve.number("min_norm_active_fiber_length", 0.47 - 0.0259);
  spec.active_transition_length = curve.number("transition_norm_fiber_length", 0.73);
  spec.active_max_length = curve.number("max_norm_active_fiber_length", 1.8123);
  spec.active_shallow_slope = curve.number("shallow_ascending_slope", 0.8616);
  spec.active_minimum_value = curve.number("minimum_value", 0.1);
}

void readForceVelocityCurve(const OsimElement& curve, MuscleCurvesSpec& spec) {
  spec.concentric_slope_at_vmax = curve.number("concentric_slope_at_vmax", 0);
  spec.concentric_slope_near_vmax = curve.number("concentric_slope_near_vmax", 0.25);
  spec.isometric_slope = curve.number("isometric_slope", 5);
  spec.eccentric_slope_at_vmax = curve.number("eccentric_slope_at_vmax", 0);
  spec.eccentric_slope_near_vmax = curve.number("eccentric_slope_near_vmax", 0.15);
  spec.max_eccentric_force = curve.number("max_eccentric_velocity_force_multiplier", 1.4);
  spec.concentric_curviness = curve.number("concentric_curviness", 0.6);
  spec.eccentric_curviness = curve.number("eccentric_curviness", 0.9);
}

void readPassiveCurve(const OsimElement& curve, MuscleCurvesSpec& spec) {
  spec.passive_strain_at_zero_force = curve.number("strain_at_zero_force", 0);
  spec.passive_strain_at_one_force = curve.number("strain_at_one_norm_force", 0.7);
  const double automatic =
      2.0 / (spec.passive_strain_at_one_force - spec.passive_strain_at_zero_force);
  hasAllOptional(curve, {"stiffness_at_low_force", "stiffness_at_one_norm_force", "curviness"});
  spec.passive_stiffness_at_low_force = curve.number("stiffness_at_low_force", 0.2);
  spec.passive_stiffness_at_one_force = curve.number("stiffness_at_one_norm_force", automatic);
  spec.passive_curviness = curve.number("curviness", 0.75);
}

void readTendonCurve(const OsimElement& curve, MuscleCurvesSpec& spec) {
  spec.tendon_strain_at_one_force = curve.number("strain_at_one_norm_force", 0.049);
  const double automatic = 1.375 / spec.tendon_strain_at_one_force;
  hasAllOptional(curve, {"stiffness_at_one_norm_force", "norm_force_at_toe_end", "curviness"});
  spec.tendon_stiffness_at_one_force = curve.number("stiffness_at_one_norm_force", automatic);
  spec.tendon_force_at_toe_end = curve.number("norm_force_at_toe_end", 2.0 / 3.0);
  spec.tendon_curviness = curve.number("curviness", 0.5);
}

void readMillard(const OsimElement& muscle, MuscleSpec& spec) {
  spec.max_contraction_velocity = readField(muscle, {"max_contraction_velocity", 0, false, 10});
  spec.fiber_damping = readField(muscle, {"fiber_damping", 0, true, 0.1});
  spec.activation_time_constant = readField(muscle, {"activation_time_constant", 0, false, 0.010});
  spec.deactivation_time_constant =
      readField(muscle, {"deactivation_time_constant", 0, false, 0.040});
  spec.minimum_activation = readField(muscle, {"minimum_activation", 0, true, 0.01});
  spec.tendon =
      muscle.boolean("ignore_tendon_compliance", false) ? TendonKind::kRigid : TendonKind::kElastic;
  readActiveCurve(muscle.property("ActiveForceLengthCurve"), spec.curves);
  readForceVelocityCurve(muscle.property("ForceVelocityCurve"), spec.curves);
  readPassiveCurve(muscle.property("FiberForceLengthCurve"), spec.curves);
  readTendonCurve(muscle.property("TendonForceLengthCurve"), spec.curves);
}

/// Class defaults of Thelen2003Muscle: spec/muscle.md 10.
void readThelen(const OsimElement& muscle, MuscleSpec& spec) {
  spec.max_contraction_velocity = readField(muscle, {"max_contraction_velocity", 0, false, 10});
  spec.fiber_damping = 0;
  spec.activation_time_constant = readField(muscle, {"activation_time_constant", 0, false, 0.015});
  spec.deactivation_time_constant =
      readField(muscle, {"deactivation_time_constant", 0, false, 0.050});
  spec.minimum_activation = readField(muscle, {"minimum_activation", 0.01, true, 0.01});
  if (muscle.boolean("ignore_tendon_compliance", false)) {
    muscle.property("ignore_tendon_compliance")
        .fail(ErrorCode::kModelUnsupported,
              muscle.describe() + ": a muscle of this type cannot have a rigid tendon");
  }
  ThelenCurvesSpec& curves = spec.thelen;
  curves.tendon_strain_at_one_force = readField(muscle, {"FmaxTendonStrain", 0, false, 0.04});
  curves.passive_strain_at_one_force = readField(muscle, {"FmaxMuscleStrain", 0, false, 0.6});
  curves.active_shape = readField(muscle, {"KshapeActive", 0, false, 0.45});
  curves.passive_shape = readField(muscle, {"KshapePassive", 0, false, 5});
  curves.velocity_shape = readField(muscle, {"Af", 0, false, 0.25});
  curves.max_eccentric_force = readField(muscle, {"Flen", 1, false, 1.4});
  curves.linear_above_force = readField(muscle, {"fv_linear_extrap_threshold", 0, false, 0.95});
}

std::optional<FunctionSpec> readCurve(const OsimElement& muscle, const char* tag) {
  const OsimElement function = muscle.objectProperty(tag, {});
  return function ? std::optional<FunctionSpec>(readFunction(function, muscle)) : std::nullopt;
}

/// Class defaults of Schutte1993Muscle_Deprecated, which states time in units of its time scale and
/// takes the inverse of that for the maximum contraction velocity.
void readSchutte(const OsimElement& muscle, MuscleSpec& spec) {
  const double time_scale = readField(muscle, {"time_scale", 0, false, 0.1});
  spec.max_contraction_velocity = 1 / time_scale;
  spec.fiber_damping = readField(muscle, {"damping", 0, true, 0.1});
  spec.minimum_activation = 0;
  spec.schutte.excitation_rate = readField(muscle, {"activation1", 0, true, 7.667}) / time_scale;
  spec.schutte.activation_rate = readField(muscle, {"activation2", 0, true, 1.459854}) / time_scale;
  // Nothing in a muscle is that fast or slow; the bounds keep the quotients numbers.
  constexpr double kExtreme = 1e9;
  if (time_scale < 1 / kExtreme || time_scale > kExtreme ||
      spec.schutte.excitation_rate > kExtreme || spec.schutte.activation_rate > kExtreme) {
    muscle.fail(ErrorCode::kMuscleParameter,
                muscle.describe() + ": time_scale, activation1 or activation2 is out of range");
  }
  spec.schutte.active_force_length = readCurve(muscle, "active_force_length_curve");
  spec.schutte.passive_force_length = readCurve(muscle, "passive_force_length_curve");
  spec.schutte.tendon_force_strain = readCurve(muscle, "tendon_force_length_curve");
}

/// Coordinate that a path point names, "" if it names none.
std::string readPointCoordinate(const OsimElement& point,
                                const char* socket,
                                const std::vector<JointSpec>& joints) {
  const OsimElement reference = point.socket(socket, {socket});
  const std::string name = reference ? lastComponent(reference.ownText()) : "";
  if (name.empty() || name == "Unassigned") {
    return "";
  }
  requireCoordinate(reference, name, joints);
  return name;
}

void readCondition(const OsimElement& point,
                   const std::vector<JointSpec>& joints,
                   PathPointSpec& spec) {
  spec.kind = PathPointSpec::Kind::kConditional;
  spec.coordinate = readPointCoordinate(point, "coordinate", joints);
  if (const OsimElement range = point.property("range")) {
    const std::vector<double> ends = range.ownNumbers(2);
    spec.range_min = ends[0];
    spec.range_max = ends[1];
  }
}

/// The functions of a moving point, which are of one and the same coordinate (spec/path.md 1).
void readMotion(const OsimElement& point,
                const std::vector<JointSpec>& joints,
                PathPointSpec& spec) {
  struct Component {
    const char* coordinate;
    const char* function;
    const char* old_function;  ///< in documents below 30000
  };
  constexpr std::array<Component, 3> kComponents = {
      {{"x_coordinate", "x_location", "XAttachment"},
       {"y_coordinate", "y_location", "YAttachment"},
       {"z_coordinate", "z_location", "ZAttachment"}}};
  spec.kind = PathPointSpec::Kind::kMoving;
  for (std::size_t axis = 0; axis < kComponents.size(); ++axis) {
    const std::string name = readPointCoordinate(point, kComponents[axis].coordinate, joints);
    if (axis > 0 && name != spec.coordinate) {
      point.fail(ErrorCode::kModelUnsupported,
                 point.describe() + " moves with '" + spec.coordinate + "' and with '" + name +
                     "'; a moving point follows one coordinate");
    }
    spec.coordinate = name;
    OsimElement function = point.objectProperty(kComponents[axis].function, {});
    if (!function) {
      function = point.objectProperty(kComponents[axis].old_function, {});
    }
    if (function) {
      spec.location_functions[axis] = readFunction(function, point);
    }
  }
}

PathPointSpec readPathPoint(const OsimElement& point,
                            const OsimFrames& frames,
                            const std::vector<JointSpec>& joints) {
  const bool moves = point.type() == "MovingPathPoint";
  const bool depends = point.type() == "ConditionalPathPoint";
  if (!moves && !depends && point.type() != "PathPoint") {
    point.fail(ErrorCode::kModelUnsupported,
               point.describe() + " is of a type of path point that cannot be simulated here");
  }
  const OsimElement frame = point.socket("parent_frame", {"body"});
  if (!frame) {
    point.fail(ErrorCode::kModelElement, point.describe() + " names no parent frame");
  }
  if (!moves) {
    PathPointSpec spec = frames.resolvePoint(frame, point.vector3("location", Vector3d::Zero()));
    if (depends) {
      readCondition(point, joints, spec);
    }
    return spec;
  }
  const FrameSpec place = frames.resolve(frame, "");
  if (!place.translation.isZero(0) || !place.orientation.isZero(0)) {
    frame.fail(ErrorCode::kModelUnsupported,
               point.describe() + " moves in a frame that is not a body's own");
  }
  PathPointSpec spec;
  spec.body = place.body;
  readMotion(point, joints, spec);
  return spec;
}

PathWrapSpec readPathWrap(const OsimElement& wrap, const std::vector<std::string>& wrap_objects) {
  PathWrapSpec spec;
  spec.wrap_object = wrap.text("wrap_object");
  if (std::find(wrap_objects.begin(), wrap_objects.end(), spec.wrap_object) == wrap_objects.end()) {
    const OsimElement place = wrap.property("wrap_object");
    (place ? place : wrap)
        .fail(ErrorCode::kModelReference, "there is no wrap object '" + spec.wrap_object + "'");
  }
  if (const OsimElement range = wrap.property("range")) {
    const std::vector<double> ends = range.ownNumbers(2);
    if (std::abs(ends[0]) > 1e6 || std::abs(ends[1]) > 1e6) {
      range.fail(ErrorCode::kModelValue, "a path wrap's range counts path points");
    }
    spec.first_point = static_cast<int>(ends[0]);
    spec.last_point = static_cast<int>(ends[1]);
  }
  spec.method = wrap.text("method", spec.method);
  return spec;
}

void readPath(const OsimElement& muscle,
              const OsimFrames& frames,
              const std::vector<JointSpec>& joints,
              const std::vector<std::string>& wrap_objects,
              MuscleSpec& spec) {
  const OsimElement path = muscle.objectProperty("path", {"GeometryPath"});
  if (!path || path.type() != "GeometryPath") {
    (path ? path : muscle)
        .fail(path ? ErrorCode::kModelUnsupported : ErrorCode::kModelElement,
              muscle.describe() + " has no GeometryPath");
  }
  for (const OsimElement& point : path.objectsOf("PathPointSet")) {
    spec.path.push_back(readPathPoint(point, frames, joints));
  }
  if (spec.path.size() < 2) {
    path.fail(ErrorCode::kModelElement,
              muscle.describe() + " has " + std::to_string(spec.path.size()) +
                  " path points, expected at least 2");
  }
  for (const OsimElement& wrap : path.objectsOf("PathWrapSet")) {
    spec.wraps.push_back(readPathWrap(wrap, wrap_objects));
  }
}

void readCoordinateActuator(const OsimElement& actuator,
                            const std::vector<JointSpec>& joints,
                            ActuatorSpec& spec) {
  spec.kind = ActuatorSpec::Kind::kCoordinate;
  spec.coordinate = lastComponent(actuator.text("coordinate"));
  const OsimElement place = actuator.property("coordinate");
  requireCoordinate(place ? place : actuator, spec.coordinate, joints);
}

void readPointActuator(const OsimElement& actuator, const OsimFrames& frames, ActuatorSpec& spec) {
  spec.kind = ActuatorSpec::Kind::kPoint;
  const OsimElement body = actuator.socket("body", {"body"});
  spec.body = frames.resolveBody(body ? body : actuator);
  spec.point = actuator.vector3("point", Vector3d::Zero());
  spec.direction = actuator.vector3("direction", Vector3d::UnitX());
  spec.direction_in_ground = actuator.boolean("force_is_global", false);
  if (actuator.boolean("point_is_global", false)) {
    actuator.property("point_is_global")
        .fail(ErrorCode::kModelUnsupported,
              actuator.describe() + ": a point fixed in ground cannot be simulated here");
  }
}

void readTorqueActuator(const OsimElement& actuator, const OsimFrames& frames, ActuatorSpec& spec) {
  spec.kind = ActuatorSpec::Kind::kTorque;
  const OsimElement body = actuator.socket("bodyA", {"bodyA"});
  spec.body = frames.resolveBody(body ? body : actuator);
  const OsimElement reaction = actuator.socket("bodyB", {"bodyB"});
  const std::string name = reaction ? reaction.ownText() : "";
  if (!name.empty() && name != "Unassigned") {
    spec.reaction_body = frames.resolveBody(reaction);
  }
  spec.direction = actuator.vector3("axis", Vector3d::UnitZ());
  spec.direction_in_ground = actuator.boolean("torque_is_global", true);
}

}  // namespace

WrapObjectSpec readWrapObject(const OsimElement& element) {
  WrapObjectSpec spec;
  spec.name = element.requireName();
  spec.rotation = element.vector3("xyz_body_rotation", Vector3d::Zero());
  spec.translation = element.vector3("translation", Vector3d::Zero());
  spec.quadrant = element.text("quadrant", "all");
  if (spec.quadrant.empty() || spec.quadrant == "Unassigned") {
    spec.quadrant = "all";
  }
  if (std::find(kQuadrants.begin(), kQuadrants.end(), spec.quadrant) == kQuadrants.end()) {
    element.property("quadrant")
        .fail(ErrorCode::kModelValue,
              "quadrant is 'all' or an axis with a sign, found '" + spec.quadrant + "'");
  }
  spec.active = element.boolean("active", true);
  readWrapSize(element, spec);
  return spec;
}

MuscleSpec readMuscle(const OsimElement& muscle,
                      const OsimFrames& frames,
                      const std::vector<JointSpec>& joints,
                      const std::vector<std::string>& wrap_objects) {
  MuscleSpec spec;
  spec.name = muscle.requireName();
  const MuscleType* type = findMuscleType(muscle);
  check(type != nullptr, "the element is a muscle");
  spec.kind = type->kind;
  readMuscleParameters(muscle, spec);
  readControlLimits(muscle, spec);
  switch (spec.kind) {
    case MuscleKind::kMillard2012:
      readMillard(muscle, spec);
      break;
    case MuscleKind::kThelen2003:
      readThelen(muscle, spec);
      break;
    case MuscleKind::kSchutte1993:
      readSchutte(muscle, spec);
      break;
  }
  readPath(muscle, frames, joints, wrap_objects, spec);
  return spec;
}

bool isMuscle(const OsimElement& force) {
  return findMuscleType(force) != nullptr;
}

bool isActuator(const OsimElement& force) {
  constexpr std::array<std::string_view, 5> kTypes = {
      "CoordinateActuator", "PointActuator", "TorqueActuator", "GeneralizedForce", "Force"};
  return std::find(kTypes.begin(), kTypes.end(), force.type()) != kTypes.end();
}

ActuatorSpec readActuator(const OsimElement& actuator,
                          const OsimFrames& frames,
                          const std::vector<JointSpec>& joints) {
  ActuatorSpec spec;
  spec.name = actuator.requireName();
  if (actuator.type() == "CoordinateActuator" || actuator.type() == "GeneralizedForce") {
    readCoordinateActuator(actuator, joints, spec);
  } else if (actuator.type() == "TorqueActuator") {
    readTorqueActuator(actuator, frames, spec);
  } else {
    readPointActuator(actuator, frames, spec);
  }
  if (spec.direction.norm() == 0) {
    actuator.fail(ErrorCode::kModelValue, actuator.describe() + " has no direction");
  }
  spec.optimal_force = actuator.number("optimal_force", 1.0);
  spec.min_control = limitedControl(actuator.number("min_control", -kNoLimit));
  spec.max_control = limitedControl(actuator.number("max_control", kNoLimit));
  return spec;
}

bool isApplied(const OsimElement& force) {
  return force.has("appliesForce") ? force.boolean("appliesForce", true)
                                   : !force.boolean("isDisabled", false);
}

}  // namespace gaitmill
