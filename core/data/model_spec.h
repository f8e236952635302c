#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace gaitmill {

// What a model document says, as plain values. References are names, as in the document; core/model
// resolves them once. Body-fixed quantities are in the frame of their body. Units SI, angles rad.

/// Function of one coordinate. Value = scale * f(x).
struct FunctionSpec {
  enum class Kind {
    kConstant,    ///< y[0]
    kLinear,      ///< y[0] x + y[1]
    kPolynomial,  ///< y[0] x^n + ... + y[n]
    kSimmSpline,  ///< cubic through (x, y), end conditions of spec/model.md 5.2, linear outside
    kPiecewiseLinear,  ///< through (x, y), end slopes outside
  };
  Kind kind = Kind::kConstant;
  std::vector<double> x;
  std::vector<double> y = {0.0};
  double scale = 1.0;
};

/// Surface over which muscle paths wrap, centred at `translation` and turned by `rotation`.
struct WrapObjectSpec {
  enum class Kind {
    kCylinder,   ///< `radius` about the local z axis, `length` along it
    kSphere,     ///< `radius`
    kEllipsoid,  ///< `semi_axes` along the local axes
  };
  std::string name;  ///< unique in the model
  Kind kind = Kind::kCylinder;
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();  ///< body-fixed x-y-z angles
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  std::string quadrant =
      "all";  ///< "all", or the half space in which the path must stay: "x", "-y"
  double radius = 1.0;
  double length = 1.0;
  Eigen::Vector3d semi_axes{0.05, 0.05, 0.05};
  bool active = true;
};

/// A surface drawn with a body; no influence on the mechanics.
struct MeshSpec {
  std::string file;  ///< name as in the document, for instance "r_femur.vtp"
  Eigen::Vector3d scale_factors = Eigen::Vector3d::Ones();  ///< along the axes of the mesh
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();    ///< of its frame on the body
  Eigen::Vector3d orientation = Eigen::Vector3d::Zero();    ///< body-fixed x-y-z angles
};

struct BodySpec {
  std::string name;
  double mass = 0;  ///< [kg]
  Eigen::Vector3d mass_center = Eigen::Vector3d::Zero();
  /// About the mass centre, body axes: xx yy zz xy xz yz [kg m^2].
  std::array<double, 6> inertia = {0, 0, 0, 0, 0, 0};
  std::vector<WrapObjectSpec> wrap_objects;
  std::vector<MeshSpec> meshes = {};
};

/// A joint's frame on a body: X = [Rx(a) Ry(b) Rz(c) | translation].
struct FrameSpec {
  std::string body;  ///< "ground" or a body
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Vector3d orientation = Eigen::Vector3d::Zero();
};

struct CoordinateSpec {
  std::string name;
  double default_value = 0;
  double default_speed = 0;
  double range_min = -10;
  double range_max = 10;
  bool clamped = false;
  bool locked = false;
};

/// One of the six axes of a custom joint. Without a coordinate the function is a constant.
struct TransformAxisSpec {
  std::string coordinate;  ///< empty = none
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  FunctionSpec function;
};

struct JointSpec {
  enum class Kind { kWeld, kPin, kSlider, kUniversal, kPlanar, kGimbal, kCustom };
  std::string name;
  Kind kind = Kind::kWeld;
  FrameSpec parent;
  FrameSpec child;  ///< its body is the joint's child body
  std::vector<CoordinateSpec> coordinates;
  /// rotation1..3 then translation1..3; used by kCustom only (spec/model.md 4.1).
  std::array<TransformAxisSpec, 6> axes;
};

/// dependent = scale * f(independent), always enforced unless stated.
struct CouplerSpec {
  std::string name;
  std::string independent;
  std::string dependent;
  FunctionSpec function;
  double scale = 1.0;
  bool enforced = true;
};

struct MarkerSpec {
  std::string name;
  std::string body;
  Eigen::Vector3d location = Eigen::Vector3d::Zero();
  bool fixed = false;  ///< not moved by marker placement
};

/// A point that a muscle path runs through, fixed in the frame of a body unless its kind says
/// otherwise (spec/path.md 1).
struct PathPointSpec {
  enum class Kind {
    kFixed,
    kConditional,  ///< part of the path only while `coordinate` is in [range_min, range_max]
    kMoving,  ///< at location_functions of `coordinate` limited to its range, or of 0 without one
  };
  std::string body;
  Eigen::Vector3d location = Eigen::Vector3d::Zero();  ///< unused by kMoving
  Kind kind = Kind::kFixed;
  std::string coordinate = {};  ///< empty on a kConditional point: never part of the path
  double range_min = 0;
  double range_max = 0;
  std::array<FunctionSpec, 3> location_functions = {};  ///< x, y, z of a kMoving point
};

/// One wrap object of a path. The range counts path points from 1, -1 = open end.
struct PathWrapSpec {
  std::string wrap_object;
  int first_point = -1;
  int last_point = -1;
  /// OpenSim's rule for the plane of a path over an ellipsoid. Carried along only: paths here are
  /// geodesics.
  std::string method = "hybrid";
};

/// Parameters of the four muscle curves (spec/muscle.md 2). The defaults are those of
/// Rajagopal2016.
struct MuscleCurvesSpec {
  double active_min_length = 0.25;  ///< [l0M] active force-length
  double active_transition_length = 0.77;
  double active_max_length = 1.9;
  double active_shallow_slope = 0.75;
  double active_minimum_value = 0.0;
  double concentric_slope_at_vmax = 0.0;  ///< force-velocity
  double concentric_slope_near_vmax = 0.25;
  double isometric_slope = 5.0;
  double eccentric_slope_at_vmax = 0.0;
  double eccentric_slope_near_vmax = 0.15;
  double max_eccentric_force = 1.4;
  double concentric_curviness = 0.6;
  double eccentric_curviness = 0.9;
  double passive_strain_at_zero_force = 0.0;  ///< passive force-length
  double passive_strain_at_one_force = 0.7;
  double passive_stiffness_at_low_force = 0.2;
  double passive_stiffness_at_one_force = 2.0 / 0.7;
  double passive_curviness = 0.75;
  double tendon_strain_at_one_force = 0.049;  ///< tendon force-length
  double tendon_stiffness_at_one_force = 1.375 / 0.049;
  double tendon_force_at_toe_end = 2.0 / 3.0;
  double tendon_curviness = 0.5;
};

/// Parameters of the curves of Thelen (2003), with the class's defaults (spec/muscle.md 10).
struct ThelenCurvesSpec {
  double tendon_strain_at_one_force = 0.04;  ///< e0T
  double passive_strain_at_one_force = 0.6;  ///< e0M
  double active_shape = 0.45;                ///< gamma, width of the active force-length curve
  double passive_shape = 5;                  ///< kPE
  double velocity_shape = 0.25;              ///< Af
  double max_eccentric_force = 1.4;          ///< Flen
  double linear_above_force = 0.95;          ///< share of Flen above which force-velocity is a line
};

/// What a Schutte muscle states beside its size (Schutte et al. 1993). A curve that is not stated
/// is the model's own; abscissae are normalised fiber length, or tendon strain.
struct SchutteCurvesSpec {
  double excitation_rate = 76.67;     ///< of activation while it rises, per unit excitation [1/s]
  double activation_rate = 14.59854;  ///< [1/s]
  std::optional<FunctionSpec> active_force_length = {};
  std::optional<FunctionSpec> passive_force_length = {};
  std::optional<FunctionSpec> tendon_force_strain = {};
};

enum class TendonKind { kElastic, kRigid };

/// Whose equations a muscle follows, and with which of its curve parameters.
enum class MuscleKind {
  kMillard2012,  ///< `curves`
  kThelen2003,   ///< `thelen`; no fiber damping, always an elastic tendon
  kSchutte1993,  ///< `schutte`; time constants of activation unused
};

/// One Hill-type muscle-tendon unit.
struct MuscleSpec {
  std::string name;
  double max_isometric_force = 0;             ///< F0M [N] > 0
  double optimal_fiber_length = 0;            ///< l0M [m] > 0
  double tendon_slack_length = 0;             ///< lsT [m] > 0
  double pennation_at_optimal = 0;            ///< alpha0 [rad] in [0, pi/2)
  double max_contraction_velocity = 10;       ///< vmax [optimal fiber lengths / s]
  double fiber_damping = 0.1;                 ///< beta [-]; none in Thelen's model
  double activation_time_constant = 0.010;    ///< [s]
  double deactivation_time_constant = 0.040;  ///< [s]
  double minimum_activation = 0.01;
  double default_activation = 0.01;
  double default_fiber_length = 0.1;              ///< [m]
  double maximum_pennation = 1.4706289056333368;  ///< acos(0.1) [rad]
  double min_control = 0.01;
  double max_control = 1.0;
  TendonKind tendon = TendonKind::kElastic;
  MuscleCurvesSpec curves;
  std::vector<PathPointSpec> path;
  std::vector<PathWrapSpec> wraps;
  MuscleKind kind = MuscleKind::kMillard2012;
  ThelenCurvesSpec thelen = {};
  SchutteCurvesSpec schutte = {};
};

/// An ideal actuator: generalized force, point force or torque = control * optimal_force.
struct ActuatorSpec {
  enum class Kind {
    kCoordinate,  ///< generalized force on `coordinate`
    kPoint,       ///< force along `direction` at `point` of `body`
    kTorque,      ///< torque along `direction` on `body`, reaction on `reaction_body`
  };
  std::string name;
  Kind kind = Kind::kCoordinate;
  std::string coordinate;
  std::string body;
  std::string reaction_body;                        ///< kTorque; "ground" or empty = none
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< kPoint: fixed in the body
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  bool direction_in_ground = true;  ///< else in the axes of `body`
  double optimal_force = 1.0;       ///< [N] or [N.m]
  double min_control = -1e300;      ///< "-Inf" in documents
  double max_control = 1e300;
};

/// A force that the model applies by itself, from its motion alone: what ligaments, capsules and
/// foot pads do. Named after the document's types.
struct PassiveForceSpec {
  enum class Kind {
    kCoordinateLimit,       ///< spring and damper beyond a coordinate's limits
    kCoordinateSpring,      ///< -stiffness (q - rest_length) - viscosity u on `coordinate`
    kCoordinateExpression,  ///< expressions[0] of "q" and "qdot" on `coordinate`
    kBushing,               ///< between two frames, linear in the deflection
    kFunctionBushing,       ///< minus one function of each component of the deflection
    kExpressionBushing,     ///< minus expressions of theta_x..z [rad] and delta_x..z [m]
  };
  std::string name;
  Kind kind = Kind::kCoordinateLimit;
  std::string coordinate;
  double upper_limit = 0;  ///< [rad|m]
  double lower_limit = 0;
  double upper_stiffness = 1;  ///< [N.m/rad|N/m]
  double lower_stiffness = 1;
  double damping = 0.001;   ///< beyond the limits [N.m s/rad|N s/m]
  double transition = 0.1;  ///< way over which stiffness and damping set in [rad|m] > 0
  double stiffness = 0;     ///< kCoordinateSpring [N.m/rad|N/m]
  double rest_length = 0;   ///< [rad|m]
  double viscosity = 0;     ///< [N.m s/rad|N s/m]
  /// A bushing pulls frame 2 towards frame 1. Deflection = frame 2 in frame 1: body-fixed x-y-z
  /// angles, then translation.
  FrameSpec frame1;
  FrameSpec frame2;
  Eigen::Vector3d rotational_stiffness = Eigen::Vector3d::Zero();     ///< [N.m/rad]
  Eigen::Vector3d translational_stiffness = Eigen::Vector3d::Zero();  ///< [N/m]
  Eigen::Vector3d rotational_damping = Eigen::Vector3d::Zero();       ///< [N.m s/rad]
  Eigen::Vector3d translational_damping = Eigen::Vector3d::Zero();    ///< [N s/m]
  std::array<FunctionSpec, 6> functions = {};                         ///< moments, then forces
  std::array<std::string, 6> expressions = {"0", "0", "0", "0", "0", "0"};
};

struct MuscleGroupSpec {
  std::string name;
  std::vector<std::string> members;
};

/// A whole model. Names are unique within their list; order is the document's.
struct ModelSpec {
  std::string name;
  std::string credits;
  Eigen::Vector3d gravity{0, -9.80665, 0};  ///< [m/s^2]
  std::vector<BodySpec> bodies;
  std::vector<WrapObjectSpec> ground_wrap_objects;
  std::vector<JointSpec> joints;
  std::vector<CouplerSpec> couplers;
  std::vector<MarkerSpec> markers;
  std::vector<MuscleSpec> muscles;
  std::vector<ActuatorSpec> actuators;
  std::vector<PassiveForceSpec> passive_forces;
  std::vector<MuscleGroupSpec> muscle_groups;
  /// Version of the document read; what is written is 40000, whatever was read.
  int document_version = 40000;

  /// Sum of the body masses [kg].
  double calcTotalMass() const;
  /// Position in the list, or -1.
  int findBody(const std::string& body_name) const;
  int findMuscle(const std::string& muscle_name) const;
  int findMarker(const std::string& marker_name) const;
  /// Coordinate of that name in any joint, or null.
  const CoordinateSpec* findCoordinate(const std::string& coordinate_name) const;
  /// The joint that has it, or null.
  const JointSpec* findJointOf(const std::string& coordinate_name) const;
};

/// Multiplies every body mass so that the total becomes `total_mass` [kg]; inertias scale alike if
/// asked (correct physics), or stay (the published procedure after residual reduction).
enum class InertiaScaling { kWithMass, kKeep };
void setTotalMass(ModelSpec& spec, double total_mass, InertiaScaling inertia);

/// True if the coordinate rotates a joint axis one to one, so that files in degrees are converted.
/// A coordinate that drives its joint only through splines (patella) is "coupled": never converted.
enum class MotionKind { kRotational, kTranslational, kCoupled };
MotionKind findMotionKind(const JointSpec& joint, const std::string& coordinate);
/// The same, searching all joints. @throws Error kInputCoordinates if there is no such coordinate
MotionKind findMotionKind(const ModelSpec& spec, const std::string& coordinate);

}  // namespace gaitmill
