#pragma once

#include <string>
#include <vector>

#include "core/data/model_spec.h"
#include "core/io/osim_element.h"
#include "core/io/osim_frames.h"

namespace gaitmill {

// Joints, coordinates, functions and couplers of a model document. Internal to core/io.

/// A joint element and, in documents below 30501, the body it stands in (its child body).
struct OsimJoint {
  OsimElement element;
  std::string enclosing_body;
};

/// Joints in document order, from the JointSet or from inside the bodies.
std::vector<OsimJoint> collectJoints(const OsimElement& model);

/// Ball and free joints are read as what turns by the same angles: gimbal and custom joints.
/// @throws Error kModelUnsupported for other joints and functions not listed in FunctionSpec,
/// kModelReference, kModelValue, kModelElement
JointSpec readJoint(const OsimJoint& joint, const OsimFrames& frames);

/// True for joints whose speeds in OpenSim are components of angular velocity.
bool hasAngularSpeeds(const OsimElement& joint);

/// Axes of a custom joint that name a coordinate but no function, and so do not move with it;
/// programs before OpenSim 3 took them for linear.
std::vector<OsimElement> findIdleAxes(const OsimElement& joint);

/// @param context  element to blame if `function` is null
FunctionSpec readFunction(const OsimElement& function, const OsimElement& context);

CouplerSpec readCoupler(const OsimElement& coupler, const std::vector<JointSpec>& joints);

/// Requires of `name` to be a coordinate of one of the joints.
void requireCoordinate(const OsimElement& reference,
                       const std::string& name,
                       const std::vector<JointSpec>& joints);

/// Every body is the child of exactly one joint and hangs on ground.
/// @throws Error kModelTopology
void requireTree(const std::vector<OsimElement>& body_elements,
                 const std::vector<OsimJoint>& joint_elements,
                 const std::vector<JointSpec>& joints);

}  // namespace gaitmill
