#include "core/io/osim_passive_forces.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "core/base/units.h"
#include "core/data/expression.h"
#include "core/io/osim_joints.h"

namespace gaitmill {

namespace {

using Kind = PassiveForceSpec::Kind;
using Vector3d = Eigen::Vector3d;

struct PassiveType {
  std::string_view name;
  Kind kind;
};
constexpr std::array<PassiveType, 6> kTypes = {{
    {"CoordinateLimitForce", Kind::kCoordinateLimit},
    {"SpringGeneralizedForce", Kind::kCoordinateSpring},
    {"ExpressionBasedCoordinateForce", Kind::kCoordinateExpression},
    {"BushingForce", Kind::kBushing},
    {"FunctionBasedBushingForce", Kind::kFunctionBushing},
    {"ExpressionBasedBushingForce", Kind::kExpressionBushing},
}};

const PassiveType* findType(const OsimElement& force) {
  const auto* found = std::find_if(kTypes.begin(), kTypes.end(), [&](const PassiveType& type) {
    return type.name == force.type();
  });
  return found == kTypes.end() ? nullptr : found;
}

/// Degrees, and units per degree, of rotational coordinates. Class defaults: those of OpenSim.
void readLimits(const OsimElement& force, bool rotational, PassiveForceSpec& spec) {
  const double unit = rotational ? kRadiansPerDegree : 1.0;
  spec.upper_limit = unit * force.number("upper_limit", 0);
  spec.lower_limit = unit * force.number("lower_limit", 0);
  spec.upper_stiffness = force.number("upper_stiffness", 1) / unit;
  spec.lower_stiffness = force.number("lower_stiffness", 1) / unit;
  spec.damping = force.number("damping", 0.001) / unit;
  spec.transition = unit * force.number("transition", 0.1);
  if (!(spec.transition > 0)) {
    force.fail(ErrorCode::kModelValue,
               force.describe() + " needs a <transition> above 0, over which it sets in");
  }
}

void requireExpression(const OsimElement& place,
                       const std::string& text,
                       const std::vector<std::string>& variables) {
  try {
    static_cast<void>(Expression(text, variables));
  } catch (const Error& error) {
    place.fail(error.code(), error.message());
  }
}

void readOnCoordinate(const OsimElement& force,
                      const std::vector<JointSpec>& joints,
                      PassiveForceSpec& spec) {
  const OsimElement coordinate = force.property("coordinate");
  spec.coordinate = lastComponent(force.text("coordinate"));
  requireCoordinate(coordinate ? coordinate : force, spec.coordinate, joints);
  if (spec.kind == Kind::kCoordinateLimit) {
    const auto joint = std::find_if(joints.begin(), joints.end(), [&](const JointSpec& candidate) {
      return std::any_of(candidate.coordinates.begin(),
                         candidate.coordinates.end(),
                         [&](const CoordinateSpec& c) { return c.name == spec.coordinate; });
    });
    readLimits(force, findMotionKind(*joint, spec.coordinate) == MotionKind::kRotational, spec);
  } else if (spec.kind == Kind::kCoordinateSpring) {
    spec.stiffness = force.number("stiffness", 0);
    spec.rest_length = force.number("rest_length", 0);
    spec.viscosity = force.number("viscosity", 0);
  } else {
    spec.expressions[0] = force.text("expression", "0");
    const OsimElement place = force.property("expression");
    requireExpression(place ? place : force, spec.expressions[0], {"q", "qdot"});
  }
}

/// A socket of documents from 30503 on; before, a body with location and orientation.
FrameSpec readFrame(const OsimElement& force, const OsimFrames& frames, const std::string& number) {
  const std::string name = force.requireName();
  if (const OsimElement socket = force.socket(("frame" + number).c_str())) {
    return frames.resolve(socket, name);
  }
  const OsimElement body = force.property(("body_" + number).c_str());
  if (!body) {
    force.fail(ErrorCode::kModelElement, force.describe() + " names no frame " + number);
  }
  return {frames.resolveBody(body),
          force.vector3(("location_body_" + number).c_str(), Vector3d::Zero()),
          force.vector3(("orientation_body_" + number).c_str(), Vector3d::Zero())};
}

void readBushing(const OsimElement& force, OsimFrames& frames, PassiveForceSpec& spec) {
  frames.addOffsetFrames(spec.name, force.property("frames").children());
  spec.frame1 = readFrame(force, frames, "1");
  spec.frame2 = readFrame(force, frames, "2");
  spec.rotational_damping = force.vector3("rotational_damping", Vector3d::Zero());
  spec.translational_damping = force.vector3("translational_damping", Vector3d::Zero());
  if (spec.kind == Kind::kBushing) {
    spec.rotational_stiffness = force.vector3("rotational_stiffness", Vector3d::Zero());
    spec.translational_stiffness = force.vector3("translational_stiffness", Vector3d::Zero());
  }
  constexpr std::array<const char*, 6> kFunctions = {"m_x_theta_x_function",
                                                     "m_y_theta_y_function",
                                                     "m_z_theta_z_function",
                                                     "f_x_delta_x_function",
                                                     "f_y_delta_y_function",
                                                     "f_z_delta_z_function"};
  constexpr std::array<const char*, 6> kExpressions = {"Mx_expression",
                                                       "My_expression",
                                                       "Mz_expression",
                                                       "Fx_expression",
                                                       "Fy_expression",
                                                       "Fz_expression"};
  for (std::size_t i = 0; i < 6; ++i) {
    if (spec.kind == Kind::kFunctionBushing) {
      if (const OsimElement function = force.objectProperty(kFunctions[i], {})) {
        spec.functions[i] = readFunction(function, force);
      }
    } else if (spec.kind == Kind::kExpressionBushing) {
      spec.expressions[i] = force.text(kExpressions[i], "0");
      const OsimElement place = force.property(kExpressions[i]);
      requireExpression(place ? place : force,
                        spec.expressions[i],
                        {"theta_x", "theta_y", "theta_z", "delta_x", "delta_y", "delta_z"});
    }
  }
}

}  // namespace

bool isPassiveForce(const OsimElement& force) {
  return findType(force) != nullptr;
}

PassiveForceSpec readPassiveForce(const OsimElement& force,
                                  OsimFrames& frames,
                                  const std::vector<JointSpec>& joints) {
  PassiveForceSpec spec;
  spec.name = force.requireName();
  spec.kind = findType(force)->kind;
  if (spec.kind == Kind::kCoordinateLimit || spec.kind == Kind::kCoordinateSpring ||
      spec.kind == Kind::kCoordinateExpression) {
    readOnCoordinate(force, joints, spec);
  } else {
    readBushing(force, frames, spec);
  }
  return spec;
}

}  // namespace gaitmill
