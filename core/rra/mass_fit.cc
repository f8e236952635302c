#include "core/rra/mass_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "core/math/bounded_least_squares.h"
#include "core/rra/mass_adjustment.h"
#include "core/rra/residual_statistics.h"

namespace gaitmill {
namespace {

constexpr int kMaxSteps = 5;
constexpr double kSettledMass = 1e-6;    // [kg]
constexpr double kSettledCenter = 1e-8;  // [m]
// Probes of the averages' slopes; they are straight lines, so any size does.
constexpr double kMassProbe = 0.01;    // of the mass
constexpr double kCenterProbe = 0.01;  // [m]
// One newton of residual weighs as much as a newton metre over this lever, about a leg's length.
constexpr double kLever = 1;  // [m]

// Mass change [kg], movement of the mass center along x and z [m].
using Change = Eigen::Vector3d;

// What is brought to zero: MZ, MX, FY over the lever.
Eigen::Vector3d pickAverages(const ResidualSum& sum) {
  return {sum.force.y() * kLever, sum.moment.x(), sum.moment.z()};
}

// The parts of the model that inverse dynamics with residuals needs: what muscles and markers say
// does not matter, and building them costs more than the rest.
ModelSpec makeSkeleton(ModelSpec spec) {
  spec.muscles.clear();
  spec.muscle_groups.clear();
  spec.markers.clear();
  return spec;
}

void applyChange(const Change& change, const RraOptions& options, ModelSpec& spec) {
  BodySpec& body = findAdjustedBody(options, spec);
  body.mass_center.x() += change(1);
  body.mass_center.z() += change(2);
  if (change(0) != 0) {
    setTotalMass(spec, spec.calcTotalMass() + change(0), options.inertia_scaling);
  }
}

class Fit {
 public:
  Fit(const ReferenceMotion& motion,
      const ExternalLoads& loads,
      const RraOptions& options,
      const RraPassOptions& pass,
      const ModelSpec& spec,
      const Progress& progress)
      : motion_(motion),
        loads_(loads),
        options_(options),
        pass_(pass),
        progress_(progress),
        skeleton_(makeSkeleton(spec)) {
    const double mass = options.adjust_mass ? options.max_mass_change * spec.calcTotalMass() : 0;
    const double center = options.adjust_mass_center ? options.max_mass_center_shift : 0;
    upper_ = {mass, center, center};
    lower_ = -upper_;
  }

  ResidualStatistics analyze(const ModelSpec& spec) const {
    return calcResidualStatistics(
        calcDesiredResiduals(spec, motion_, loads_, options_, pass_, progress_));
  }
  ResidualStatistics analyze() const { return analyze(skeleton_); }

  /// The next step, taken on the own model; limits count from the model as it came.
  MassAdjustment step(const ResidualStatistics& before);

 private:
  Eigen::Matrix3d calcSlopes(const Eigen::Vector3d& averages) const;

  const ReferenceMotion& motion_;
  const ExternalLoads& loads_;
  const RraOptions& options_;
  const RraPassOptions& pass_;
  const Progress& progress_;
  ModelSpec skeleton_;
  Eigen::Vector3d lower_, upper_;  // what is left of the limits
};

Eigen::Matrix3d Fit::calcSlopes(const Eigen::Vector3d& averages) const {
  const Change probes(kMassProbe * skeleton_.calcTotalMass(), kCenterProbe, kCenterProbe);
  Eigen::Matrix3d slopes;
  for (int i = 0; i < 3; ++i) {
    ModelSpec probed = skeleton_;
    applyChange(probes(i) * Change::Unit(i), options_, probed);
    slopes.col(i) = (pickAverages(analyze(probed).average) - averages) / probes(i);
  }
  return slopes;
}

MassAdjustment Fit::step(const ResidualStatistics& before) {
  MassAdjustment adjustment;
  adjustment.average_before = before.average;
  adjustment.mass_before = skeleton_.calcTotalMass();
  const Eigen::Vector3d averages = pickAverages(before.average);
  // Counted in probes, so that kilograms and metres are of a size.
  const Change unit(kMassProbe * adjustment.mass_before, kCenterProbe, kCenterProbe);
  const Eigen::Matrix3d slopes = calcSlopes(averages) * unit.asDiagonal();
  Eigen::VectorXd scaled(3);
  if (slopes.isZero(0)) {
    // A base that is held bears whatever the motion needs: forces tell nothing about the mass.
    adjustment.mass_after = adjustment.mass_before;
    adjustment.desired = before;
    adjustment.average_after = before.average;
    return adjustment;
  }
  const Eigen::VectorXd lower = lower_.cwiseQuotient(unit), upper = upper_.cwiseQuotient(unit);
  BoundedLeastSquares(3, 3).solve(slopes, -averages, lower, upper, scaled);
  const Change change = scaled.cwiseProduct(unit);
  applyChange(change, options_, skeleton_);
  const auto isLimited = [&](int i) {
    return scaled(i) == lower(i) || scaled(i) == upper(i);
  };
  lower_ -= change;
  upper_ -= change;

  adjustment.mass_change = change(0);
  adjustment.mass_after = skeleton_.calcTotalMass();
  adjustment.shift_x = -change(1);
  adjustment.shift_z = -change(2);
  adjustment.mass_limited = options_.adjust_mass && isLimited(0);
  adjustment.shift_limited = options_.adjust_mass_center && (isLimited(1) || isLimited(2));
  adjustment.desired = analyze();
  adjustment.average_after = adjustment.desired.average;
  return adjustment;
}

bool isSettled(const MassAdjustment& step) {
  return std::abs(step.mass_change) < kSettledMass && std::abs(step.shift_x) < kSettledCenter &&
         std::abs(step.shift_z) < kSettledCenter;
}

}  // namespace

std::vector<MassAdjustment> fitMassAndCenter(const ReferenceMotion& motion,
                                             const ExternalLoads& loads,
                                             const RraOptions& options,
                                             const RraPassOptions& pass,
                                             ModelSpec& spec,
                                             const Progress& progress) {
  std::vector<MassAdjustment> steps;
  Fit fit(motion, loads, options, pass, spec, progress);
  ResidualStatistics statistics = fit.analyze();
  do {
    steps.push_back(fit.step(statistics));
    statistics = steps.back().desired;
  } while (static_cast<int>(steps.size()) < kMaxSteps && !isSettled(steps.back()));

  const MassAdjustment total = sumAdjustments(steps);
  applyChange({total.mass_change, -total.shift_x, -total.shift_z}, options, spec);
  return steps;
}

MassAdjustment sumAdjustments(const std::vector<MassAdjustment>& steps) {
  MassAdjustment total = steps.back();
  total.average_before = steps.front().average_before;
  total.mass_before = steps.front().mass_before;
  total.mass_change = total.mass_after - total.mass_before;
  total.shift_x = 0;
  total.shift_z = 0;
  for (const MassAdjustment& step : steps) {
    total.shift_x += step.shift_x;
    total.shift_z += step.shift_z;
  }
  return total;
}

}  // namespace gaitmill
