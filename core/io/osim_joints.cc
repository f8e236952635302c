#include "core/io/osim_joints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace gaitmill {

namespace {

using Vector3d = Eigen::Vector3d;

constexpr int kMaximumFunctionDepth = 8;
// Shorter axes have no direction; longer ones are normalised (spec/model.md 3).
constexpr double kMinimumAxisLength = 1e-9;

constexpr std::array<const char*, 6> kSlotNames = {
    "rotation1", "rotation2", "rotation3", "translation1", "translation2", "translation3"};

struct JointType {
  const char* name;
  JointSpec::Kind kind;
  std::size_t coordinate_count;
};
constexpr std::size_t kAnyCount = 99;
constexpr std::size_t kFreeCount = 6;
constexpr std::array<JointType, 9> kJointTypes = {{
    {"WeldJoint", JointSpec::Kind::kWeld, 0},
    {"PinJoint", JointSpec::Kind::kPin, 1},
    {"SliderJoint", JointSpec::Kind::kSlider, 1},
    {"UniversalJoint", JointSpec::Kind::kUniversal, 2},
    {"PlanarJoint", JointSpec::Kind::kPlanar, 3},
    {"GimbalJoint", JointSpec::Kind::kGimbal, 3},
    {"CustomJoint", JointSpec::Kind::kCustom, kAnyCount},
    // The same angles; only OpenSim's speeds are not their rates (spec/model.md 4).
    {"BallJoint", JointSpec::Kind::kGimbal, 3},
    {"FreeJoint", JointSpec::Kind::kCustom, kFreeCount},
}};

const JointType& findJointType(const OsimElement& joint) {
  for (const JointType& type : kJointTypes) {
    if (joint.type() == type.name) {
      return type;
    }
  }
  joint.fail(ErrorCode::kModelUnsupported,
             joint.describe() + " is of a joint type that cannot be simulated here");
}

FunctionSpec makeTabulated(FunctionSpec::Kind kind, const OsimElement& function) {
  FunctionSpec spec;
  spec.kind = kind;
  spec.x = function.property("x").ownNumbers();
  spec.y = function.property("y").ownNumbers();
  if (spec.x.size() != spec.y.size() || spec.x.size() < 2) {
    function.fail(ErrorCode::kModelValue,
                  "a function needs as many <x> as <y> and at least 2, found " +
                      std::to_string(spec.x.size()) + " and " + std::to_string(spec.y.size()));
  }
  if (std::adjacent_find(spec.x.begin(), spec.x.end(), std::greater_equal<>()) != spec.x.end()) {
    function.property("x").fail(ErrorCode::kModelValue, "the <x> of a function must increase");
  }
  return spec;
}

std::vector<double> readCoefficients(const OsimElement& function, std::vector<double> fallback) {
  const OsimElement coefficients = function.property("coefficients");
  if (!coefficients) {
    return fallback;
  }
  std::vector<double> values = coefficients.ownNumbers();
  if (values.empty()) {
    coefficients.fail(ErrorCode::kModelValue, "<coefficients> is empty");
  }
  return values;
}

FunctionSpec readFunctionAt(const OsimElement& function, const OsimElement& context, int depth) {
  if (!function) {
    context.fail(ErrorCode::kModelElement, context.describe() + " has no function");
  }
  const std::string_view type = function.type();
  if (type == "Constant") {
    return {FunctionSpec::Kind::kConstant, {}, {function.number("value", 0.0)}, 1.0};
  }
  if (type == "LinearFunction") {
    FunctionSpec spec{FunctionSpec::Kind::kLinear, {}, readCoefficients(function, {1, 0}), 1.0};
    if (spec.y.size() != 2) {
      function.fail(ErrorCode::kModelUnsupported,
                    "a LinearFunction of one coordinate has 2 coefficients, found " +
                        std::to_string(spec.y.size()));
    }
    return spec;
  }
  if (type == "PolynomialFunction") {
    return {FunctionSpec::Kind::kPolynomial, {}, readCoefficients(function, {1}), 1.0};
  }
  if (type == "SimmSpline" || type == "NaturalCubicSpline" || type == "natCubicSpline") {
    return makeTabulated(FunctionSpec::Kind::kSimmSpline, function);
  }
  if (type == "PiecewiseLinearFunction") {
    return makeTabulated(FunctionSpec::Kind::kPiecewiseLinear, function);
  }
  if (type == "MultiplierFunction" && depth < kMaximumFunctionDepth) {
    const OsimElement inner = function.objectProperty("function",
                                                      {"Constant",
                                                       "LinearFunction",
                                                       "PolynomialFunction",
                                                       "SimmSpline",
                                                       "PiecewiseLinearFunction",
                                                       "MultiplierFunction"});
    FunctionSpec spec = readFunctionAt(inner, function, depth + 1);
    spec.scale *= function.number("scale", 1.0);
    return spec;
  }
  function.fail(ErrorCode::kModelUnsupported,
                function.describe() + " is of a function type that cannot be read");
}

CoordinateSpec readCoordinate(const OsimElement& element) {
  CoordinateSpec spec;
  spec.name = element.requireName();
  spec.default_value = element.number("default_value", 0.0);
  spec.default_speed = element.number("default_speed_value", 0.0);
  if (const OsimElement range = element.property("range")) {
    const std::vector<double> ends = range.ownNumbers(2);
    spec.range_min = ends[0];
    spec.range_max = ends[1];
    if (spec.range_min > spec.range_max) {
      range.fail(ErrorCode::kModelValue, "the range of " + element.describe() + " is reversed");
    }
  }
  spec.clamped = element.boolean("clamped", false);
  spec.locked = element.boolean("locked", false);
  const bool has_function = !element.property("prescribed_function").children().empty();
  if (has_function && element.boolean("prescribed", false)) {
    element.fail(ErrorCode::kModelUnsupported,
                 element.describe() +
                     " is prescribed as a function of time, which a gait trial "
                     "cannot use; set prescribed to false");
  }
  return spec;
}

std::vector<CoordinateSpec> readCoordinates(const OsimElement& joint) {
  std::vector<OsimElement> elements = joint.property("coordinates").children();
  if (elements.empty()) {
    elements = joint.objectsOf("CoordinateSet");
  }
  std::vector<CoordinateSpec> specs;
  specs.reserve(elements.size());
  for (const OsimElement& element : elements) {
    specs.push_back(readCoordinate(element));
  }
  return specs;
}

OsimElement findAxisFunction(const OsimElement& axis) {
  return axis.objectProperty("function",
                             {"Constant",
                              "LinearFunction",
                              "PolynomialFunction",
                              "SimmSpline",
                              "NaturalCubicSpline",
                              "natCubicSpline",
                              "PiecewiseLinearFunction",
                              "MultiplierFunction"});
}

TransformAxisSpec readAxis(const OsimElement& element, const Vector3d& default_axis) {
  TransformAxisSpec axis;
  axis.axis = element.vector3("axis", default_axis);
  const double length = axis.axis.norm();
  if (!(length > kMinimumAxisLength)) {
    element.fail(ErrorCode::kModelValue, element.describe() + " has an axis without direction");
  }
  if (std::abs(length - 1.0) > 1e-12) {
    axis.axis /= length;
  }
  const std::vector<std::string> coordinates = element.words("coordinates");
  if (coordinates.size() > 1) {
    element.property("coordinates")
        .fail(ErrorCode::kModelUnsupported, "an axis driven by several coordinates cannot be read");
  }
  if (!coordinates.empty()) {
    axis.coordinate = coordinates.front();
  }
  const OsimElement function = findAxisFunction(element);
  if (function) {
    axis.function = readFunction(function, element);
  }
  // Without a function the axis contributes nothing, even if it lists a coordinate (verified in the
  // specification against OpenSim).
  if (axis.coordinate.empty() && axis.function.kind != FunctionSpec::Kind::kConstant) {
    element.fail(ErrorCode::kModelElement,
                 element.describe() + " has a function but no coordinate to evaluate it at");
  }
  return axis;
}

std::size_t findSlot(const OsimElement& axis) {
  const std::string name = axis.nameOr("");
  const auto slot = std::find(kSlotNames.begin(), kSlotNames.end(), name);
  if (slot == kSlotNames.end()) {
    axis.fail(ErrorCode::kModelElement,
              "a TransformAxis is named rotation1..3 or translation1..3, found '" + name + "'");
  }
  return static_cast<std::size_t>(slot - kSlotNames.begin());
}

void readSpatialTransform(const OsimElement& joint, JointSpec& spec) {
  for (std::size_t i = 0; i < spec.axes.size(); ++i) {
    spec.axes[i].axis = Vector3d::Unit(static_cast<Eigen::Index>(i % 3));
  }
  std::set<std::size_t> seen;
  for (const OsimElement& axis : joint.property("SpatialTransform").children()) {
    if (axis.type() != "TransformAxis") {
      continue;
    }
    const std::size_t slot = findSlot(axis);
    if (!seen.insert(slot).second) {
      axis.fail(ErrorCode::kModelDuplicateName, std::string("second axis ") + kSlotNames[slot]);
    }
    spec.axes[slot] = readAxis(axis, spec.axes[slot].axis);
    const std::string& driver = spec.axes[slot].coordinate;
    const bool known = std::any_of(spec.coordinates.begin(),
                                   spec.coordinates.end(),
                                   [&](const CoordinateSpec& c) { return c.name == driver; });
    if (!driver.empty() && !known) {
      axis.property("coordinates")
          .fail(ErrorCode::kModelReference,
                joint.describe() + " has no coordinate '" + driver + "'");
    }
  }
}

// Generalized coordinates are numbered by first appearance on the axes, whatever the document's
// order (spec/model.md 4.1).
void sortCoordinates(const OsimElement& joint, JointSpec& spec) {
  const auto firstSlot = [&](const CoordinateSpec& coordinate) {
    const auto found =
        std::find_if(spec.axes.begin(), spec.axes.end(), [&](const TransformAxisSpec& axis) {
          return axis.coordinate == coordinate.name;
        });
    return found - spec.axes.begin();
  };
  for (const CoordinateSpec& coordinate : spec.coordinates) {
    if (firstSlot(coordinate) == static_cast<std::ptrdiff_t>(spec.axes.size())) {
      joint.fail(ErrorCode::kModelElement,
                 "coordinate '" + coordinate.name + "' drives no axis of " + joint.describe());
    }
  }
  std::stable_sort(spec.coordinates.begin(),
                   spec.coordinates.end(),
                   [&](const CoordinateSpec& a, const CoordinateSpec& b) {
                     return firstSlot(a) < firstSlot(b);
                   });
}

// Documents below 30505 state the two offsets in the joint itself. OpenSim's own conversion rounds
// these numbers (and inertias) to six digits; the document's full precision is kept here, which
// moves points by less than 1e-6 m against a converted model.
void readOffsetsInJoint(const OsimJoint& joint, const OsimFrames& frames, JointSpec& spec) {
  const OsimElement& element = joint.element;
  const OsimElement parent = element.socket("parent_body", {"parent_body"});
  if (!parent) {
    element.fail(ErrorCode::kModelElement, element.describe() + " names no parent body or frame");
  }
  spec.parent = {frames.resolveBody(parent),
                 element.vector3("location_in_parent", Vector3d::Zero()),
                 element.vector3("orientation_in_parent", Vector3d::Zero())};
  std::string child = joint.enclosing_body;
  if (const OsimElement stated = element.socket("child_body", {"child_body"})) {
    child = frames.resolveBody(stated);
  }
  if (child.empty()) {
    element.fail(ErrorCode::kModelElement, element.describe() + " names no child body or frame");
  }
  spec.child = {child,
                element.vector3("location", Vector3d::Zero()),
                element.vector3("orientation", Vector3d::Zero())};
}

void readJointFrames(const OsimJoint& joint, const OsimFrames& frames, JointSpec& spec) {
  const OsimElement parent = joint.element.socket("parent_frame");
  const OsimElement child = joint.element.socket("child_frame");
  if (parent && child) {
    spec.parent = frames.resolve(parent, spec.name);
    spec.child = frames.resolve(child, spec.name);
  } else {
    readOffsetsInJoint(joint, frames, spec);
  }
  if (joint.element.boolean("reverse", false)) {
    std::swap(spec.parent, spec.child);
  }
  if (spec.child.body == "ground") {
    joint.element.fail(ErrorCode::kModelTopology, "ground cannot be the child of a joint");
  }
}

}  // namespace

std::vector<OsimJoint> collectJoints(const OsimElement& model) {
  std::vector<OsimJoint> joints;
  for (const OsimElement& element : model.objectsOf("JointSet")) {
    joints.push_back({element, ""});
  }
  for (const OsimElement& body : model.objectsOf("BodySet")) {
    for (const OsimElement& element : body.property("Joint").children()) {
      joints.push_back({element, body.requireName()});
    }
  }
  return joints;
}

FunctionSpec readFunction(const OsimElement& function, const OsimElement& context) {
  return readFunctionAt(function, context, 0);
}

std::vector<OsimElement> findIdleAxes(const OsimElement& joint) {
  std::vector<OsimElement> idle;
  for (const OsimElement& axis : joint.property("SpatialTransform").children()) {
    if (!axis.words("coordinates").empty() && !findAxisFunction(axis)) {
      idle.push_back(axis);
    }
  }
  return idle;
}

bool hasAngularSpeeds(const OsimElement& joint) {
  return joint.type() == "BallJoint" || joint.type() == "FreeJoint";
}

JointSpec readJoint(const OsimJoint& joint, const OsimFrames& frames) {
  const OsimElement& element = joint.element;
  const JointType& type = findJointType(element);
  JointSpec spec;
  spec.name = element.requireName();
  spec.kind = type.kind;
  spec.coordinates = readCoordinates(element);
  if (type.coordinate_count == kAnyCount) {
    readSpatialTransform(element, spec);
    sortCoordinates(element, spec);
  } else if (spec.coordinates.size() != type.coordinate_count) {
    element.fail(ErrorCode::kModelElement,
                 element.describe() + " has " + std::to_string(spec.coordinates.size()) +
                     " coordinates, expected " + std::to_string(type.coordinate_count));
  }
  for (std::size_t i = 0; type.coordinate_count == kFreeCount && i < kFreeCount; ++i) {
    spec.axes[i] = {spec.coordinates[i].name,
                    Vector3d::Unit(static_cast<Eigen::Index>(i % 3)),
                    {FunctionSpec::Kind::kLinear, {}, {1, 0}, 1}};
  }
  readJointFrames(joint, frames, spec);
  return spec;
}

void requireCoordinate(const OsimElement& reference,
                       const std::string& name,
                       const std::vector<JointSpec>& joints) {
  std::vector<std::string> names;
  for (const JointSpec& joint : joints) {
    for (const CoordinateSpec& coordinate : joint.coordinates) {
      if (coordinate.name == name) {
        return;
      }
      names.push_back(coordinate.name);
    }
  }
  const std::string nearest = findNearestName(name, names);
  reference.fail(ErrorCode::kModelReference,
                 "there is no coordinate '" + name + "'" +
                     (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
}

CouplerSpec readCoupler(const OsimElement& coupler, const std::vector<JointSpec>& joints) {
  CouplerSpec spec;
  spec.name = coupler.requireName();
  const std::vector<std::string> independent = coupler.words("independent_coordinate_names");
  if (independent.size() != 1) {
    coupler.fail(ErrorCode::kModelUnsupported,
                 coupler.describe() + " needs exactly one independent coordinate, found " +
                     std::to_string(independent.size()));
  }
  spec.independent = independent.front();
  spec.dependent = coupler.text("dependent_coordinate_name");
  requireCoordinate(coupler.property("independent_coordinate_names"), spec.independent, joints);
  const OsimElement dependent = coupler.property("dependent_coordinate_name");
  requireCoordinate(dependent ? dependent : coupler, spec.dependent, joints);
  spec.function =
      readFunction(coupler.objectProperty("coupled_coordinates_function",
                                          {"LinearFunction", "SimmSpline", "PolynomialFunction"}),
                   coupler);
  spec.scale = coupler.number("scale_factor", 1.0);
  spec.enforced = coupler.has("isEnforced") ? coupler.boolean("isEnforced", true)
                                            : !coupler.boolean("isDisabled", false);
  return spec;
}

void requireTree(const std::vector<OsimElement>& body_elements,
                 const std::vector<OsimJoint>& joint_elements,
                 const std::vector<JointSpec>& joints) {
  std::map<std::string, std::string> parent_of;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (!parent_of.emplace(joints[i].child.body, joints[i].parent.body).second) {
      joint_elements[i].element.fail(
          ErrorCode::kModelTopology,
          "body '" + joints[i].child.body + "' is already the child of another joint");
    }
  }
  for (const OsimElement& body : body_elements) {
    std::string at = body.requireName();
    for (std::size_t step = 0; at != "ground"; ++step) {
      const auto parent = parent_of.find(at);
      if (parent == parent_of.end() || step > parent_of.size()) {
        body.fail(ErrorCode::kModelTopology,
                  "no chain of joints leads from " + body.describe() + " to ground");
      }
      at = parent->second;
    }
  }
}

}  // namespace gaitmill
