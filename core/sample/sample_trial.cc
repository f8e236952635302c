#include "core/sample/sample_trial.h"

#include <array>
#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "core/model/free_coordinates.h"
#include "core/sample/emg_envelopes.h"
#include "core/sample/foot_loads.h"
#include "core/sample/gait_pattern.h"
#include "core/sample/noise.h"

namespace gaitmill {

namespace {

// Hip to ankle of the scaled model of the published walking trial, whose motion the pattern is [m].
constexpr double kFittedLegLength = 0.847;

// Below the heel marker's body origin: sole of the generic foot [m].
constexpr double kSoleDepth = 0.005;

// Standing pose: arms and legs slightly apart [rad].
constexpr double kStandingArmAdduction = -0.15;
constexpr double kStandingHipAdduction = -0.04;

std::vector<double> makeTimes(double duration, double rate) {
  const int count = static_cast<int>(std::floor(duration * rate + 0.5)) + 1;
  std::vector<double> times;
  times.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    times.push_back(i / rate);
  }
  return times;
}

double calcLegLength(const Model& model) {
  ModelState state(model);
  state.setPose(model.defaultPose());
  return (state.pose(model.getBody("femur_r")).p - state.pose(model.getBody("talus_r")).p).norm();
}

// Height of the right sole over the floor, mean of heel and toe.
double calcSoleHeight(const Model& model, const ModelState& state) {
  const Pose& foot = state.pose(model.getBody("calcn_r"));
  double height = 0;
  for (const char* name : {"RCAL", "RTOE"}) {
    const int index = model.spec().findMarker(name);
    require(index >= 0,
            ErrorCode::kModelReference,
            std::string("the model has no marker '") + name + "'");
    const double x = model.spec().markers[static_cast<std::size_t>(index)].location.x();
    height += 0.5 * (foot * Eigen::Vector3d(x, -kSoleDepth, 0)).y();
  }
  return height;
}

// Pattern for the subject's legs, standing on the floor between 20 and 40 % of the cycle.
GaitPattern makePattern(const Model& subject) {
  GaitPattern pattern;
  pattern.length_scale = calcLegLength(subject) / kFittedLegLength;
  const GaitMotion motion(subject, pattern);
  ModelState state(subject);
  Eigen::VectorXd q(subject.coordinateCount()), u(q.size()), udot(q.size());
  double height = 0;
  constexpr int kSamples = 21;
  for (int i = 0; i < kSamples; ++i) {
    motion.calc((0.2 + 0.01 * i) * pattern.period, q, u, udot);
    state.setPose(q);
    height += calcSoleHeight(subject, state) / kSamples;
  }
  pattern.pelvis_height = -height;
  return pattern;
}

Eigen::VectorXd makeStandingPose(const Model& subject) {
  Eigen::VectorXd q = subject.defaultPose();
  for (const char* side : {"_r", "_l"}) {
    q[subject.getCoordinate(std::string("arm_add") + side).value()] = kStandingArmAdduction;
    q[subject.getCoordinate(std::string("hip_adduction") + side).value()] = kStandingHipAdduction;
  }
  ModelState state(subject);
  state.setPose(q);
  q[subject.getCoordinate("pelvis_ty").value()] -= calcSoleHeight(subject, state);
  return q;
}

MarkerTrajectories makeTrajectories(std::vector<std::string> names,
                                    std::vector<double> time,
                                    double rate) {
  MarkerTrajectories markers;
  markers.names = std::move(names);
  markers.rate = rate;
  markers.time = std::move(time);
  markers.positions.resize(markers.frameCount(), Eigen::Index{3} * markers.markerCount());
  return markers;
}

// Writes one frame: marker positions at the pose of `state`, plus noise.
void recordFrame(
    const ModelState& state, int frame, double sigma, Noise& noise, MarkerTrajectories& markers) {
  const Model& model = state.model();
  for (int i = 0; i < markers.markerCount(); ++i) {
    const std::string& name = markers.names[static_cast<std::size_t>(i)];
    const int index = model.spec().findMarker(name);
    require(index >= 0, ErrorCode::kModelReference, "the model has no marker '" + name + "'");
    const MarkerSpec& marker = model.spec().markers[static_cast<std::size_t>(index)];
    const Eigen::Vector3d p_GM = state.pose(model.getBody(marker.body)) * marker.location;
    for (int axis = 0; axis < 3; ++axis) {
      markers.positions(frame, 3 * i + axis) = p_GM[axis] + sigma * noise.draw();
    }
  }
}

void recordStanding(const Model& subject,
                    const SampleOptions& options,
                    Noise& noise,
                    SampleTrial& trial) {
  std::vector<std::string> names;
  for (const MarkerSpec& marker : subject.spec().markers) {
    names.push_back(marker.name);
  }
  trial.static_markers = makeTrajectories(
      names, makeTimes(options.static_duration, options.marker_rate), options.marker_rate);
  const Eigen::VectorXd q = makeStandingPose(subject);
  trial.static_coordinates = makeTimeSeries("standing pose", subject.coordinateNames(), {0.0});
  trial.static_coordinates.values.row(0) = q.transpose();
  ModelState state(subject);
  state.setPose(q);
  for (int frame = 0; frame < trial.static_markers.frameCount(); ++frame) {
    recordFrame(state, frame, options.marker_noise, noise, trial.static_markers);
  }
}

BodyWrench makeWrench(BodyIndex body, const FootLoad& load) {
  BodyWrench wrench;
  wrench.body = body;
  wrench.wrench.head<3>() = load.point.cross(load.force) + load.torque;
  wrench.wrench.tail<3>() = load.force;
  return wrench;
}

// Markers and the truth behind them, frame by frame.
void recordWalking(const GaitMotion& motion,
                   const SampleOptions& options,
                   const std::vector<double>& time,
                   Noise& noise,
                   SampleTrial& trial) {
  const Model& subject = motion.model();
  trial.markers = makeTrajectories(options.tracked_markers, time, options.marker_rate);
  trial.coordinates = makeTimeSeries("true coordinates", subject.coordinateNames(), time);
  std::vector<std::string> labels;
  for (int c = 0; c < subject.coordinateCount(); ++c) {
    const bool is_rotational = subject.motionKind(CoordinateIndex(c)) == MotionKind::kRotational;
    const auto index = static_cast<std::size_t>(c);
    labels.push_back(subject.coordinateNames()[index] + (is_rotational ? "_moment" : "_force"));
    trial.coordinates.units.push_back(
        subject.motionKind(CoordinateIndex(c)) == MotionKind::kTranslational ? "m" : "rad");
    trial.moments.units.push_back(is_rotational ? "N.m" : "N");
  }
  const std::vector<std::string> units = trial.moments.units;
  trial.moments = makeTimeSeries("true moments", labels, time);
  trial.moments.units = units;

  ModelState state(subject);
  FootLoadDistribution distribution(motion);
  const BodyIndex right = subject.getBody("calcn_r");
  const BodyIndex left = subject.getBody("calcn_l");
  Eigen::VectorXd q(subject.coordinateCount()), u(q.size()), udot(q.size()), tau(q.size());
  for (int frame = 0; frame < trial.markers.frameCount(); ++frame) {
    const double t = time[static_cast<std::size_t>(frame)] - options.margin;
    const FootLoads loads = distribution.calc(t);
    motion.calc(t, q, u, udot);
    state.setMotion(q, u);
    state.calcInverseDynamics(
        udot, {makeWrench(right, loads.right), makeWrench(left, loads.left)}, tau);
    recordFrame(state, frame, options.marker_noise, noise, trial.markers);
    trial.coordinates.values.row(frame) = q.transpose();
    trial.moments.values.row(frame) = tau.transpose();
  }
}

void recordForces(const GaitMotion& motion,
                  double margin,
                  const std::vector<double>& time,
                  SampleTrial& trial) {
  const auto count = static_cast<Eigen::Index>(time.size());
  const ExternalForce empty{
      "", "", Eigen::Matrix3Xd(3, count), Eigen::Matrix3Xd(3, count), Eigen::Matrix3Xd(3, count)};
  trial.ground_reaction.time = time;
  trial.ground_reaction.forces = {empty, empty};
  ExternalForce& right = trial.ground_reaction.forces[0];
  ExternalForce& left = trial.ground_reaction.forces[1];
  right.name = "ground_force_r";
  right.body = "calcn_r";
  left.name = "ground_force_l";
  left.body = "calcn_l";
  FootLoadDistribution distribution(motion);
  for (Eigen::Index i = 0; i < count; ++i) {
    const FootLoads loads = distribution.calc(time[static_cast<std::size_t>(i)] - margin);
    right.force.col(i) = loads.right.force;
    right.point.col(i) = loads.right.point;
    right.torque.col(i) = loads.right.torque;
    left.force.col(i) = loads.left.force;
    left.point.col(i) = loads.left.point;
    left.torque.col(i) = loads.left.torque;
  }
}

}  // namespace

std::vector<std::string> SampleOptions::defaultTrackedMarkers() {
  std::vector<std::string> names = {"CLAV", "C7"};
  for (const char* side : {"R", "L"}) {
    for (const char* marker :
         {"ACR", "UA1", "UA2", "UA3", "LEL", "MEL", "FAsuperior", "FAradius", "FAulna", "ASI",
          "PSI", "TH1", "TH2", "TH3", "TB1", "TB2", "TB3",        "CAL",      "TOE",    "MT5"}) {
      names.push_back(std::string(side) + marker);
    }
  }
  return names;
}

SampleTrial generateSampleTrial(const Model& subject, const SampleOptions& options) {
  GaitMotion motion(subject, makePattern(subject));
  SampleTrial trial;
  trial.balance = balanceGait(motion);

  const double period = motion.pattern().period;
  const double duration = 2.0 * options.margin + options.cycles * period;
  const std::vector<double> force_time = makeTimes(duration, options.force_rate);
  for (int cycle = 0; cycle <= options.cycles; ++cycle) {
    trial.right_strikes.push_back(options.margin + cycle * period);
  }
  Noise noise(options.seed);
  recordStanding(subject, options, noise, trial);
  recordWalking(motion, options, makeTimes(duration, options.marker_rate), noise, trial);
  recordForces(motion, options.margin, force_time, trial);

  std::vector<double> since_strike;
  since_strike.reserve(force_time.size());
  for (const double t : force_time) {
    since_strike.push_back(t - options.margin);
  }
  trial.emg = makeEmgEnvelopes(since_strike, period);
  trial.emg.time = force_time;
  return trial;
}

}  // namespace gaitmill
