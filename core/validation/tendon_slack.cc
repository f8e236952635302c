#include "core/validation/tendon_slack.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/base/where.h"
#include "core/validation/posed_muscles.h"

namespace gaitmill {

namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
constexpr double kCalibrationActivation = 0.01;  ///< Rajagopal et al. 2016
constexpr int kMaxSteps = 100;
constexpr double kRoundOff = 4e-16;

// Both legs alike. Coordinates without side; the model has at least one of them.
std::vector<CoordinateValue> makeCalibrationPose(const ModelSpec& model) {
  const std::vector<CoordinateValue> leg = {{"hip_flexion", toRadians(7)},
                                            {"hip_adduction", toRadians(-2)},
                                            {"knee_angle", 0},
                                            {"ankle_angle", toRadians(-20)}};
  std::vector<CoordinateValue> pose;
  for (const char* side : {"_r", "_l"}) {
    for (const CoordinateValue& at : leg) {
      if (model.findCoordinate(at.coordinate + side) != nullptr) {
        pose.push_back({at.coordinate + side, at.value});
      }
    }
  }
  require(!pose.empty(),
          ErrorCode::kInputCoordinates,
          "the model has no leg to calibrate: no hip_flexion_r, hip_adduction_r, knee_angle_r, "
          "ankle_angle_r, nor those of the left side");
  return pose;
}

bool isMeant(const FiberTarget& target, const std::string& muscle) {
  return muscle == target.muscle || muscle == target.muscle + "_r" ||
         muscle == target.muscle + "_l";
}

Where findPlace(const FiberTarget& target) {
  Where where = atMuscle(target.muscle);
  where.line = target.line;
  return where;
}

// The one target of each muscle, null = none.
std::vector<const FiberTarget*> assignTargets(const ModelSpec& model,
                                              const std::vector<FiberTarget>& targets) {
  std::vector<const FiberTarget*> assigned(model.muscles.size(), nullptr);
  for (const FiberTarget& target : targets) {
    bool found = false;
    for (std::size_t m = 0; m < model.muscles.size(); ++m) {
      if (isMeant(target, model.muscles[m].name)) {
        require(assigned[m] == nullptr,
                ErrorCode::kInputValue,
                "muscle '" + model.muscles[m].name + "' has two target fiber lengths",
                findPlace(target));
        assigned[m] = &target;
        found = true;
      }
    }
    require(found,
            ErrorCode::kInputValue,
            "the model has no muscle '" + target.muscle + "'",
            findPlace(target));
  }
  return assigned;
}

SlackCalibration calibrate(const MuscleSpec& spec,
                           const PosedMuscles& posed,
                           MuscleIndex m,
                           const FiberTarget* target) {
  SlackCalibration row;
  row.muscle = spec.name;
  row.tendon = spec.tendon;
  row.path_length = posed.findLength(m);
  row.is_given = target != nullptr;
  row.present_slack_length = spec.tendon_slack_length;
  row.slack_length = spec.tendon_slack_length;
  if (target == nullptr) {
    row.norm_fiber_length =
        posed.calcForce(m, kCalibrationActivation).fiber_length / spec.optimal_fiber_length;
    return row;
  }
  row.norm_fiber_length = std::isfinite(target->norm_fiber_length)
                              ? target->norm_fiber_length
                              : target->fiber_length / spec.optimal_fiber_length;
  row.slack_length = calcTendonSlack({row.path_length,
                                      spec.optimal_fiber_length,
                                      row.norm_fiber_length,
                                      spec.pennation_at_optimal,
                                      spec.tendon},
                                     posed.muscle(m));
  require(row.slack_length > 0,
          ErrorCode::kInputValue,
          "muscle '" + spec.name + "' cannot have a fiber of " +
              std::to_string(row.norm_fiber_length) + " optimal lengths on a path of " +
              std::to_string(row.path_length) +
              " m: nothing is left for the tendon, or the fiber "
              "is shorter than its pennation allows",
          findPlace(*target));
  return row;
}

}  // namespace

double solveTendonStretch(const Muscle& muscle, double force) noexcept {
  double low = 1;
  double high = muscle.tendonLineStart();
  const CurvePoint end = muscle.calcTendonForceLength(high);
  if (!(force > 0)) {
    return low;
  }
  if (force >= end.value) {
    return high + (force - end.value) / end.slope;
  }
  // Newton steps inside a bracket, from where a parabola through the toe has this force.
  double x = low + (high - low) * std::sqrt(force / end.value);
  for (int step = 0; step < kMaxSteps; ++step) {
    const CurvePoint at = muscle.calcTendonForceLength(x);
    const double error = at.value - force;
    (error > 0 ? high : low) = x;
    double next = x - error / at.slope;
    if (!(next > low && next < high)) {
      next = 0.5 * (low + high);
    }
    const double change = std::abs(next - x);
    x = next;
    if (change <= kRoundOff) {
      break;
    }
  }
  return x;
}

double calcTendonSlack(const SlackInput& input, const Muscle& muscle) noexcept {
  const double l = input.norm_fiber_length;
  const double sin = std::sin(input.pennation_at_optimal) / l;
  if (!(l > 0 && std::abs(sin) < 1 && input.optimal_fiber_length > 0)) {
    return kUndefined;
  }
  const double cos = std::sqrt((1 - sin) * (1 + sin));
  const double tendon_length = input.path_length - l * input.optimal_fiber_length * cos;
  if (input.tendon == TendonKind::kRigid) {
    return tendon_length;
  }
  const double force = (kCalibrationActivation * muscle.calcActiveForceLength(l).value +
                        muscle.calcPassiveForceLength(l).value) *
                       cos;
  return tendon_length / solveTendonStretch(muscle, force);
}

std::vector<SlackCalibration> calibrateTendonSlack(const ModelSpec& model,
                                                   const std::vector<FiberTarget>& targets) {
  const std::vector<CoordinateValue> pose = makeCalibrationPose(model);
  const std::vector<const FiberTarget*> assigned = assignTargets(model, targets);
  PosedMuscles posed(model);
  posed.setPose(pose);
  std::vector<SlackCalibration> rows;
  for (std::size_t m = 0; m < model.muscles.size(); ++m) {
    rows.push_back(
        calibrate(model.muscles[m], posed, MuscleIndex(static_cast<int>(m)), assigned[m]));
  }
  return rows;
}

ModelSpec applyCalibration(ModelSpec model, const std::vector<SlackCalibration>& calibration) {
  for (const SlackCalibration& row : calibration) {
    const int m = model.findMuscle(row.muscle);
    if (row.is_given && m >= 0) {
      model.muscles[static_cast<std::size_t>(m)].tendon_slack_length = row.slack_length;
    }
  }
  return model;
}

}  // namespace gaitmill
