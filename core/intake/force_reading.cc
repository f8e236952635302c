#include "core/intake/force_reading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"

namespace gaitmill {

namespace {

using Matrix3d = Eigen::Matrix3d;
using Vector3d = Eigen::Vector3d;

constexpr double kSurelyLoaded = 0.3;  // of a plate's peak
constexpr double kLeastLoad = 20;      // [N]
constexpr double kClearRatio = 1.5;    // of the vertical over the next component
constexpr int kSamples = 400;          // loaded rows that are looked at
// The sole reaches some 0.15 m beyond its markers; the other foot is a step away.
constexpr double kUnderFoot = 0.3;      // [m] where the usual reading is believed
constexpr double kSurelyUnder = 0.15;   // [m] where another one is
constexpr double kLargestPoint = 50;    // [m] laboratories are shorter
constexpr double kLargestTorque = 100;  // [N.m] free torques in gait stay below 60
constexpr double kLeastTorque = 0.02;   // [N.m] and are not smaller in a real recording

/// A row of one force in which its plate surely carries somebody.
struct Loaded {
  std::size_t force;
  Eigen::Index row;
};

std::vector<Loaded> findLoadedRows(const GroundReaction& reaction) {
  std::vector<Loaded> loaded;
  for (std::size_t i = 0; i < reaction.forces.size(); ++i) {
    const Eigen::VectorXd size = reaction.forces[i].force.colwise().norm();
    double peak = 0;
    for (const double one : size) {
      peak = std::isfinite(one) ? std::max(peak, one) : peak;
    }
    for (Eigen::Index row = 0; row < size.size(); ++row) {
      if (size[row] > kSurelyLoaded * peak && size[row] > kLeastLoad) {
        loaded.push_back({i, row});
      }
    }
  }
  const std::size_t stride = std::max<std::size_t>(1, loaded.size() / kSamples);
  std::vector<Loaded> thinned;
  for (std::size_t i = 0; i < loaded.size(); i += stride) {
    thinned.push_back(loaded[i]);
  }
  return thinned;
}

/// Mean direction of the loaded forces, longer components first kept as they are.
Vector3d calcMeanDirection(const GroundReaction& reaction, const std::vector<Loaded>& loaded) {
  Vector3d sum = Vector3d::Zero();
  double size = 0;
  for (const Loaded& one : loaded) {
    const Vector3d force = reaction.forces[one.force].force.col(one.row);
    sum += force;
    size += force.norm();
  }
  return size > 0 ? Vector3d(sum / size) : Vector3d::Zero();
}

/// A quarter turn about ground's vertical, k times.
Matrix3d makeQuarterTurn(int k) {
  static const std::array<std::array<double, 2>, 4> kTurns = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  const auto [cos, sin] = kTurns.at(static_cast<std::size_t>(k));
  Matrix3d R;
  R << cos, 0, sin, 0, 1, 0, -sin, 0, cos;
  return R;
}

double findMedian(std::vector<double> values) {
  if (values.empty()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

class ForceReader {
 public:
  ForceReader(const MarkerTrajectories& markers,
              const BodyMarkers& body,
              const LaboratoryFrame* frame,
              const ForceReadingOptions& options,
              GroundReaction& reaction,
              Decisions& decisions,
              std::vector<std::string>& warnings)
      : markers_(markers),
        frame_(frame),
        options_(options),
        reaction_(reaction),
        decisions_(decisions),
        warnings_(warnings),
        feet_(body.right_foot),
        loaded_(findLoadedRows(reaction)) {
    feet_.insert(feet_.end(), body.left_foot.begin(), body.left_foot.end());
  }

  void decide() {
    if (loaded_.empty()) {
      return;  // the stages say that no plate is ever loaded
    }
    const Matrix3d turn = decideAxes();
    decideDirection(turn);
    decidePlace(turn);
    decideTorques();
  }

 private:
  void note(const char* topic,
            const std::string& value,
            Decision::Origin origin,
            double confidence,
            const std::string& evidence) {
    decisions_.push_back(
        {"grf", topic, std::string("trial.") + topic, value, origin, confidence, evidence});
  }

  Matrix3d decideAxes();
  Matrix3d turnFor(const SignedAxis& vertical) const;
  void decideDirection(const Matrix3d& turn);
  void decidePlace(const Matrix3d& turn);
  void decidePlaceByFeet(const Matrix3d& turn);
  void decideTorques();
  double calcFootDistance(const Matrix3d& turn, double metres) const;
  void apply(const Matrix3d& turn, double metres, double newton_metres);

  const MarkerTrajectories& markers_;
  const LaboratoryFrame* frame_;
  const ForceReadingOptions& options_;
  GroundReaction& reaction_;
  Decisions& decisions_;
  std::vector<std::string>& warnings_;
  std::vector<int> feet_;
  std::vector<Loaded> loaded_;
  double metres_ = 1;
};

Matrix3d ForceReader::turnFor(const SignedAxis& vertical) const {
  if (options_.forward) {
    require(options_.forward->axis != vertical.axis,
            ErrorCode::kSettingsValue,
            "the forward axis of the forces is their vertical one",
            {{}, 0, 0, "trial.force_forward_axis"});
    return makeTurn(options_.forward->direction(), vertical.direction());
  }
  if (frame_ != nullptr && frame_->vertical.axis == vertical.axis &&
      frame_->vertical.sign == vertical.sign) {
    return frame_->R;
  }
  return makeTurn(SignedAxis{vertical.axis == 0 ? 2 : 0, 1}.direction(), vertical.direction());
}

Matrix3d ForceReader::decideAxes() {
  if (options_.vertical) {
    note("force_vertical_axis",
         options_.vertical->name(),
         Decision::Origin::kSet,
         1,
         "the settings say so");
    return turnFor(*options_.vertical);
  }
  const Vector3d mean = calcMeanDirection(reaction_, loaded_);
  SignedAxis axis;
  mean.cwiseAbs().maxCoeff(&axis.axis);
  Vector3d rest = mean;
  rest[axis.axis] = 0;
  SignedAxis second;
  rest.cwiseAbs().maxCoeff(&second.axis);
  const double ratio = std::abs(mean[axis.axis]) / std::max(1e-9, std::abs(rest[second.axis]));
  const std::string evidence = "the loaded force lies along (" + formatFixed(mean.x(), 2) + ", " +
                               formatFixed(mean.y(), 2) + ", " + formatFixed(mean.z(), 2) + ")";
  require(ratio >= kClearRatio,
          ErrorCode::kInputAmbiguous,
          evidence + ": its vertical may be " + axis.name() + " or " + second.name() +
              ". State trial.force_vertical_axis",
          {{}, 0, 0, "trial.force_vertical_axis"});
  // Which end of the axis is up, the markers know; forces may as well act on the plate.
  if (frame_ != nullptr && frame_->vertical.axis == axis.axis) {
    axis.sign = frame_->vertical.sign;
  }
  note("force_vertical_axis", axis.name(), Decision::Origin::kDetected, 1 - 1 / ratio, evidence);
  return turnFor(axis);
}

void ForceReader::decideDirection(const Matrix3d& turn) {
  const double vertical = (turn * calcMeanDirection(reaction_, loaded_)).y();
  const bool is_on_subject = options_.on_subject.value_or(vertical > 0);
  note("force_direction",
       is_on_subject ? "on_subject" : "on_plate",
       options_.on_subject ? Decision::Origin::kSet : Decision::Origin::kDetected,
       std::abs(vertical),
       std::string("the loaded force points ") + (vertical > 0 ? "up" : "down"));
  if (!is_on_subject) {
    for (ExternalForce& force : reaction_.forces) {
      force.force = -force.force;
      force.torque = -force.torque;
    }
  }
}

/// Median horizontal distance from the centre of pressure to the nearest foot marker [m]; NaN
/// without markers.
double ForceReader::calcFootDistance(const Matrix3d& turn, double metres) const {
  std::vector<double> distances;
  for (const Loaded& one : loaded_) {
    const double time = reaction_.time[static_cast<std::size_t>(one.row)];
    const auto above = std::lower_bound(markers_.time.begin(), markers_.time.end(), time);
    if (above == markers_.time.end() || time < markers_.time.front()) {
      continue;
    }
    const auto frame = static_cast<int>(above - markers_.time.begin());
    const Vector3d point = metres * (turn * reaction_.forces[one.force].point.col(one.row));
    double nearest = std::numeric_limits<double>::infinity();
    for (const int marker : feet_) {
      if (!markers_.isMissing(frame, marker)) {
        const Vector3d offset = markers_.position(frame, marker) - point;
        nearest = std::min(nearest, std::hypot(offset.x(), offset.z()));
      }
    }
    if (std::isfinite(nearest)) {
      distances.push_back(nearest);
    }
  }
  return findMedian(std::move(distances));
}

void ForceReader::apply(const Matrix3d& turn, double metres, double newton_metres) {
  if (turn.isIdentity(0.0) && metres == 1 && newton_metres == 1) {
    return;
  }
  for (ExternalForce& force : reaction_.forces) {
    force.force = turn * force.force;
    force.point = metres * (turn * force.point);
    force.torque = newton_metres * (turn * force.torque);
  }
}

std::string nameLength(double metres) {
  return metres == 1 ? "m" : metres == 0.01 ? "cm" : "mm";
}

void ForceReader::decidePlaceByFeet(const Matrix3d& turn) {
  const double usual = calcFootDistance(turn, 1);
  std::string evidence =
      "the centre of pressure lies " + formatFixed(usual, 3) + " m from the nearest foot marker";
  if (usual <= kUnderFoot) {
    note("force_point_units",
         "m",
         Decision::Origin::kDetected,
         1 - usual / kUnderFoot / 2,
         evidence);
    apply(turn, 1, 1);
    return;
  }
  struct Reading {
    int quarters;
    double metres;
    double distance;
  };
  std::vector<Reading> readings;
  for (const double metres : {1.0, 0.01, 0.001}) {
    for (int quarters = 0; quarters < 4; ++quarters) {
      readings.push_back(
          {quarters, metres, calcFootDistance(makeQuarterTurn(quarters) * turn, metres)});
    }
  }
  std::stable_sort(readings.begin(), readings.end(), [](const Reading& a, const Reading& b) {
    return a.distance < b.distance;
  });
  const Reading& best = readings[0];
  const auto describe = [](const Reading& reading) {
    return nameLength(reading.metres) + " turned by " + std::to_string(90 * reading.quarters) +
           " degrees about the vertical (" + formatFixed(reading.distance, 3) + " m)";
  };
  if (best.distance > kSurelyUnder) {
    warnings_.push_back(evidence +
                        ", and no unit and no turn of the force file mends that; the "
                        "forces may be of another recording or laboratory");
    note("force_point_units", "m", Decision::Origin::kAssumed, 0.1, evidence);
    apply(turn, 1, 1);
    return;
  }
  evidence += " as it stands; read in " + describe(best);
  require(readings[1].distance > kUnderFoot || options_.metres_per_unit.has_value(),
          ErrorCode::kInputAmbiguous,
          evidence + " or in " + describe(readings[1]) +
              " it fits. State trial.force_point_units or trial.force_forward_axis",
          {{}, 0, 0, "trial.force_point_units"});
  metres_ = best.metres;
  note("force_point_units", nameLength(best.metres), Decision::Origin::kDetected, 0.9, evidence);
  if (best.quarters != 0) {
    warnings_.push_back("the forces are turned against the markers: " + evidence);
  }
  apply(makeQuarterTurn(best.quarters) * turn, best.metres, 1);
}

void ForceReader::decidePlace(const Matrix3d& turn) {
  if (options_.metres_per_unit) {
    metres_ = *options_.metres_per_unit;
    note(
        "force_point_units", nameLength(metres_), Decision::Origin::kSet, 1, "the settings say so");
    apply(turn, metres_, 1);
    return;
  }
  if (std::isfinite(calcFootDistance(turn, 1))) {
    decidePlaceByFeet(turn);
    return;
  }
  std::vector<double> sizes;
  for (const Loaded& one : loaded_) {
    const double size = reaction_.forces[one.force].point.col(one.row).norm();
    if (std::isfinite(size)) {
      sizes.push_back(size);
    }
  }
  const double median = findMedian(std::move(sizes));
  metres_ = median > kLargestPoint ? 0.001 : 1.0;
  note("force_point_units",
       nameLength(metres_),
       Decision::Origin::kDetected,
       0.7,
       "loaded centres of pressure lie around " + formatFixed(median, 2) +
           " from the origin; a laboratory is shorter than 50 m");
  apply(turn, metres_, 1);
}

void ForceReader::decideTorques() {
  if (options_.moment_factor) {
    note("force_moment_units",
         *options_.moment_factor == 1 ? "N.m" : "N.mm",
         Decision::Origin::kSet,
         1,
         "the settings say so");
    apply(Matrix3d::Identity(), 1, *options_.moment_factor);
    return;
  }
  std::vector<double> twists;
  for (const Loaded& one : loaded_) {
    const double twist = std::abs(reaction_.forces[one.force].torque(1, one.row));
    if (std::isfinite(twist)) {
      twists.push_back(twist);
    }
  }
  const double median = findMedian(std::move(twists));
  const std::string evidence =
      "free torques on loaded plates are around " + formatFixed(median, 3) + " as they stand";
  const bool fits = median <= kLargestTorque;
  const bool fits_thousandth = median * 0.001 >= kLeastTorque;
  require(!(fits && fits_thousandth && metres_ == 0.001),
          ErrorCode::kInputAmbiguous,
          evidence +
              ", which may be N.m or, as the points are in mm, N.mm. State "
              "trial.force_moment_units",
          {{}, 0, 0, "trial.force_moment_units"});
  const double factor = fits ? 1.0 : 0.001;
  note("force_moment_units",
       fits ? "N.m" : "N.mm",
       Decision::Origin::kDetected,
       fits && fits_thousandth ? 0.6 : 0.95,
       evidence);
  apply(Matrix3d::Identity(), 1, factor);
}

}  // namespace

void decideForces(const MarkerTrajectories& markers,
                  const BodyMarkers& body,
                  const LaboratoryFrame* frame,
                  const ForceReadingOptions& options,
                  GroundReaction& reaction,
                  Decisions& decisions,
                  std::vector<std::string>& warnings) {
  ForceReader(markers, body, frame, options, reaction, decisions, warnings).decide();
}

}  // namespace gaitmill
