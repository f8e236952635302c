#include "core/io/osim_writer.h"

#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/io/number_text.h"

namespace gaitmill {

namespace {

// ActuatorSpec's way to say "no limit"; the document says Inf.
constexpr double kNoLimit = 1e300;

constexpr std::array<const char*, 6> kSlotNames = {
    "rotation1", "rotation2", "rotation3", "translation1", "translation2", "translation3"};

/// Indented XML text.
class XmlText {
 public:
  XmlText() : text_("<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n") {}

  /// <tag> or <tag name="...">, to be closed with close().
  void open(const std::string& tag, const std::string& name = "") {
    indent();
    text_ += "<" + tag;
    if (!name.empty()) {
      text_ += " name=\"";
      appendEscaped(name);
      text_ += "\"";
    }
    text_ += ">\n";
    open_.push_back(tag);
  }
  void openDocument() {
    text_ += "<OpenSimDocument Version=\"40000\">\n";
    open_.emplace_back("OpenSimDocument");
  }
  void close() {
    const std::string tag = open_.back();
    open_.pop_back();
    indent();
    text_ += "</" + tag + ">\n";
  }
  void text(const char* tag, std::string_view value) {
    indent();
    text_ += std::string("<") + tag + ">";
    appendEscaped(value);
    text_ += std::string("</") + tag + ">\n";
  }
  void number(const char* tag, double value) { text(tag, formatNumber(value)); }
  void boolean(const char* tag, bool value) { text(tag, value ? "true" : "false"); }
  template <class Numbers>
  void numbers(const char* tag, const Numbers& values) {
    std::string line;
    for (const double value : values) {
      line += line.empty() ? "" : " ";
      appendNumber(line, value);
    }
    text(tag, line);
  }
  /// <Set name="..."><objects>, closed by closeSet().
  void openSet(const std::string& tag, const std::string& name) {
    open(tag, name);
    open("objects");
  }
  void closeSet() {
    close();
    indent();
    text_ += "<groups />\n";
    close();
  }
  std::string take() { return std::move(text_); }

 private:
  void indent() { text_.append(open_.size(), '\t'); }
  void appendEscaped(std::string_view value) {
    for (const char c : value) {
      switch (c) {
        case '&':
          text_ += "&amp;";
          break;
        case '<':
          text_ += "&lt;";
          break;
        case '>':
          text_ += "&gt;";
          break;
        case '"':
          text_ += "&quot;";
          break;
        default:
          text_ += c;
      }
    }
  }

  std::string text_;
  std::vector<std::string> open_;
};

std::string framePath(const std::string& body) {
  return body == "ground" ? "/ground" : "/bodyset/" + body;
}

/// "" for no coordinate.
std::string coordinatePath(const ModelSpec& spec, const std::string& coordinate) {
  const JointSpec* joint = spec.findJointOf(coordinate);
  return joint == nullptr ? coordinate : "/jointset/" + joint->name + "/" + coordinate;
}

double documentLimit(double limit) {
  return std::abs(limit) >= kNoLimit ? std::copysign(INFINITY, limit) : limit;
}

void writeWrapSize(XmlText& xml, const WrapObjectSpec& wrap) {
  switch (wrap.kind) {
    case WrapObjectSpec::Kind::kCylinder:
      xml.number("radius", wrap.radius);
      xml.number("length", wrap.length);
      break;
    case WrapObjectSpec::Kind::kSphere:
      xml.number("radius", wrap.radius);
      break;
    case WrapObjectSpec::Kind::kEllipsoid:
      xml.numbers("dimensions", wrap.semi_axes);
      break;
  }
}

const char* wrapType(WrapObjectSpec::Kind kind) {
  switch (kind) {
    case WrapObjectSpec::Kind::kCylinder:
      return "WrapCylinder";
    case WrapObjectSpec::Kind::kSphere:
      return "WrapSphere";
    case WrapObjectSpec::Kind::kEllipsoid:
      return "WrapEllipsoid";
  }
  return "WrapCylinder";
}

void writeWraps(XmlText& xml, const std::vector<WrapObjectSpec>& wraps) {
  xml.openSet("WrapObjectSet", "wrapobjectset");
  for (const WrapObjectSpec& wrap : wraps) {
    xml.open(wrapType(wrap.kind), wrap.name);
    xml.boolean("active", wrap.active);
    xml.numbers("xyz_body_rotation", wrap.rotation);
    xml.numbers("translation", wrap.translation);
    xml.text("quadrant", wrap.quadrant);
    writeWrapSize(xml, wrap);
    xml.close();
  }
  xml.closeSet();
}

bool isOnBody(const MeshSpec& mesh) {
  return mesh.translation.isZero(0) && mesh.orientation.isZero(0);
}

void writeMesh(XmlText& xml, const MeshSpec& mesh, const std::string& name) {
  xml.open("Mesh", name);
  xml.text("socket_frame", "..");
  xml.numbers("scale_factors", mesh.scale_factors);
  xml.text("mesh_file", mesh.file);
  xml.close();
}

// Meshes in a frame of their own hang on an offset frame that the body owns, as older documents'
// meshes do after conversion.
void writeMeshFrame(XmlText& xml, const MeshSpec& mesh, const std::string& name) {
  xml.open("PhysicalOffsetFrame", name);
  xml.open("attached_geometry");
  writeMesh(xml, mesh, name + "_geom");
  xml.close();
  xml.text("socket_parent", "..");
  xml.numbers("translation", mesh.translation);
  xml.numbers("orientation", mesh.orientation);
  xml.close();
}

void writeMeshes(XmlText& xml, const BodySpec& body) {
  const auto write = [&](const char* element, bool on_body, auto&& write_one) {
    bool open = false;
    for (std::size_t i = 0; i < body.meshes.size(); ++i) {
      if (isOnBody(body.meshes[i]) == on_body) {
        if (!open) {
          xml.open(element);
          open = true;
        }
        write_one(xml, body.meshes[i], std::to_string(i + 1));
      }
    }
    if (open) {
      xml.close();
    }
  };
  write("attached_geometry", true, [&](XmlText& out, const MeshSpec& mesh, const std::string& n) {
    writeMesh(out, mesh, body.name + "_geom_" + n);
  });
  write("components", false, [&](XmlText& out, const MeshSpec& mesh, const std::string& n) {
    writeMeshFrame(out, mesh, body.name + "_frame_" + n);
  });
}

void writeBodies(XmlText& xml, const ModelSpec& spec) {
  xml.openSet("BodySet", "bodyset");
  for (const BodySpec& body : spec.bodies) {
    xml.open("Body", body.name);
    writeMeshes(xml, body);
    writeWraps(xml, body.wrap_objects);
    xml.number("mass", body.mass);
    xml.numbers("mass_center", body.mass_center);
    xml.numbers("inertia", body.inertia);
    xml.close();
  }
  xml.closeSet();
}

const char* functionType(FunctionSpec::Kind kind) {
  switch (kind) {
    case FunctionSpec::Kind::kConstant:
      return "Constant";
    case FunctionSpec::Kind::kLinear:
      return "LinearFunction";
    case FunctionSpec::Kind::kPolynomial:
      return "PolynomialFunction";
    case FunctionSpec::Kind::kSimmSpline:
      return "SimmSpline";
    case FunctionSpec::Kind::kPiecewiseLinear:
      return "PiecewiseLinearFunction";
  }
  return "Constant";
}

/// The function without its scale. @param name  the property it is the value of, or ""
void writePlainFunction(XmlText& xml, const FunctionSpec& function, const std::string& name) {
  xml.open(functionType(function.kind), name);
  switch (function.kind) {
    case FunctionSpec::Kind::kConstant:
      xml.number("value", function.y.at(0));
      break;
    case FunctionSpec::Kind::kLinear:
    case FunctionSpec::Kind::kPolynomial:
      xml.numbers("coefficients", function.y);
      break;
    case FunctionSpec::Kind::kSimmSpline:
    case FunctionSpec::Kind::kPiecewiseLinear:
      xml.numbers("x", function.x);
      xml.numbers("y", function.y);
      break;
  }
  xml.close();
}

void writeFunction(XmlText& xml, const FunctionSpec& function, const std::string& name) {
  if (function.scale == 1.0) {
    writePlainFunction(xml, function, name);
    return;
  }
  xml.open("MultiplierFunction", name);
  xml.open("function");
  writePlainFunction(xml, function, "");
  xml.close();
  xml.number("scale", function.scale);
  xml.close();
}

const char* jointType(JointSpec::Kind kind) {
  switch (kind) {
    case JointSpec::Kind::kWeld:
      return "WeldJoint";
    case JointSpec::Kind::kPin:
      return "PinJoint";
    case JointSpec::Kind::kSlider:
      return "SliderJoint";
    case JointSpec::Kind::kUniversal:
      return "UniversalJoint";
    case JointSpec::Kind::kPlanar:
      return "PlanarJoint";
    case JointSpec::Kind::kGimbal:
      return "GimbalJoint";
    case JointSpec::Kind::kCustom:
      return "CustomJoint";
  }
  return "WeldJoint";
}

void writeCoordinates(XmlText& xml, const JointSpec& joint) {
  xml.open("coordinates");
  for (const CoordinateSpec& coordinate : joint.coordinates) {
    xml.open("Coordinate", coordinate.name);
    xml.number("default_value", coordinate.default_value);
    xml.number("default_speed_value", coordinate.default_speed);
    xml.numbers("range", std::array<double, 2>{coordinate.range_min, coordinate.range_max});
    xml.boolean("clamped", coordinate.clamped);
    xml.boolean("locked", coordinate.locked);
    xml.close();
  }
  xml.close();
}

void writeOffsetFrame(XmlText& xml, const FrameSpec& frame) {
  xml.open("PhysicalOffsetFrame", frame.body + "_offset");
  xml.text("socket_parent", framePath(frame.body));
  xml.numbers("translation", frame.translation);
  xml.numbers("orientation", frame.orientation);
  xml.close();
}

void writeSpatialTransform(XmlText& xml, const JointSpec& joint) {
  xml.open("SpatialTransform");
  for (std::size_t i = 0; i < joint.axes.size(); ++i) {
    xml.open("TransformAxis", kSlotNames[i]);
    xml.text("coordinates", joint.axes[i].coordinate);
    xml.numbers("axis", joint.axes[i].axis);
    writeFunction(xml, joint.axes[i].function, "function");
    xml.close();
  }
  xml.close();
}

void writeJoints(XmlText& xml, const ModelSpec& spec) {
  xml.openSet("JointSet", "jointset");
  for (const JointSpec& joint : spec.joints) {
    xml.open(jointType(joint.kind), joint.name);
    xml.text("socket_parent_frame", joint.parent.body + "_offset");
    xml.text("socket_child_frame", joint.child.body + "_offset");
    writeCoordinates(xml, joint);
    xml.open("frames");
    writeOffsetFrame(xml, joint.parent);
    writeOffsetFrame(xml, joint.child);
    xml.close();
    if (joint.kind == JointSpec::Kind::kCustom) {
      writeSpatialTransform(xml, joint);
    }
    xml.close();
  }
  xml.closeSet();
}

void writeCouplers(XmlText& xml, const ModelSpec& spec) {
  xml.openSet("ConstraintSet", "constraintset");
  for (const CouplerSpec& coupler : spec.couplers) {
    xml.open("CoordinateCouplerConstraint", coupler.name);
    xml.boolean("isEnforced", coupler.enforced);
    xml.open("coupled_coordinates_function");
    writeFunction(xml, coupler.function, "");
    xml.close();
    xml.text("independent_coordinate_names", coupler.independent);
    xml.text("dependent_coordinate_name", coupler.dependent);
    xml.number("scale_factor", coupler.scale);
    xml.close();
  }
  xml.closeSet();
}

void writeCondition(XmlText& xml, const ModelSpec& spec, const PathPointSpec& point) {
  xml.text("socket_coordinate", coordinatePath(spec, point.coordinate));
  xml.numbers("range", std::array<double, 2>{point.range_min, point.range_max});
}

void writeMotion(XmlText& xml, const ModelSpec& spec, const PathPointSpec& point) {
  constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
  for (const std::string axis : kAxes) {
    xml.text(("socket_" + axis + "_coordinate").c_str(), coordinatePath(spec, point.coordinate));
  }
  for (std::size_t i = 0; i < kAxes.size(); ++i) {
    xml.open(std::string(kAxes[i]) + "_location");
    writeFunction(xml, point.location_functions[i], "");
    xml.close();
  }
}

const char* pathPointType(PathPointSpec::Kind kind) {
  switch (kind) {
    case PathPointSpec::Kind::kFixed:
      return "PathPoint";
    case PathPointSpec::Kind::kConditional:
      return "ConditionalPathPoint";
    case PathPointSpec::Kind::kMoving:
      return "MovingPathPoint";
  }
  return "PathPoint";
}

void writePath(XmlText& xml, const ModelSpec& spec, const MuscleSpec& muscle) {
  xml.open("GeometryPath", "geometrypath");
  xml.openSet("PathPointSet", "");
  for (std::size_t i = 0; i < muscle.path.size(); ++i) {
    const PathPointSpec& point = muscle.path[i];
    xml.open(pathPointType(point.kind), muscle.name + "-P" + std::to_string(i + 1));
    xml.text("socket_parent_frame", framePath(point.body));
    if (point.kind == PathPointSpec::Kind::kMoving) {
      writeMotion(xml, spec, point);
    } else {
      xml.numbers("location", point.location);
    }
    if (point.kind == PathPointSpec::Kind::kConditional) {
      writeCondition(xml, spec, point);
    }
    xml.close();
  }
  xml.closeSet();
  xml.openSet("PathWrapSet", "");
  for (const PathWrapSpec& wrap : muscle.wraps) {
    xml.open("PathWrap", wrap.wrap_object + "_wrap");
    xml.text("wrap_object", wrap.wrap_object);
    xml.text("method", wrap.method);
    xml.text("range", std::to_string(wrap.first_point) + " " + std::to_string(wrap.last_point));
    xml.close();
  }
  xml.closeSet();
  xml.close();
}

void writeContractileCurves(XmlText& xml, const MuscleCurvesSpec& curves) {
  xml.open("ActiveForceLengthCurve");
  xml.number("min_norm_active_fiber_length", curves.active_min_length);
  xml.number("transition_norm_fiber_length", curves.active_transition_length);
  xml.number("max_norm_active_fiber_length", curves.active_max_length);
  xml.number("shallow_ascending_slope", curves.active_shallow_slope);
  xml.number("minimum_value", curves.active_minimum_value);
  xml.close();
  xml.open("ForceVelocityCurve");
  xml.number("concentric_slope_at_vmax", curves.concentric_slope_at_vmax);
  xml.number("concentric_slope_near_vmax", curves.concentric_slope_near_vmax);
  xml.number("isometric_slope", curves.isometric_slope);
  xml.number("eccentric_slope_at_vmax", curves.eccentric_slope_at_vmax);
  xml.number("eccentric_slope_near_vmax", curves.eccentric_slope_near_vmax);
  xml.number("max_eccentric_velocity_force_multiplier", curves.max_eccentric_force);
  xml.number("concentric_curviness", curves.concentric_curviness);
  xml.number("eccentric_curviness", curves.eccentric_curviness);
  xml.close();
}

// The last three properties of the elastic curves are optional: where all three are what a reader
// computes in their absence, they stay absent, so that changing a strain later changes them too.
void writeElasticCurves(XmlText& xml, const MuscleCurvesSpec& curves) {
  xml.open("FiberForceLengthCurve");
  xml.number("strain_at_zero_force", curves.passive_strain_at_zero_force);
  xml.number("strain_at_one_norm_force", curves.passive_strain_at_one_force);
  const double passive_stiffness =
      2.0 / (curves.passive_strain_at_one_force - curves.passive_strain_at_zero_force);
  if (curves.passive_stiffness_at_low_force != 0.2 ||
      curves.passive_stiffness_at_one_force != passive_stiffness ||
      curves.passive_curviness != 0.75) {
    xml.number("stiffness_at_low_force", curves.passive_stiffness_at_low_force);
    xml.number("stiffness_at_one_norm_force", curves.passive_stiffness_at_one_force);
    xml.number("curviness", curves.passive_curviness);
  }
  xml.close();
  xml.open("TendonForceLengthCurve");
  xml.number("strain_at_one_norm_force", curves.tendon_strain_at_one_force);
  if (curves.tendon_stiffness_at_one_force != 1.375 / curves.tendon_strain_at_one_force ||
      curves.tendon_force_at_toe_end != 2.0 / 3.0 || curves.tendon_curviness != 0.5) {
    xml.number("stiffness_at_one_norm_force", curves.tendon_stiffness_at_one_force);
    xml.number("norm_force_at_toe_end", curves.tendon_force_at_toe_end);
    xml.number("curviness", curves.tendon_curviness);
  }
  xml.close();
}

void writeThelenCurves(XmlText& xml, const ThelenCurvesSpec& curves) {
  xml.number("FmaxTendonStrain", curves.tendon_strain_at_one_force);
  xml.number("FmaxMuscleStrain", curves.passive_strain_at_one_force);
  xml.number("KshapeActive", curves.active_shape);
  xml.number("KshapePassive", curves.passive_shape);
  xml.number("Af", curves.velocity_shape);
  xml.number("Flen", curves.max_eccentric_force);
  xml.number("fv_linear_extrap_threshold", curves.linear_above_force);
}

// The maximum contraction velocity is the inverse of the time scale in which this class states its
// rates.
void writeSchutte(XmlText& xml, const MuscleSpec& muscle) {
  const double time_scale = 1 / muscle.max_contraction_velocity;
  xml.number("time_scale", time_scale);
  xml.number("activation1", muscle.schutte.excitation_rate * time_scale);
  xml.number("activation2", muscle.schutte.activation_rate * time_scale);
  xml.number("damping", muscle.fiber_damping);
  const auto write = [&xml](const char* tag, const std::optional<FunctionSpec>& curve) {
    if (curve) {
      xml.open(tag);
      writeFunction(xml, *curve, "");
      xml.close();
    }
  };
  write("active_force_length_curve", muscle.schutte.active_force_length);
  write("passive_force_length_curve", muscle.schutte.passive_force_length);
  write("tendon_force_length_curve", muscle.schutte.tendon_force_strain);
}

const char* muscleType(MuscleKind kind) {
  switch (kind) {
    case MuscleKind::kMillard2012:
      return "Millard2012EquilibriumMuscle";
    case MuscleKind::kThelen2003:
      return "Thelen2003Muscle";
    case MuscleKind::kSchutte1993:
      return "Schutte1993Muscle_Deprecated";
  }
  return "Millard2012EquilibriumMuscle";
}

void writeMuscle(XmlText& xml, const ModelSpec& spec, const MuscleSpec& muscle) {
  xml.open(muscleType(muscle.kind), muscle.name);
  xml.number("min_control", documentLimit(muscle.min_control));
  xml.number("max_control", documentLimit(muscle.max_control));
  writePath(xml, spec, muscle);
  xml.number("max_isometric_force", muscle.max_isometric_force);
  xml.number("optimal_fiber_length", muscle.optimal_fiber_length);
  xml.number("tendon_slack_length", muscle.tendon_slack_length);
  xml.number("pennation_angle_at_optimal", muscle.pennation_at_optimal);
  xml.number("max_contraction_velocity", muscle.max_contraction_velocity);
  if (muscle.kind == MuscleKind::kMillard2012) {
    xml.boolean("ignore_tendon_compliance", muscle.tendon == TendonKind::kRigid);
    xml.number("fiber_damping", muscle.fiber_damping);
  }
  xml.number("default_activation", muscle.default_activation);
  xml.number("default_fiber_length", muscle.default_fiber_length);
  if (muscle.kind != MuscleKind::kSchutte1993) {
    xml.number("activation_time_constant", muscle.activation_time_constant);
    xml.number("deactivation_time_constant", muscle.deactivation_time_constant);
    xml.number("minimum_activation", muscle.minimum_activation);
  }
  xml.number("maximum_pennation_angle", muscle.maximum_pennation);
  switch (muscle.kind) {
    case MuscleKind::kMillard2012:
      writeContractileCurves(xml, muscle.curves);
      writeElasticCurves(xml, muscle.curves);
      break;
    case MuscleKind::kThelen2003:
      writeThelenCurves(xml, muscle.thelen);
      break;
    case MuscleKind::kSchutte1993:
      writeSchutte(xml, muscle);
      break;
  }
  xml.close();
}

const char* actuatorType(ActuatorSpec::Kind kind) {
  switch (kind) {
    case ActuatorSpec::Kind::kCoordinate:
      return "CoordinateActuator";
    case ActuatorSpec::Kind::kPoint:
      return "PointActuator";
    case ActuatorSpec::Kind::kTorque:
      return "TorqueActuator";
  }
  return "CoordinateActuator";
}

void writeActuator(XmlText& xml, const ActuatorSpec& actuator) {
  xml.open(actuatorType(actuator.kind), actuator.name);
  xml.number("min_control", documentLimit(actuator.min_control));
  xml.number("max_control", documentLimit(actuator.max_control));
  switch (actuator.kind) {
    case ActuatorSpec::Kind::kCoordinate:
      xml.text("coordinate", actuator.coordinate);
      break;
    case ActuatorSpec::Kind::kPoint:
      xml.text("body", actuator.body);
      xml.numbers("point", actuator.point);
      xml.boolean("point_is_global", false);
      xml.numbers("direction", actuator.direction);
      xml.boolean("force_is_global", actuator.direction_in_ground);
      break;
    case ActuatorSpec::Kind::kTorque:
      xml.text("bodyA", actuator.body);
      xml.text("bodyB", actuator.reaction_body);
      xml.boolean("torque_is_global", actuator.direction_in_ground);
      xml.numbers("axis", actuator.direction);
      break;
  }
  xml.number("optimal_force", actuator.optimal_force);
  xml.close();
}

void writeLimits(XmlText& xml, const PassiveForceSpec& force, bool rotational) {
  const double unit = rotational ? kRadiansPerDegree : 1.0;
  xml.number("upper_stiffness", force.upper_stiffness * unit);
  xml.number("upper_limit", force.upper_limit / unit);
  xml.number("lower_stiffness", force.lower_stiffness * unit);
  xml.number("lower_limit", force.lower_limit / unit);
  xml.number("damping", force.damping * unit);
  xml.number("transition", force.transition / unit);
}

void writeBushingFrame(XmlText& xml, const FrameSpec& frame, const char* name) {
  xml.open("PhysicalOffsetFrame", name);
  xml.text("socket_parent", framePath(frame.body));
  xml.numbers("translation", frame.translation);
  xml.numbers("orientation", frame.orientation);
  xml.close();
}

void writeBushing(XmlText& xml, const PassiveForceSpec& force) {
  using Kind = PassiveForceSpec::Kind;
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
  xml.text("socket_frame1", "frame1_offset");
  xml.text("socket_frame2", "frame2_offset");
  xml.open("frames");
  writeBushingFrame(xml, force.frame1, "frame1_offset");
  writeBushingFrame(xml, force.frame2, "frame2_offset");
  xml.close();
  if (force.kind == Kind::kBushing) {
    xml.numbers("rotational_stiffness", force.rotational_stiffness);
    xml.numbers("translational_stiffness", force.translational_stiffness);
  }
  for (std::size_t i = 0; i < 6; ++i) {
    if (force.kind == Kind::kFunctionBushing) {
      writeFunction(xml, force.functions[i], kFunctions[i]);
    } else if (force.kind == Kind::kExpressionBushing) {
      xml.text(kExpressions[i], force.expressions[i]);
    }
  }
  xml.numbers("rotational_damping", force.rotational_damping);
  xml.numbers("translational_damping", force.translational_damping);
}

void writePassiveForce(XmlText& xml, const ModelSpec& spec, const PassiveForceSpec& force) {
  using Kind = PassiveForceSpec::Kind;
  switch (force.kind) {
    case Kind::kCoordinateLimit:
      xml.open("CoordinateLimitForce", force.name);
      xml.text("coordinate", force.coordinate);
      writeLimits(xml, force, findMotionKind(spec, force.coordinate) == MotionKind::kRotational);
      break;
    case Kind::kCoordinateSpring:
      xml.open("SpringGeneralizedForce", force.name);
      xml.text("coordinate", force.coordinate);
      xml.number("stiffness", force.stiffness);
      xml.number("rest_length", force.rest_length);
      xml.number("viscosity", force.viscosity);
      break;
    case Kind::kCoordinateExpression:
      xml.open("ExpressionBasedCoordinateForce", force.name);
      xml.text("coordinate", force.coordinate);
      xml.text("expression", force.expressions[0]);
      break;
    case Kind::kBushing:
      xml.open("BushingForce", force.name);
      writeBushing(xml, force);
      break;
    case Kind::kFunctionBushing:
      xml.open("FunctionBasedBushingForce", force.name);
      writeBushing(xml, force);
      break;
    case Kind::kExpressionBushing:
      xml.open("ExpressionBasedBushingForce", force.name);
      writeBushing(xml, force);
      break;
  }
  xml.close();
}

void writeGroups(XmlText& xml, const ModelSpec& spec) {
  xml.open("groups");
  for (const MuscleGroupSpec& group : spec.muscle_groups) {
    std::string members;
    for (const std::string& member : group.members) {
      members += (members.empty() ? "" : " ") + member;
    }
    xml.open("ObjectGroup", group.name);
    xml.text("members", members);
    xml.close();
  }
  xml.close();
}

void writeForces(XmlText& xml, const ModelSpec& spec) {
  xml.open("ForceSet", "forceset");
  xml.open("objects");
  for (const MuscleSpec& muscle : spec.muscles) {
    writeMuscle(xml, spec, muscle);
  }
  for (const ActuatorSpec& actuator : spec.actuators) {
    writeActuator(xml, actuator);
  }
  for (const PassiveForceSpec& force : spec.passive_forces) {
    writePassiveForce(xml, spec, force);
  }
  xml.close();
  writeGroups(xml, spec);
  xml.close();
}

void writeMarkers(XmlText& xml, const ModelSpec& spec) {
  xml.openSet("MarkerSet", "markerset");
  for (const MarkerSpec& marker : spec.markers) {
    xml.open("Marker", marker.name);
    xml.text("socket_parent_frame", framePath(marker.body));
    xml.numbers("location", marker.location);
    xml.boolean("fixed", marker.fixed);
    xml.close();
  }
  xml.closeSet();
}

}  // namespace

std::string writeOsim(const ModelSpec& spec) {
  XmlText xml;
  xml.openDocument();
  xml.open("Model", spec.name);
  xml.open("Ground", "ground");
  writeWraps(xml, spec.ground_wrap_objects);
  xml.close();
  xml.numbers("gravity", spec.gravity);
  xml.text("credits", spec.credits);
  xml.text("length_units", "meters");
  xml.text("force_units", "N");
  writeBodies(xml, spec);
  writeJoints(xml, spec);
  writeCouplers(xml, spec);
  writeForces(xml, spec);
  writeMarkers(xml, spec);
  xml.close();
  xml.close();
  return xml.take();
}

}  // namespace gaitmill
