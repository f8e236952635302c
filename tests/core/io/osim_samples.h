#pragma once

#include <string>

namespace gaitmill {

/// Small model documents for tests of single rules: two bodies, a pin joint and a custom joint, put
/// together from the pieces that a test wants to vary.
struct OsimPieces {
  std::string version = "40000";
  std::string defaults;
  std::string thigh;  ///< further properties of that body
  std::string hip_frames =
      "<socket_parent_frame>/ground</socket_parent_frame>"
      "<socket_child_frame>/bodyset/thigh</socket_child_frame>";
  std::string knee_frames =
      "<socket_parent_frame>/bodyset/thigh</socket_parent_frame>"
      "<socket_child_frame>/bodyset/shank</socket_child_frame>";
  std::string knee_coordinates = "<Coordinate name=\"knee\" />";
  std::string knee_transform =
      "<TransformAxis name=\"rotation1\"><coordinates>knee</coordinates><axis>0 0 1</axis>"
      "<LinearFunction name=\"function\"><coefficients>1 0</coefficients></LinearFunction>"
      "</TransformAxis>";
  std::string constraints;
  std::string forces;
  std::string markers;
};

inline std::string makeOsim(const OsimPieces& pieces) {
  return "<OpenSimDocument Version=\"" + pieces.version + "\"><Model name=\"leg\"><defaults>" +
         pieces.defaults + "</defaults><BodySet><objects><Body name=\"thigh\"><mass>9</mass>" +
         pieces.thigh +
         "</Body><Body name=\"shank\"><mass>4</mass></Body></objects></BodySet>"
         "<JointSet><objects><PinJoint name=\"hip_joint\">" +
         pieces.hip_frames + "<coordinates><Coordinate name=\"hip\" /></coordinates></PinJoint>" +
         "<CustomJoint name=\"knee_joint\">" + pieces.knee_frames + "<coordinates>" +
         pieces.knee_coordinates + "</coordinates><SpatialTransform>" + pieces.knee_transform +
         "</SpatialTransform></CustomJoint></objects></JointSet><ConstraintSet><objects>" +
         pieces.constraints + "</objects></ConstraintSet><ForceSet><objects>" + pieces.forces +
         "</objects></ForceSet><MarkerSet><objects>" + pieces.markers +
         "</objects></MarkerSet></Model></OpenSimDocument>";
}

/// A muscle of the least that a document must say.
inline std::string makeMuscleElement(const std::string& properties) {
  return "<Millard2012EquilibriumMuscle name=\"m\">" + properties +
         "<GeometryPath><PathPointSet><objects>"
         "<PathPoint name=\"a\"><socket_parent_frame>/bodyset/thigh</socket_parent_frame>"
         "<location>0 0.1 0</location></PathPoint>"
         "<PathPoint name=\"b\"><socket_parent_frame>/bodyset/shank</socket_parent_frame>"
         "</PathPoint></objects></PathPointSet></GeometryPath></Millard2012EquilibriumMuscle>";
}

}  // namespace gaitmill
