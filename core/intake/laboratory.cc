#include "core/intake/laboratory.h"

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

using Vector3d = Eigen::Vector3d;

constexpr int kFramesLookedAt = 300;  // more tell nothing new
// Standing upright, the body is above its feet by several times what it is beside them.
constexpr double kClearRatio = 1.5;
constexpr double kTravel = 0.5;      // [m] beyond it the path tells the direction
constexpr double kSnapAngle = 20;    // [deg]
constexpr double kClearSwing = 0.2;  // correlation of the feet's height and forward speed
// From ankles to hips of a child, to a tall adult's raised arms [m].
constexpr double kLeastExtent = 0.35;
constexpr double kLargestExtent = 2.6;
constexpr std::size_t kLeastMarkers = 5;

/// Mean of the markers that are seen; NaN if none is.
Vector3d calcCentroid(const MarkerTrajectories& markers, int frame, const std::vector<int>& which) {
  Vector3d sum = Vector3d::Zero();
  int count = 0;
  for (const int marker : which) {
    if (!markers.isMissing(frame, marker)) {
      sum += markers.position(frame, marker);
      ++count;
    }
  }
  return count == 0 ? Vector3d::Constant(std::numeric_limits<double>::quiet_NaN())
                    : Vector3d(sum / count);
}

std::vector<int> joinFeet(const BodyMarkers& body) {
  std::vector<int> feet = body.right_foot;
  feet.insert(feet.end(), body.left_foot.begin(), body.left_foot.end());
  return feet;
}

int findStride(const MarkerTrajectories& markers) {
  return std::max(1, markers.frameCount() / kFramesLookedAt);
}

/// From the feet to the others, mean over the frames; zero if it cannot be told.
Vector3d calcBodyOffset(const MarkerTrajectories& markers, const BodyMarkers& body) {
  const std::vector<int> feet = joinFeet(body);
  Vector3d sum = Vector3d::Zero();
  int count = 0;
  for (int frame = 0; frame < markers.frameCount(); frame += findStride(markers)) {
    const Vector3d offset =
        calcCentroid(markers, frame, body.others) - calcCentroid(markers, frame, feet);
    if (offset.allFinite()) {
      sum += offset;
      ++count;
    }
  }
  return count == 0 ? Vector3d::Zero() : Vector3d(sum / count);
}

SignedAxis findLargestAxis(const Vector3d& v) {
  SignedAxis axis;
  v.cwiseAbs().maxCoeff(&axis.axis);
  axis.sign = v[axis.axis] < 0 ? -1 : 1;
  return axis;
}

std::string describeOffset(const Vector3d& offset) {
  return "the body is (" + formatFixed(offset.x(), 2) + ", " + formatFixed(offset.y(), 2) + ", " +
         formatFixed(offset.z(), 2) + ") m from the feet";
}

Decision makeAxisDecision(const char* topic, const SignedAxis& axis, Decision::Origin origin) {
  Decision decision;
  decision.topic = topic;
  decision.field = std::string("trial.") + topic;
  decision.value = axis.name();
  decision.origin = origin;
  return decision;
}

/// Net way of the body over the recording, without its vertical part.
Vector3d calcTravel(const MarkerTrajectories& markers,
                    const BodyMarkers& body,
                    const Vector3d& up) {
  Vector3d first = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  Vector3d last = first;
  for (int frame = 0; frame < markers.frameCount(); ++frame) {
    const Vector3d centre = calcCentroid(markers, frame, body.others);
    if (!centre.allFinite()) {
      continue;
    }
    if (!first.allFinite()) {
      first = centre;
    }
    last = centre;
  }
  const Vector3d way = last - first;
  return way.allFinite() ? Vector3d(way - way.dot(up) * up) : Vector3d::Zero();
}

/// Covariance of a foot's height and its horizontal velocity against the body, both feet, over the
/// product of their deviations: the way in which feet swing, length 0..1.
class SwingDirection {
 public:
  SwingDirection(const MarkerTrajectories& markers, const BodyMarkers& body, const Vector3d& up)
      : markers_(markers), others_(body.others), up_(up) {
    add(body.right_foot);
    add(body.left_foot);
  }
  Vector3d calc() const { return scale_ > 0 ? Vector3d(sum_ / scale_) : Vector3d::Zero(); }

 private:
  void add(const std::vector<int>& foot) {
    std::vector<double> heights;
    std::vector<Vector3d> steps;
    Vector3d before = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    for (int frame = 0; frame < markers_.frameCount(); ++frame) {
      const Vector3d relative =
          calcCentroid(markers_, frame, foot) - calcCentroid(markers_, frame, others_);
      const Vector3d step = relative - before;
      before = relative;
      if (step.allFinite()) {
        heights.push_back(relative.dot(up_));
        steps.emplace_back(step - step.dot(up_) * up_);
      }
    }
    correlate(heights, steps);
  }
  void correlate(const std::vector<double>& heights, const std::vector<Vector3d>& steps) {
    double mean = 0;
    for (const double height : heights) {
      mean += height / static_cast<double>(heights.size());
    }
    double height_power = 0;
    double step_power = 0;
    for (std::size_t i = 0; i < heights.size(); ++i) {
      sum_ += (heights[i] - mean) * steps[i];
      height_power += (heights[i] - mean) * (heights[i] - mean);
      step_power += steps[i].squaredNorm();
    }
    scale_ += std::sqrt(height_power * step_power);
  }

  const MarkerTrajectories& markers_;
  const std::vector<int>& others_;
  Vector3d up_;
  Vector3d sum_ = Vector3d::Zero();
  double scale_ = 0;
};

double calcAngle(const Vector3d& a, const Vector3d& b) {
  return std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0)) * 180 / kPi;
}

/// The axis if the direction is near one, else the direction itself.
Vector3d snap(const Vector3d& direction, Decision& decision) {
  const SignedAxis axis = findLargestAxis(direction);
  const double angle = calcAngle(direction, axis.direction());
  if (angle <= kSnapAngle) {
    decision.value = axis.name();
    return axis.direction();
  }
  decision.value = formatFixed(angle, 1) + " deg off " + axis.name();
  return direction.normalized();
}

/// The horizontal axis that is forward where the usual one is vertical: x, or z if x is up.
SignedAxis findUsualForward(const SignedAxis& vertical) {
  return {vertical.axis == 0 ? 2 : 0, 1};
}

Vector3d decideForward(const MarkerTrajectories& markers,
                       const BodyMarkers& body,
                       const LaboratoryOptions& options,
                       const SignedAxis& vertical,
                       Decisions& decisions) {
  Decision decision =
      makeAxisDecision("forward_axis", findUsualForward(vertical), Decision::Origin::kAssumed);
  Vector3d forward = findUsualForward(vertical).direction();
  if (options.forward) {
    require(options.forward->axis != vertical.axis,
            ErrorCode::kSettingsValue,
            "the forward axis is the vertical one",
            {{}, 0, 0, "trial.forward_axis"});
    decision = makeAxisDecision("forward_axis", *options.forward, Decision::Origin::kSet);
    forward = options.forward->direction();
    decision.evidence = "the settings say so";
    decisions.push_back(decision);
    return forward;
  }
  const Vector3d travel = calcTravel(markers, body, vertical.direction());
  const Vector3d swing = SwingDirection(markers, body, vertical.direction()).calc();
  const bool travels = travel.norm() >= kTravel;
  const bool swings = swing.norm() >= kClearSwing;
  decision.evidence = "the body travels " + formatFixed(travel.norm(), 2) +
                      " m; height and forward speed of the feet correlate by " +
                      formatFixed(swing.norm(), 2);
  if (travels && swings && calcAngle(travel, swing) > 60) {
    throw Error(ErrorCode::kInputAmbiguous,
                "the subject travels along " + findLargestAxis(travel).name() +
                    " but its feet swing along " + findLargestAxis(swing).name() +
                    ": backward walking, or swapped axes? State trial.forward_axis",
                {{}, 0, 0, "trial.forward_axis"});
  }
  if (travels || swings) {
    decision.origin = Decision::Origin::kDetected;
    decision.confidence = travels ? 1.0 : std::min(1.0, 2 * swing.norm());
    forward = snap(travels ? travel : swing, decision);
  } else {
    decision.confidence = 0.3;
  }
  decisions.push_back(decision);
  return forward;
}

double calcExtent(const MarkerTrajectories& markers) {
  std::vector<double> extents;
  for (int frame = 0; frame < markers.frameCount(); frame += findStride(markers)) {
    Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity());
    Vector3d high = -low;
    for (int marker = 0; marker < markers.markerCount(); ++marker) {
      if (!markers.isMissing(frame, marker)) {
        low = low.cwiseMin(markers.position(frame, marker));
        high = high.cwiseMax(markers.position(frame, marker));
      }
    }
    if ((high - low).allFinite()) {
      extents.push_back((high - low).maxCoeff());
    }
  }
  if (extents.empty()) {
    return 0;
  }
  std::nth_element(extents.begin(),
                   extents.begin() + static_cast<std::ptrdiff_t>(extents.size() / 2),
                   extents.end());
  return extents[extents.size() / 2];
}

bool isHuman(double extent) {
  return extent >= kLeastExtent && extent <= kLargestExtent;
}

}  // namespace

std::string SignedAxis::name() const {
  static constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
  return (sign < 0 ? "-" : "") + std::string(kNames.at(static_cast<std::size_t>(axis)));
}

Eigen::Matrix3d makeTurn(const Vector3d& forward, const Vector3d& up) {
  Eigen::Matrix3d R;
  R.row(0) = forward.transpose();
  R.row(1) = up.transpose();
  R.row(2) = forward.cross(up).transpose();
  return R;
}

SignedAxis decideVertical(const MarkerTrajectories& markers,
                          const BodyMarkers& body,
                          const LaboratoryOptions& options,
                          SignedAxis usual,
                          Decisions& decisions) {
  if (options.vertical) {
    decisions.push_back(
        makeAxisDecision("vertical_axis", *options.vertical, Decision::Origin::kSet));
    decisions.back().evidence = "the settings say so";
    return *options.vertical;
  }
  const Vector3d offset = calcBodyOffset(markers, body);
  if (offset.isZero(0.0)) {
    decisions.push_back(makeAxisDecision("vertical_axis", usual, Decision::Origin::kAssumed));
    decisions.back().confidence = 0.5;
    decisions.back().evidence = "no marker is known to sit on a foot; this is the usual axis";
    return usual;
  }
  const SignedAxis axis = findLargestAxis(offset);
  Vector3d rest = offset;
  rest[axis.axis] = 0;
  const SignedAxis second = findLargestAxis(rest);
  const double ratio = std::abs(offset[axis.axis]) / std::max(1e-9, std::abs(rest[second.axis]));
  require(ratio >= kClearRatio,
          ErrorCode::kInputAmbiguous,
          describeOffset(offset) + ": up may be " + axis.name() + " or " + second.name() +
              ". State trial.vertical_axis",
          {{}, 0, 0, "trial.vertical_axis"});
  decisions.push_back(makeAxisDecision("vertical_axis", axis, Decision::Origin::kDetected));
  decisions.back().confidence = 1 - 1 / ratio;
  decisions.back().evidence = describeOffset(offset);
  return axis;
}

LaboratoryFrame decideFrame(const MarkerTrajectories& markers,
                            const BodyMarkers& body,
                            const LaboratoryOptions& options,
                            SignedAxis usual_vertical,
                            Decisions& decisions) {
  LaboratoryFrame frame;
  frame.vertical = decideVertical(markers, body, options, usual_vertical, decisions);
  frame.R = makeTurn(decideForward(markers, body, options, frame.vertical, decisions),
                     frame.vertical.direction());
  return frame;
}

double decideMarkerUnit(const MarkerTrajectories& markers,
                        const std::string& stated,
                        const LaboratoryOptions& options,
                        Decisions& decisions) {
  static const std::array<std::pair<const char*, double>, 3> kUnits = {
      {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}}};
  const auto metresOf = [](const std::string& unit) {
    const auto found = std::find_if(
        kUnits.begin(), kUnits.end(), [&](const auto& one) { return unit == one.first; });
    return found == kUnits.end() ? 1.0 : found->second;
  };
  Decision decision;
  decision.topic = "marker_units";
  decision.field = "trial.marker_units";
  decision.value = stated;
  decision.origin = Decision::Origin::kStated;
  const double extent = calcExtent(markers);
  decision.evidence = "read in " + stated + ", the markers span " + formatFixed(extent, 4) + " m";
  if (options.metres_per_unit) {
    const double factor = *options.metres_per_unit / metresOf(stated);
    for (const auto& [unit, metres] : kUnits) {
      decision.value = metres == *options.metres_per_unit ? unit : decision.value;
    }
    decision.origin = Decision::Origin::kSet;
    decisions.push_back(decision);
    return factor;
  }
  if (markers.names.size() < kLeastMarkers || extent == 0 || isHuman(extent)) {
    decisions.push_back(decision);
    return 1.0;
  }
  for (const auto& [unit, metres] : kUnits) {
    const double factor = metres / metresOf(stated);
    if (isHuman(extent * factor)) {
      decision.value = unit;
      decision.origin = Decision::Origin::kDetected;
      decision.confidence = 0.9;
      decision.evidence +=
          ", read in " + std::string(unit) + " " + formatFixed(extent * factor, 2) + " m";
      decisions.push_back(decision);
      return factor;
    }
  }
  throw Error(ErrorCode::kInputAmbiguous,
              decision.evidence +
                  "; a person spans 0.35 to 2.6 m, in no unit of m, cm and mm do "
                  "they. State trial.marker_units",
              {{}, 0, 0, "trial.marker_units"});
}

void applyFrame(const LaboratoryFrame& frame, MarkerTrajectories& markers) {
  if (frame.R.isIdentity(0.0)) {
    return;
  }
  for (int frame_index = 0; frame_index < markers.frameCount(); ++frame_index) {
    for (int marker = 0; marker < markers.markerCount(); ++marker) {
      auto cell = markers.positions.row(frame_index).segment<3>(Eigen::Index{3} * marker);
      const Vector3d turned = frame.R * cell.transpose();
      cell = turned.transpose();
    }
  }
}

}  // namespace gaitmill
