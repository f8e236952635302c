#include "core/scale/apply_scale.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <string>

#include <Eigen/Geometry>

#include "core/base/error.h"
#include "core/model/model.h"
#include "core/model/muscle_paths.h"

namespace gaitmill {

namespace {

using Eigen::Vector3d;
using FactorMap = std::map<std::string, Vector3d>;

FactorMap makeFactorMap(const ModelSpec& spec, const std::vector<BodyScale>& factors) {
  FactorMap map = {{"ground", Vector3d::Ones()}};
  for (const BodySpec& body : spec.bodies) {
    map[body.name] = Vector3d::Ones();
  }
  for (const BodyScale& scale : factors) {
    require(spec.findBody(scale.body) >= 0,
            ErrorCode::kModelReference,
            "a scale factor names a body that the model does not have",
            {{}, 0, 0, scale.body});
    map[scale.body] = scale.factors;
  }
  return map;
}

void stretch(const Vector3d& s, Vector3d& point) {
  point = point.cwiseProduct(s);
}

// Every size of the surface grows with its axes as the body stretches them: a radius about an axis
// with the mean of the two across it, that of a sphere with the mean of all three.
void scaleWrap(const Vector3d& s, WrapObjectSpec& wrap) {
  using Eigen::AngleAxisd;
  const Eigen::Matrix3d R = (AngleAxisd(wrap.rotation.x(), Vector3d::UnitX()) *
                             AngleAxisd(wrap.rotation.y(), Vector3d::UnitY()) *
                             AngleAxisd(wrap.rotation.z(), Vector3d::UnitZ()))
                                .toRotationMatrix();
  const auto along = [&](int axis) {
    return R.col(axis).cwiseProduct(s).norm();
  };
  switch (wrap.kind) {
    case WrapObjectSpec::Kind::kCylinder:
      wrap.radius *= 0.5 * (along(0) + along(1));
      wrap.length *= along(2);
      break;
    case WrapObjectSpec::Kind::kSphere:
      wrap.radius *= (along(0) + along(1) + along(2)) / 3;
      break;
    case WrapObjectSpec::Kind::kEllipsoid:
      stretch({along(0), along(1), along(2)}, wrap.semi_axes);
      break;
  }
  stretch(s, wrap.translation);
}

// Inertia entries: xx yy zz xy xz yz.
void scaleUniformly(double mass_factor, double s, std::array<double, 6>& inertia) {
  for (double& entry : inertia) {
    entry *= mass_factor * s * s;
  }
}

// The body as a solid cylinder along the axis of its smallest moment of inertia.
void scaleAsCylinder(double mass,
                     double mass_factor,
                     const Vector3d& s,
                     std::array<double, 6>& inertia) {
  const auto smallest = std::min_element(inertia.begin(), inertia.begin() + 3);
  const auto a = static_cast<int>(smallest - inertia.begin());
  const int b = (a + 1) % 3;
  const int c = (a + 2) % 3;
  // Only one of the two transverse entries is used.
  const double I_oo = inertia[a == 0 ? 1 : 0];
  const double radius2 = 2 * inertia[static_cast<std::size_t>(a)] / mass;
  const double length2 = std::max(0.0, 12 * (I_oo - mass * radius2 / 4) / mass);
  const double scaled_radius2 = radius2 * s[b] * s[c];
  const double scaled_length2 = length2 * s[a] * s[a];
  const double scaled_mass = mass_factor * mass;
  const double transverse = scaled_mass * (scaled_length2 / 12 + scaled_radius2 / 4);
  inertia[static_cast<std::size_t>(a)] = scaled_mass * scaled_radius2 / 2;
  inertia[static_cast<std::size_t>(b)] = transverse;
  inertia[static_cast<std::size_t>(c)] = transverse;
  inertia[3] *= mass_factor * s[0] * s[1];
  inertia[4] *= mass_factor * s[0] * s[2];
  inertia[5] *= mass_factor * s[1] * s[2];
}

void scaleMass(const Vector3d& s, MassDistribution distribution, BodySpec& body) {
  const double mass_factor = distribution == MassDistribution::kPreserved ? 1.0 : s.prod();
  if (body.mass <= std::numeric_limits<double>::epsilon()) {
    body.inertia.fill(0);
  } else if (s.x() == s.y() && s.y() == s.z()) {
    scaleUniformly(mass_factor, s.x(), body.inertia);
  } else {
    scaleAsCylinder(body.mass, mass_factor, s, body.inertia);
  }
  body.mass *= mass_factor;
}

void scaleBody(const Vector3d& s, MassDistribution distribution, BodySpec& body) {
  stretch(s, body.mass_center);
  for (WrapObjectSpec& wrap : body.wrap_objects) {
    scaleWrap(s, wrap);
  }
  for (MeshSpec& mesh : body.meshes) {
    stretch(s, mesh.scale_factors);
    stretch(s, mesh.translation);
  }
  scaleMass(s, distribution, body);
}

bool isIdentity(const FunctionSpec& function) {
  return function.kind == FunctionSpec::Kind::kLinear && function.scale == 1.0 &&
         function.y.size() == 2 && function.y[0] == 1.0 && function.y[1] == 0.0;
}

// The axis is taken as if the joint frame were parallel to the parent body, as the reference does;
// that matters for uneven factors on rotated frames only (the knee).
void scaleJoint(const FactorMap& factors, JointSpec& joint) {
  const Vector3d& parent = factors.at(joint.parent.body);
  stretch(parent, joint.parent.translation);
  stretch(factors.at(joint.child.body), joint.child.translation);
  if (joint.kind != JointSpec::Kind::kCustom) {
    return;
  }
  for (std::size_t i = 3; i < joint.axes.size(); ++i) {
    TransformAxisSpec& axis = joint.axes[i];
    if (!isIdentity(axis.function)) {
      axis.function.scale *= axis.axis.normalized().cwiseAbs().dot(parent);
    }
  }
}

void scalePoint(const Vector3d& s, PathPointSpec& point) {
  stretch(s, point.location);
  if (point.kind == PathPointSpec::Kind::kMoving) {
    for (int axis = 0; axis < 3; ++axis) {
      point.location_functions[static_cast<std::size_t>(axis)].scale *= s[axis];
    }
  }
}

Eigen::VectorXd calcDefaultLengths(const ModelSpec& spec) {
  const Model model(spec);
  ModelState state(model);
  MusclePaths paths(model);
  state.setPose(model.defaultPose());
  paths.calc(state);
  return paths.lengths();
}

void scaleMuscles(const ModelSpec& before, ModelSpec& after) {
  if (after.muscles.empty()) {
    return;
  }
  const Eigen::VectorXd old_lengths = calcDefaultLengths(before);
  const Eigen::VectorXd new_lengths = calcDefaultLengths(after);
  for (std::size_t i = 0; i < after.muscles.size(); ++i) {
    const auto m = static_cast<Eigen::Index>(i);
    if (old_lengths[m] > 0) {
      after.muscles[i].optimal_fiber_length *= new_lengths[m] / old_lengths[m];
      after.muscles[i].tendon_slack_length *= new_lengths[m] / old_lengths[m];
    }
  }
}

void refuseTranslationCouplers(const ModelSpec& spec) {
  for (const CouplerSpec& coupler : spec.couplers) {
    require(findMotionKind(spec, coupler.dependent) != MotionKind::kTranslational,
            ErrorCode::kModelUnsupported,
            "a coupler that drives a translation cannot be scaled",
            {{}, 0, 0, coupler.name});
  }
}

}  // namespace

ModelSpec applyScaleFactors(const ModelSpec& generic,
                            const std::vector<BodyScale>& factors,
                            MassDistribution distribution) {
  const FactorMap map = makeFactorMap(generic, factors);
  refuseTranslationCouplers(generic);
  ModelSpec scaled = generic;
  for (BodySpec& body : scaled.bodies) {
    scaleBody(map.at(body.name), distribution, body);
  }
  for (JointSpec& joint : scaled.joints) {
    scaleJoint(map, joint);
  }
  for (MarkerSpec& marker : scaled.markers) {
    stretch(map.at(marker.body), marker.location);
  }
  for (MuscleSpec& muscle : scaled.muscles) {
    for (PathPointSpec& point : muscle.path) {
      scalePoint(map.at(point.body), point);
    }
  }
  for (PassiveForceSpec& force : scaled.passive_forces) {
    if (!force.frame1.body.empty()) {
      stretch(map.at(force.frame1.body), force.frame1.translation);
      stretch(map.at(force.frame2.body), force.frame2.translation);
    }
  }
  scaleMuscles(generic, scaled);
  return scaled;
}

}  // namespace gaitmill
