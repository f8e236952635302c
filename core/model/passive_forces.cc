#include "core/model/passive_forces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/base/error.h"

namespace gaitmill {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Kind = PassiveForceSpec::Kind;

const std::vector<std::string>& coordinateVariables() {
  static const std::vector<std::string> names = {"q", "qdot"};
  return names;
}

const std::vector<std::string>& bushingVariables() {
  static const std::vector<std::string> names = {
      "theta_x", "theta_y", "theta_z", "delta_x", "delta_y", "delta_z"};
  return names;
}

Pose makePose(const FrameSpec& frame) {
  Pose pose;
  pose.R = (Eigen::AngleAxisd(frame.orientation.x(), Vector3d::UnitX()) *
            Eigen::AngleAxisd(frame.orientation.y(), Vector3d::UnitY()) *
            Eigen::AngleAxisd(frame.orientation.z(), Vector3d::UnitZ()))
               .toRotationMatrix();
  pose.p = frame.translation;
  return pose;
}

Pose compose(const Pose& X_AB, const Pose& X_BC) {
  return {X_AB.R * X_BC.R, X_AB * X_BC.p};
}

/// Body-fixed x-y-z angles of a rotation.
Vector3d calcAngles(const Matrix3d& R) {
  return {std::atan2(-R(1, 2), R(2, 2)),
          std::asin(std::clamp(R(0, 2), -1.0, 1.0)),
          std::atan2(-R(0, 1), R(0, 0))};
}

/// Angular velocity of body-fixed x-y-z angles, in the outer frame: w = E angles'.
Matrix3d calcAngleAxes(const Vector3d& angles) {
  const Matrix3d Rx = Eigen::AngleAxisd(angles.x(), Vector3d::UnitX()).toRotationMatrix();
  const Matrix3d Ry = Eigen::AngleAxisd(angles.y(), Vector3d::UnitY()).toRotationMatrix();
  Matrix3d E;
  E << Vector3d::UnitX(), Rx.col(1), (Rx * Ry).col(2);
  return E;
}

/// From 0 to 1 while x goes from 0 to 1, twice differentiable.
double calcOnset(double x) {
  const double c = std::clamp(x, 0.0, 1.0);
  return c * c * c * (10 + c * (-15 + 6 * c));
}

double calcLimitForce(const PassiveForceSpec& spec, double q, double u) {
  const double above = calcOnset((q - spec.upper_limit) / spec.transition);
  const double below = calcOnset((spec.lower_limit - q) / spec.transition);
  return -spec.upper_stiffness * above * (q - spec.upper_limit) +
         spec.lower_stiffness * below * (spec.lower_limit - q) - spec.damping * (above + below) * u;
}

/// The deflection of a bushing and its rate.
struct Deflection {
  Pose X_GF;
  Vector3d p_FM_G = Vector3d::Zero();
  Matrix3d axes = Matrix3d::Identity();  ///< w_FM in F per rate of the angles
  Vector6 value = Vector6::Zero();
  Vector6 rate = Vector6::Zero();
};

Deflection calcDeflection(const ModelState& state,
                          BodyIndex body1,
                          const Pose& X_B1F,
                          BodyIndex body2,
                          const Pose& X_B2M) {
  Deflection d;
  d.X_GF = compose(state.pose(body1), X_B1F);
  const Pose X_GM = compose(state.pose(body2), X_B2M);
  const Matrix3d R_FG = d.X_GF.R.transpose();
  const Vector3d angles = calcAngles(R_FG * X_GM.R);
  d.p_FM_G = X_GM.p - d.X_GF.p;
  d.axes = calcAngleAxes(angles);
  d.value << angles, R_FG * d.p_FM_G;

  const Vector6 V1 = state.calcBodyVelocity(body1);
  const Vector6 V2 = state.calcBodyVelocity(body2);
  const Vector3d w1 = V1.head<3>();
  // Velocity of M relative to the point of body 1 that it is at: the derivative taken in F.
  const Vector3d v =
      (V2.tail<3>() + V2.head<3>().cross(X_GM.p)) - (V1.tail<3>() + w1.cross(X_GM.p));
  d.rate << d.axes.inverse() * (R_FG * (V2.head<3>() - w1)), R_FG * v;
  return d;
}

}  // namespace

PassiveForces::PassiveForces(const Model& model) {
  for (const PassiveForceSpec& spec : model.spec().passive_forces) {
    const bool on_coordinate = spec.kind == Kind::kCoordinateLimit ||
                               spec.kind == Kind::kCoordinateSpring ||
                               spec.kind == Kind::kCoordinateExpression;
    if (on_coordinate) {
      OnCoordinate force{spec, model.getCoordinate(spec.coordinate).value(), {}};
      require(spec.transition > 0,
              ErrorCode::kModelValue,
              "the transition of '" + spec.name + "' must be above 0",
              {{}, 0, 0, spec.name});
      if (spec.kind == Kind::kCoordinateExpression) {
        force.expression.emplace_back(spec.expressions[0], coordinateVariables());
      }
      limits_.push_back(std::move(force));
      continue;
    }
    Bushing bushing{spec,
                    model.getBody(spec.frame1.body),
                    model.getBody(spec.frame2.body),
                    makePose(spec.frame1),
                    makePose(spec.frame2),
                    {},
                    {}};
    for (std::size_t i = 0; i < 6; ++i) {
      if (spec.kind == Kind::kFunctionBushing) {
        bushing.functions.emplace_back(spec.functions[i]);
      } else if (spec.kind == Kind::kExpressionBushing) {
        bushing.expressions.emplace_back(spec.expressions[i], bushingVariables());
      }
    }
    bushings_.push_back(std::move(bushing));
  }
}

double PassiveForces::calcForce(const OnCoordinate& force, double q, double u) {
  if (force.spec.kind == Kind::kCoordinateLimit) {
    return calcLimitForce(force.spec, q, u);
  }
  if (force.spec.kind == Kind::kCoordinateSpring) {
    return -force.spec.stiffness * (q - force.spec.rest_length) - force.spec.viscosity * u;
  }
  const std::array<double, 2> values = {q, u};
  return force.expression.front().evaluate(values.data());
}

Vector6 PassiveForces::calcInternalForce(const Bushing& bushing,
                                         const Vector6& dq,
                                         const Vector6& rate) {
  Vector6 damping;
  damping << bushing.spec.rotational_damping, bushing.spec.translational_damping;
  Vector6 force = -damping.cwiseProduct(rate);
  if (bushing.spec.kind == Kind::kBushing) {
    Vector6 stiffness;
    stiffness << bushing.spec.rotational_stiffness, bushing.spec.translational_stiffness;
    return force - stiffness.cwiseProduct(dq);
  }
  for (std::size_t i = 0; i < 6; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    force[k] -= bushing.spec.kind == Kind::kFunctionBushing
                    ? bushing.functions[i].evaluate(dq[k]).value
                    : bushing.expressions[i].evaluate(dq.data());
  }
  return force;
}

void PassiveForces::addGeneralizedForces(const ModelState& state,
                                         Eigen::Ref<Eigen::VectorXd> forces) const {
  for (const OnCoordinate& force : limits_) {
    forces[force.coordinate] +=
        calcForce(force, state.q()[force.coordinate], state.u()[force.coordinate]);
  }
}

void PassiveForces::addBodyWrenches(const ModelState& state, Matrix6X& wrenches) const {
  for (const Bushing& bushing : bushings_) {
    const Deflection d =
        calcDeflection(state, bushing.body1, bushing.X_B1F, bushing.body2, bushing.X_B2M);
    const Vector6 internal = calcInternalForce(bushing, d.value, d.rate);
    // Power of the angles' forces = power of the moment, for any rate: m = E^-T f.
    const Vector3d moment = d.X_GF.R * (d.axes.transpose().inverse() * internal.head<3>()).eval();
    const Vector3d force = d.X_GF.R * internal.tail<3>();
    Vector6 wrench;
    wrench << moment + (d.X_GF.p + d.p_FM_G).cross(force), force;
    if (bushing.body2 != kGround) {
      wrenches.col(bushing.body2.value()) += wrench;
    }
    if (bushing.body1 != kGround) {
      wrenches.col(bushing.body1.value()) -= wrench;
    }
  }
}

}  // namespace gaitmill
