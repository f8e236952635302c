#include "core/io/osim_writer.h"

#include <algorithm>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "tests/support/shared_data.h"

namespace gaitmill {
namespace {

// Comparison of every field. The structured bindings name all members, so that a field added to a
// struct does not compile here until it is compared.

bool same(const FunctionSpec& a, const FunctionSpec& b) {
  const auto& [kind, x, y, scale] = a;
  return kind == b.kind && x == b.x && y == b.y && scale == b.scale;
}

bool same(const WrapObjectSpec& a, const WrapObjectSpec& b) {
  const auto& [name, kind, rotation, translation, quadrant, radius, length, semi_axes, active] = a;
  return name == b.name && kind == b.kind && rotation == b.rotation &&
         translation == b.translation && quadrant == b.quadrant && radius == b.radius &&
         length == b.length && semi_axes == b.semi_axes && active == b.active;
}

bool same(const MeshSpec& a, const MeshSpec& b) {
  const auto& [file, scale_factors, translation, orientation] = a;
  return file == b.file && scale_factors == b.scale_factors && translation == b.translation &&
         orientation == b.orientation;
}

bool same(const FrameSpec& a, const FrameSpec& b) {
  const auto& [body, translation, orientation] = a;
  return body == b.body && translation == b.translation && orientation == b.orientation;
}

bool same(const CoordinateSpec& a, const CoordinateSpec& b) {
  const auto& [name, value, speed, minimum, maximum, clamped, locked] = a;
  return name == b.name && value == b.default_value && speed == b.default_speed &&
         minimum == b.range_min && maximum == b.range_max && clamped == b.clamped &&
         locked == b.locked;
}

bool same(const TransformAxisSpec& a, const TransformAxisSpec& b) {
  const auto& [coordinate, axis, function] = a;
  return coordinate == b.coordinate && axis == b.axis && same(function, b.function);
}

bool same(const PathPointSpec& a, const PathPointSpec& b) {
  const auto& [body, location, kind, coordinate, low, high, functions] = a;
  return body == b.body && location == b.location && kind == b.kind && coordinate == b.coordinate &&
         low == b.range_min && high == b.range_max &&
         std::equal(functions.begin(),
                    functions.end(),
                    b.location_functions.begin(),
                    [](const FunctionSpec& f, const FunctionSpec& g) { return same(f, g); });
}

bool same(const PathWrapSpec& a, const PathWrapSpec& b) {
  const auto& [object, first, last, method] = a;
  return object == b.wrap_object && first == b.first_point && last == b.last_point &&
         method == b.method;
}

bool same(const PassiveForceSpec& a, const PassiveForceSpec& b) {
  const auto& [name,
               kind,
               coordinate,
               upper_limit,
               lower_limit,
               upper_stiffness,
               lower_stiffness,
               damping,
               transition,
               stiffness,
               rest_length,
               viscosity,
               frame1,
               frame2,
               rotational_stiffness,
               translational_stiffness,
               rotational_damping,
               translational_damping,
               functions,
               expressions] = a;
  bool equal = name == b.name && kind == b.kind && coordinate == b.coordinate &&
               upper_limit == b.upper_limit && lower_limit == b.lower_limit &&
               upper_stiffness == b.upper_stiffness && lower_stiffness == b.lower_stiffness &&
               damping == b.damping && transition == b.transition && stiffness == b.stiffness &&
               rest_length == b.rest_length && viscosity == b.viscosity && same(frame1, b.frame1) &&
               same(frame2, b.frame2) && rotational_stiffness == b.rotational_stiffness &&
               translational_stiffness == b.translational_stiffness &&
               rotational_damping == b.rotational_damping &&
               translational_damping == b.translational_damping && expressions == b.expressions;
  for (std::size_t i = 0; i < functions.size(); ++i) {
    equal = equal && same(functions[i], b.functions[i]);
  }
  return equal;
}

template <class List>
void expectSameList(const List& a, const List& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_TRUE(same(a[i], b[i])) << "element " << i;
  }
}

void expectSame(const BodySpec& a, const BodySpec& b) {
  const auto& [name, mass, mass_center, inertia, wraps, meshes] = a;
  EXPECT_EQ(name, b.name);
  EXPECT_EQ(mass, b.mass);
  EXPECT_EQ(mass_center, b.mass_center);
  EXPECT_EQ(inertia, b.inertia);
  expectSameList(wraps, b.wrap_objects);
  expectSameList(meshes, b.meshes);
}

void expectSame(const JointSpec& a, const JointSpec& b) {
  const auto& [name, kind, parent, child, coordinates, axes] = a;
  EXPECT_EQ(name, b.name);
  EXPECT_EQ(kind, b.kind);
  EXPECT_TRUE(same(parent, b.parent));
  EXPECT_TRUE(same(child, b.child));
  expectSameList(coordinates, b.coordinates);
  expectSameList(axes, b.axes);
}

void expectSame(const CouplerSpec& a, const CouplerSpec& b) {
  const auto& [name, independent, dependent, function, scale, enforced] = a;
  EXPECT_EQ(name, b.name);
  EXPECT_EQ(independent, b.independent);
  EXPECT_EQ(dependent, b.dependent);
  EXPECT_TRUE(same(function, b.function));
  EXPECT_EQ(scale, b.scale);
  EXPECT_EQ(enforced, b.enforced);
}

void expectSame(const MarkerSpec& a, const MarkerSpec& b) {
  const auto& [name, body, location, fixed] = a;
  EXPECT_EQ(name, b.name);
  EXPECT_EQ(body, b.body);
  EXPECT_EQ(location, b.location);
  EXPECT_EQ(fixed, b.fixed);
}

void expectSame(const MuscleCurvesSpec& a, const MuscleCurvesSpec& b) {
  const auto& [amin,
               atrans,
               amax,
               aslope,
               avalue,
               c0,
               c1,
               iso,
               e0,
               e1,
               emax,
               cc,
               ec,
               p0,
               p1,
               plow,
               pone,
               pcurve,
               tstrain,
               tone,
               ttoe,
               tcurve] = a;
  EXPECT_EQ(amin, b.active_min_length);
  EXPECT_EQ(atrans, b.active_transition_length);
  EXPECT_EQ(amax, b.active_max_length);
  EXPECT_EQ(aslope, b.active_shallow_slope);
  EXPECT_EQ(avalue, b.active_minimum_value);
  EXPECT_EQ(c0, b.concentric_slope_at_vmax);
  EXPECT_EQ(c1, b.concentric_slope_near_vmax);
  EXPECT_EQ(iso, b.isometric_slope);
  EXPECT_EQ(e0, b.eccentric_slope_at_vmax);
  EXPECT_EQ(e1, b.eccentric_slope_near_vmax);
  EXPECT_EQ(emax, b.max_eccentric_force);
  EXPECT_EQ(cc, b.concentric_curviness);
  EXPECT_EQ(ec, b.eccentric_curviness);
  EXPECT_EQ(p0, b.passive_strain_at_zero_force);
  EXPECT_EQ(p1, b.passive_strain_at_one_force);
  EXPECT_EQ(plow, b.passive_stiffness_at_low_force);
  EXPECT_EQ(pone, b.passive_stiffness_at_one_force);
  EXPECT_EQ(pcurve, b.passive_curviness);
  EXPECT_EQ(tstrain, b.tendon_strain_at_one_force);
  EXPECT_EQ(tone, b.tendon_stiffness_at_one_force);
  EXPECT_EQ(ttoe, b.tendon_force_at_toe_end);
  EXPECT_EQ(tcurve, b.tendon_curviness);
}

void expectSame(const ThelenCurvesSpec& a, const ThelenCurvesSpec& b) {
  const auto& [tendon, passive_strain, gamma, k_passive, af, flen, linear] = a;
  EXPECT_EQ(tendon, b.tendon_strain_at_one_force);
  EXPECT_EQ(passive_strain, b.passive_strain_at_one_force);
  EXPECT_EQ(gamma, b.active_shape);
  EXPECT_EQ(k_passive, b.passive_shape);
  EXPECT_EQ(af, b.velocity_shape);
  EXPECT_EQ(flen, b.max_eccentric_force);
  EXPECT_EQ(linear, b.linear_above_force);
}

void expectSame(const std::optional<FunctionSpec>& a, const std::optional<FunctionSpec>& b) {
  EXPECT_EQ(a.has_value(), b.has_value());
  EXPECT_TRUE(!a || !b || same(*a, *b));
}

// The document states rates in units of its time scale, which costs them their last digit.
void expectSame(const SchutteCurvesSpec& a, const SchutteCurvesSpec& b) {
  const auto& [excitation_rate, activation_rate, active, passive, tendon] = a;
  EXPECT_DOUBLE_EQ(excitation_rate, b.excitation_rate);
  EXPECT_DOUBLE_EQ(activation_rate, b.activation_rate);
  expectSame(active, b.active_force_length);
  expectSame(passive, b.passive_force_length);
  expectSame(tendon, b.tendon_force_strain);
}

void expectSame(const MuscleSpec& a, const MuscleSpec& b) {
  const auto& [name,
               force,
               fiber,
               slack,
               pennation,
               vmax,
               damping,
               rise,
               fall,
               amin,
               adefault,
               fdefault,
               pmax,
               cmin,
               cmax,
               tendon,
               curves,
               path,
               wraps,
               kind,
               thelen,
               schutte] = a;
  EXPECT_EQ(name, b.name);
  EXPECT_EQ(force, b.max_isometric_force);
  EXPECT_EQ(fiber, b.optimal_fiber_length);
  EXPECT_EQ(slack, b.tendon_slack_length);
  EXPECT_EQ(pennation, b.pennation_at_optimal);
  EXPECT_EQ(vmax, b.max_contraction_velocity);
  EXPECT_EQ(damping, b.fiber_damping);
  EXPECT_EQ(rise, b.activation_time_constant);
  EXPECT_EQ(fall, b.deactivation_time_constant);
  EXPECT_EQ(amin, b.minimum_activation);
  EXPECT_EQ(adefault, b.default_activation);
  EXPECT_EQ(fdefault, b.default_fiber_length);
  EXPECT_EQ(pmax, b.maximum_pennation);
  EXPECT_EQ(cmin, b.min_control);
  EXPECT_EQ(cmax, b.max_control);
  EXPECT_EQ(tendon, b.tendon);
  expectSame(curves, b.curves);
  expectSameList(path, b.path);
  expectSameList(wraps, b.wraps);
  EXPECT_EQ(kind, b.kind);
  expectSame(thelen, b.thelen);
  expectSame(schutte, b.schutte);
}

void expectSame(const ActuatorSpec& a, const ActuatorSpec& b) {
  const auto& [name,
               kind,
               coordinate,
               body,
               reaction,
               point,
               direction,
               in_ground,
               optimal,
               cmin,
               cmax] = a;
  EXPECT_EQ(name, b.name);
  EXPECT_EQ(kind, b.kind);
  EXPECT_EQ(coordinate, b.coordinate);
  EXPECT_EQ(body, b.body);
  EXPECT_EQ(reaction, b.reaction_body);
  EXPECT_EQ(point, b.point);
  EXPECT_EQ(direction, b.direction);
  EXPECT_EQ(in_ground, b.direction_in_ground);
  EXPECT_EQ(optimal, b.optimal_force);
  EXPECT_EQ(cmin, b.min_control);
  EXPECT_EQ(cmax, b.max_control);
}

void expectSame(const MuscleGroupSpec& a, const MuscleGroupSpec& b) {
  const auto& [name, members] = a;
  EXPECT_EQ(name, b.name);
  EXPECT_EQ(members, b.members);
}

template <class List>
void expectSameAll(const List& a, const List& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    expectSame(a[i], b[i]);
  }
}

void expectSame(const ModelSpec& a, const ModelSpec& b) {
  const auto& [name,
               credits,
               gravity,
               bodies,
               ground_wraps,
               joints,
               couplers,
               markers,
               muscles,
               actuators,
               passive_forces,
               groups,
               document_version] = a;
  EXPECT_EQ(name, b.name);
  EXPECT_EQ(credits, b.credits);
  EXPECT_EQ(gravity, b.gravity);
  expectSameAll(bodies, b.bodies);
  expectSameList(ground_wraps, b.ground_wrap_objects);
  expectSameAll(joints, b.joints);
  expectSameAll(couplers, b.couplers);
  expectSameAll(markers, b.markers);
  expectSameAll(muscles, b.muscles);
  expectSameAll(actuators, b.actuators);
  expectSameList(passive_forces, b.passive_forces);
  expectSameAll(groups, b.muscle_groups);
  EXPECT_EQ(document_version, 40000);  // that of what is written
  EXPECT_GE(b.document_version, 20302);
}

void addPassiveForces(ModelSpec& spec) {
  using Kind = PassiveForceSpec::Kind;
  PassiveForceSpec limit;
  limit.name = "limit";
  limit.coordinate = "slider_q0";  // metres: degrees would cost the last digit
  limit.upper_limit = 0.2;
  limit.lower_limit = -1.0 / 3.0;
  limit.upper_stiffness = 1e5;
  limit.lower_stiffness = 2e5;
  limit.damping = 30;
  limit.transition = 0.01;
  PassiveForceSpec spring;
  spring.name = "spring";
  spring.kind = Kind::kCoordinateSpring;
  spring.coordinate = "pin_q0";
  spring.stiffness = 3;
  spring.rest_length = 0.1;
  spring.viscosity = 0.2;
  PassiveForceSpec formula;
  formula.name = "formula";
  formula.kind = Kind::kCoordinateExpression;
  formula.coordinate = "pin_q0";
  formula.expressions[0] = "min(q, 0) * exp(-qdot)";
  PassiveForceSpec bushing;
  bushing.name = "bushing";
  bushing.kind = Kind::kBushing;
  bushing.frame1 = {"ground", {0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}};
  bushing.frame2 = {"body_pin", {0, 0, 1.0 / 3.0}, {0, 0, 0}};
  bushing.rotational_stiffness = {1, 2, 3};
  bushing.translational_stiffness = {4, 5, 6};
  bushing.rotational_damping = {7, 8, 9};
  bushing.translational_damping = {10, 11, 12};
  PassiveForceSpec functions = bushing;
  functions.name = "functions";
  functions.kind = Kind::kFunctionBushing;
  functions.rotational_stiffness.setZero();
  functions.translational_stiffness.setZero();
  functions.functions[1] = {FunctionSpec::Kind::kLinear, {}, {5, 0}, 2};
  functions.functions[4] = {FunctionSpec::Kind::kSimmSpline, {0, 1, 2}, {3, 4, 1}, 1};
  PassiveForceSpec expressions = functions;
  expressions.name = "expressions";
  expressions.kind = Kind::kExpressionBushing;
  expressions.functions = {};
  expressions.expressions = {"theta_x", "2*theta_y", "0", "delta_x^3", "delta_y*theta_z", "0"};
  spec.passive_forces = {limit, spring, formula, bushing, functions, expressions};
}

/// A model with one of everything the values can say, all of it away from the defaults.
JointSpec makeJoint(JointSpec::Kind kind, const std::string& name, std::size_t coordinates) {
  JointSpec joint;
  joint.name = name;
  joint.kind = kind;
  joint.parent = {"ground", {0.1, 1.0 / 3.0, -1e-17}, {1e-300, 0.2, -0.3}};
  joint.child = {"body_" + name, {4, 5, 6}, {0.7, 0.8, 0.9}};
  for (std::size_t i = 0; i < coordinates; ++i) {
    joint.coordinates.push_back(
        {name + "_q" + std::to_string(i), 0.1, 0.2, -1.5, 2.5, i == 0, i == 1});
  }
  return joint;
}

void addCustomJoint(ModelSpec& spec) {
  JointSpec joint = makeJoint(JointSpec::Kind::kCustom, "custom", 5);
  using Kind = FunctionSpec::Kind;
  const FunctionSpec functions[6] = {{Kind::kLinear, {}, {-1, 0.5}, 1},
                                     {Kind::kSimmSpline, {0, 0.1, 3}, {1, 2, 1e-9}, 0.958},
                                     {Kind::kPolynomial, {}, {1, 2, 3, 4}, 1.1},
                                     {Kind::kPiecewiseLinear, {-1, 1}, {2, 3}, 1},
                                     {Kind::kConstant, {}, {0.00275}, 1.2446319356391389},
                                     {Kind::kLinear, {}, {1, 0}, 2}};
  const std::string prefix = joint.name + "_q";
  const std::string drivers[6] = {
      prefix + "0", prefix + "1", prefix + "2", prefix + "3", "", prefix + "4"};
  for (std::size_t i = 0; i < 6; ++i) {
    joint.axes[i] = {
        drivers[i], Eigen::Vector3d::Unit(static_cast<int>((i + 1) % 3)), functions[i]};
  }
  joint.axes[0].axis = Eigen::Vector3d(1, 2, -2) / 3;
  spec.joints.push_back(joint);
}

MuscleSpec makeMuscle(const std::string& name) {
  MuscleSpec muscle;
  muscle.name = name;
  muscle.max_isometric_force = 1000.0 / 3.0;
  muscle.optimal_fiber_length = 0.07;
  muscle.tendon_slack_length = 0.3;
  muscle.pennation_at_optimal = 0.2;
  muscle.max_contraction_velocity = 15;
  muscle.fiber_damping = 0.01;
  muscle.activation_time_constant = 0.011;
  muscle.deactivation_time_constant = 0.044;
  muscle.minimum_activation = 0.02;
  muscle.default_activation = 0.03;
  muscle.default_fiber_length = 0.09;
  muscle.maximum_pennation = 1.3;
  muscle.min_control = 0.021;
  muscle.max_control = 0.99;
  muscle.tendon = TendonKind::kRigid;
  muscle.path = {{"ground", {1, 2, 3}}, {"body_weld", {0.1, 0.2, 0.3}}, {"body_pin", {0, 0, 1e-5}}};
  muscle.wraps = {{"wrap_a", -1, -1}, {"wrap_g", 2, 3}};
  return muscle;
}

MuscleSpec makeThelenMuscle() {
  MuscleSpec muscle = makeMuscle("t_r");
  muscle.kind = MuscleKind::kThelen2003;
  muscle.tendon = TendonKind::kElastic;
  muscle.fiber_damping = 0;
  muscle.thelen = {0.033, 0.61, 0.5, 4, 0.3, 1.8, 0.94};
  return muscle;
}

// What the class does not know has the defaults.
MuscleSpec makeSchutteMuscle() {
  MuscleSpec muscle = makeMuscle("s_r");
  muscle.kind = MuscleKind::kSchutte1993;
  muscle.tendon = TendonKind::kElastic;
  muscle.max_contraction_velocity = 8;
  muscle.minimum_activation = 0;
  muscle.activation_time_constant = MuscleSpec().activation_time_constant;
  muscle.deactivation_time_constant = MuscleSpec().deactivation_time_constant;
  muscle.schutte.excitation_rate = 70;
  muscle.schutte.activation_rate = 14;
  muscle.schutte.active_force_length =
      FunctionSpec{FunctionSpec::Kind::kSimmSpline, {0, 1, 2}, {0, 1, 0}, 1};
  muscle.schutte.tendon_force_strain = FunctionSpec{FunctionSpec::Kind::kLinear, {}, {30, 0}, 1};
  return muscle;
}

void addPathPoints(MuscleSpec& muscle) {
  PathPointSpec via{"body_pin", {0.1, 0.2, 0.3}};
  via.kind = PathPointSpec::Kind::kConditional;
  via.coordinate = "pin_q0";
  via.range_min = -1.0 / 3.0;
  via.range_max = 0.5;
  PathPointSpec moving;
  moving.body = "body_slider";
  moving.kind = PathPointSpec::Kind::kMoving;
  moving.coordinate = "custom_q1";
  moving.location_functions = {
      FunctionSpec{FunctionSpec::Kind::kSimmSpline, {0, 0.1, 3}, {1, 2, 1e-9}, 0.958},
      FunctionSpec{FunctionSpec::Kind::kConstant, {}, {0.25}, 1},
      FunctionSpec{FunctionSpec::Kind::kLinear, {}, {2, 0.1}, 1}};
  muscle.path.push_back(via);
  muscle.path.push_back(moving);
}

ModelSpec makeModelWithEverything() {
  ModelSpec spec;
  spec.name = "A & B <\"model\">";
  spec.credits = "First line,\nsecond & last";
  spec.gravity = {0.1, -9.81, 0};
  spec.joints = {makeJoint(JointSpec::Kind::kWeld, "weld", 0),
                 makeJoint(JointSpec::Kind::kPin, "pin", 1),
                 makeJoint(JointSpec::Kind::kSlider, "slider", 1),
                 makeJoint(JointSpec::Kind::kUniversal, "universal", 2),
                 makeJoint(JointSpec::Kind::kPlanar, "planar", 3),
                 makeJoint(JointSpec::Kind::kGimbal, "gimbal", 3)};
  addCustomJoint(spec);
  for (const JointSpec& joint : spec.joints) {
    spec.bodies.push_back({joint.child.body, 1.0 / 3.0, {1, 2, 3}, {3, 4, 5, 0.1, 0.2, -0.3}, {}});
  }
  using Wrap = WrapObjectSpec::Kind;
  spec.bodies[0].wrap_objects = {
      {"wrap_a", Wrap::kCylinder, {1, 2, 3}, {4, 5, 6}, "-y", 0.03, 0.2},
      {"wrap_b", Wrap::kSphere, {0, 0, 0}, {0, 0, 0}, "all", 0.3},
      {"wrap_c", Wrap::kEllipsoid, {0, 1, 0}, {1, 0, 0}, "z", 1, 1, {0.1, 1.0 / 3.0, 0.3}, false}};
  spec.bodies[0].meshes = {{"a & b.vtp", {0.85, 1.0 / 3.0, 1}, {0, 0, 0}, {0, 0, 0}},
                           {"c.stl", {1, 1, 1}, {0.1, 0.2, 0.3}, {0, 0, 0}},
                           {"d.obj", {1, 1, 2}, {0, 0, 0}, {0.1, -0.2, 0.3}}};
  addPassiveForces(spec);
  spec.ground_wrap_objects = {{"wrap_g", Wrap::kCylinder, {0, 0.1, 0}, {0, 0, 0}, "x", 0.3, 2}};
  spec.couplers = {
      {"c", "pin_q0", "slider_q0", {FunctionSpec::Kind::kLinear, {}, {2, 1}, 3}, 0.5, false},
      {"d", "pin_q0", "planar_q0", {FunctionSpec::Kind::kSimmSpline, {0, 1}, {2, 3}, 1}, 1, true}};
  spec.markers = {{"R.Heel", "body_pin", {0.1, 0.2, 0.3}, true}, {"m", "ground", {0, 0, 0}, false}};
  spec.muscles = {makeMuscle("m_r"), makeMuscle("m_l"), makeThelenMuscle(), makeSchutteMuscle()};
  spec.muscles[1].tendon = TendonKind::kElastic;
  addPathPoints(spec.muscles[1]);
  spec.muscles[1].curves = {0.3, 0.8, 1.8, 0.7, 0.1, 0.01, 0.2, 4,    0.02, 0.1, 1.5,
                            0.5, 0.8, 0.1, 0.6, 0.3, 3,    0.7, 0.04, 30,   0.6, 0.4};
  using Kind = ActuatorSpec::Kind;
  spec.actuators = {
      {"a", Kind::kCoordinate, "pin_q0", "", "", {0, 0, 0}, {1, 0, 0}, true, 10, -1e300, 1e300},
      {"p", Kind::kPoint, "", "body_pin", "", {0.1, 0, 0}, {0, -1, 0}, false, 4, -1, 1},
      {"t", Kind::kTorque, "", "body_pin", "ground", {0, 0, 0}, {0, 0, 2}, true, 2, -1e300, 5},
      {"u", Kind::kTorque, "", "body_pin", "", {0, 0, 0}, {0, 1, 0}, false, 2, 0, 1e300}};
  spec.actuators[0].direction_in_ground = true;
  spec.muscle_groups = {{"all", {"m_r", "m_l"}}, {"none", {}}};
  return spec;
}

TEST(OsimWriter, ReadingBackGivesEveryFieldOfAModelWithEverything) {
  const ModelSpec spec = makeModelWithEverything();
  expectSame(readOsim(writeOsim(spec), "everything.osim"), spec);
}

TEST(OsimWriter, WritingTwiceGivesTheSameBytes) {
  const ModelSpec spec = makeModelWithEverything();
  EXPECT_EQ(writeOsim(spec), writeOsim(readOsim(writeOsim(spec), "everything.osim")));
}

class OsimWriterShared : public SharedDataTest {};

TEST_F(OsimWriterShared, ReadingBackGivesEveryFieldOfEverySharedModel) {
  for (const char* file : {"data/models/Rajagopal2016.osim",
                           "data/models/Rajagopal2015.osim",
                           "data/models/FullBodyModel_Hamner2010_v2_0.osim",
                           "data/models/gait2392_thelen2003muscle.osim",
                           "data/models/gait2392_millard2012muscle.osim",
                           "data/walk/Rajagopal2015_CustomMarkerset.osim",
                           "data/walk/moco/subject_walk_contact_bounded_80musc.osim",
                           "data/walk/example3DWalking/subject_walk_scaled.osim",
                           "reference/walk/scale/subject_scaled.osim",
                           "reference/walk/subject_adjusted.osim",
                           "reference/run/rra/pass2/subject_after.osim",
                           "reference/run/subject_adjusted.osim"}) {
    SCOPED_TRACE(file);
    const ModelSpec spec = readOsim(readFile(shared(file)), file);
    expectSame(readOsim(writeOsim(spec), "written.osim"), spec);
  }
}

}  // namespace
}  // namespace gaitmill
