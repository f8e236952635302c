#include "core/sample/foot_loads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/LU>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/model/model.h"

namespace gaitmill {

namespace {

constexpr std::array<const char*, 6> kPelvisCoordinates = {
    "pelvis_tilt", "pelvis_list", "pelvis_rotation", "pelvis_tx", "pelvis_ty", "pelvis_tz"};

// Part of the inclination from the centre of pressure to the body's mass centre that the legs'
// forces take in double support: 0.7, since forces of walking meet somewhat above the mass centre.
constexpr double kLegInclination = 0.7;

// Height of the mass centre above the floor for that inclination [m]; 0.95 m of a 1.7 m person.
constexpr double kMassCenterHeight = 0.95;

struct Foot {
  BodyIndex body;
  Eigen::Vector3d heel;  // on the body, below the heel marker
  Eigen::Vector3d toe;   // below the toe marker
};

// Where in the step t lies: strike of the leading foot and share borne by it.
struct Step {
  bool right_leads = true;
  double strike = 0;    // [s]
  double toe_off = 0;   // [s] of the trailing foot
  double progress = 0;  // of double support, 0..1; 1 in single support
};

// Quintic step: 0 to 1 with vanishing first and second derivatives at both ends.
double calcShare(double progress) {
  return progress * progress * progress * (10.0 + progress * (-15.0 + 6.0 * progress));
}

// Centre of pressure between heel (0) and toe (1) over the stance (0 to 1): ahead of an even roll
// by a fifth of the foot in the middle, much as the published trial's.
double calcRollOver(double stance) {
  constexpr double kLead = 0.2;
  return stance + kLead * std::sin(kPi * stance);
}

Eigen::Vector3d projectToFloor(const Eigen::Vector3d& p_G) {
  return {p_G.x(), 0.0, p_G.z()};
}

const MarkerSpec& getMarker(const ModelSpec& spec, const std::string& name) {
  const int index = spec.findMarker(name);
  require(index >= 0, ErrorCode::kModelReference, "the model has no marker '" + name + "'");
  return spec.markers[static_cast<std::size_t>(index)];
}

Foot makeFoot(const Model& model, const std::string& marker_side, const std::string& body_side) {
  const double heel = getMarker(model.spec(), marker_side + "CAL").location.x();
  const double toe = getMarker(model.spec(), marker_side + "TOE").location.x();
  return {model.getBody("calcn_" + body_side), {heel, 0, 0}, {toe, 0, 0}};
}

}  // namespace

struct FootLoadDistribution::Impl {
  explicit Impl(const GaitMotion& m)
      : motion(m),
        state(m.model()),
        right(makeFoot(m.model(), "R", "r")),
        left(makeFoot(m.model(), "L", "l")),
        q(m.model().coordinateCount()),
        u(q.size()),
        udot(q.size()),
        tau(q.size()) {
    for (std::size_t i = 0; i < kPelvisCoordinates.size(); ++i) {
      pelvis[i] = m.model().getCoordinate(kPelvisCoordinates[i]);
    }
  }

  void setTime(double t) {
    motion.calc(t, q, u, udot);
    state.setMotion(q, u);
  }

  // Ground point below a station of a foot at the time last set.
  Eigen::Vector3d findGroundPoint(const Foot& foot, const Eigen::Vector3d& station) const {
    return projectToFloor(state.pose(foot.body) * station);
  }

  // tau of the pelvis without ground reaction = S^T W with S the screws of its six coordinates.
  NetReaction calcNet(double t) {
    setTime(t);
    state.calcInverseDynamics(udot, {}, tau);
    Eigen::Matrix<double, 6, 6> screws;
    Vector6 residual;
    for (std::size_t i = 0; i < pelvis.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      screws.row(row) = state.screws().col(pelvis[i].value()).transpose();
      residual[row] = tau[pelvis[i].value()];
    }
    const Vector6 wrench = screws.partialPivLu().solve(residual);
    const Eigen::Vector3d moment = wrench.head<3>();
    const Eigen::Vector3d force = wrench.tail<3>();
    const Eigen::Vector3d point(moment.z() / force.y(), 0, -moment.x() / force.y());
    return {force,
            point,
            moment.y() - (point.z() * force.x() - point.x() * force.z()),
            state.calcMassCenter()};
  }

  Step findStep(double t) const {
    const double half = 0.5 * motion.pattern().period;
    const double count = std::floor(t / half);
    Step step;
    step.right_leads = std::fmod(std::abs(count), 2.0) < 0.5;
    step.strike = count * half;
    step.toe_off = step.strike + kDoubleSupport * motion.pattern().period;
    step.progress = std::min(1.0, (t - step.strike) / (step.toe_off - step.strike));
    return step;
  }

  // Nominal centres of pressure: the trailing foot's goes from the zero moment point at the strike
  // to below its toe, the leading foot's from below its heel to the zero moment point at toe-off.
  void calcNominalPoints(const Step& step, Eigen::Vector3d& lead, Eigen::Vector3d& trail) {
    const Foot& lead_foot = step.right_leads ? right : left;
    const Foot& trail_foot = step.right_leads ? left : right;
    const Eigen::Vector3d at_strike = calcNet(step.strike).point;
    const Eigen::Vector3d heel = findGroundPoint(lead_foot, lead_foot.heel);
    const Eigen::Vector3d at_toe_off = calcNet(step.toe_off).point;
    const Eigen::Vector3d toe = findGroundPoint(trail_foot, trail_foot.toe);
    lead = heel + step.progress * (at_toe_off - heel);
    trail = at_strike + step.progress * (toe - at_strike);
  }

  FootLoads calc(double t) {
    const Step step = findStep(t);
    const double share = calcShare(step.progress);
    FootLoad lead;
    FootLoad trail;
    if (step.progress >= 1.0) {
      const NetReaction net = calcNet(t);
      lead = {net.force, net.point, {0, net.vertical_moment, 0}};
    } else {
      calcNominalPoints(step, lead.point, trail.point);
      distribute(calcNet(t), share, lead, trail);
    }
    return step.right_leads ? FootLoads{lead, trail} : FootLoads{trail, lead};
  }

  static void distribute(const NetReaction& net, double share, FootLoad& lead, FootLoad& trail) {
    // Smallest shift of the two centres that puts their weighted mean on the zero moment point.
    const Eigen::Vector3d error = net.point - (1.0 - share) * trail.point - share * lead.point;
    const double weight = share * share + (1.0 - share) * (1.0 - share);
    lead.point += share / weight * error;
    trail.point += (1.0 - share) / weight * error;

    // Opposite forces along the line between the centres: half the step over the height of the mass
    // centre is the legs' inclination, and each leg bears about half the weight in the middle.
    const Eigen::Vector3d line = trail.point - lead.point;
    const double inclination = 0.5 * line.norm() / kMassCenterHeight;
    const double squeeze =
        2.0 * share * (1.0 - share) * kLegInclination * inclination * net.force.y();
    lead.force = share * net.force + squeeze * line.normalized();
    trail.force = (1.0 - share) * net.force - squeeze * line.normalized();
    lead.torque.y() = share * net.vertical_moment;
    trail.torque.y() = (1.0 - share) * net.vertical_moment;
  }

  Eigen::Vector3d calcTarget(double t) {
    setTime(t);
    const Step step = findStep(t);
    const double share = calcShare(step.progress);
    const double half = 0.5 * motion.pattern().period;
    const double stance = half + step.toe_off - step.strike;
    const Foot& lead = step.right_leads ? right : left;
    const Foot& trail = step.right_leads ? left : right;
    const auto rollOver = [&](const Foot& foot, double since_strike) {
      const double rolled = calcRollOver(std::min(1.0, since_strike / stance));
      return findGroundPoint(foot, foot.heel + rolled * (foot.toe - foot.heel));
    };
    return share * rollOver(lead, t - step.strike) +
           (1.0 - share) * rollOver(trail, t - step.strike + half);
  }

  const GaitMotion& motion;
  ModelState state;
  Foot right;
  Foot left;
  std::array<CoordinateIndex, 6> pelvis;
  Eigen::VectorXd q, u, udot, tau;
};

FootLoadDistribution::FootLoadDistribution(const GaitMotion& motion)
    : impl_(std::make_unique<Impl>(motion)) {}
FootLoadDistribution::~FootLoadDistribution() = default;

NetReaction FootLoadDistribution::calcNet(double t) {
  return impl_->calcNet(t);
}

FootLoads FootLoadDistribution::calc(double t) {
  return impl_->calc(t);
}

Eigen::Vector3d FootLoadDistribution::calcTarget(double t) {
  return impl_->calcTarget(t);
}

}  // namespace gaitmill
