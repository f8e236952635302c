#include "core/rra/mass_adjustment.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/LU>

#include "core/base/error.h"
#include "core/base/where.h"
#include "core/rra/actuated_body.h"
#include "core/rra/residual_statistics.h"

namespace gaitmill {
namespace {

// Times printed with few digits may miss the limit by half a unit of the ninth.
constexpr double kTimeSlack = 5e-10;  // [s]

// Rows from the last at or before the start to the last at or before the end.
std::vector<double> selectTimes(const std::vector<double>& time, const RraPassOptions& pass) {
  const auto atOrBefore = [&](double t) {
    return std::upper_bound(time.begin(), time.end(), t + kTimeSlack) - time.begin() - 1;
  };
  const auto first = std::max<std::ptrdiff_t>(atOrBefore(pass.start_time), 0);
  const auto last = atOrBefore(pass.end_time);
  require(last > first,
          ErrorCode::kInputTimeRange,
          "the desired motion has no rows between " + std::to_string(pass.start_time) + " and " +
              std::to_string(pass.end_time) + " s",
          atTime(pass.start_time));
  return {time.begin() + first, time.begin() + last + 1};
}

}  // namespace

TimeSeries calcDesiredResiduals(const ModelSpec& spec,
                                const ReferenceMotion& motion,
                                const ExternalLoads& loads,
                                const RraOptions& options,
                                const RraPassOptions& pass,
                                const Progress& progress) {
  const Model model(spec);
  const FreeCoordinates free(model);
  ActuatedBody body(model, free, loads, options.actuators);
  const int n = free.count();
  require(body.actuators().count() == n,
          ErrorCode::kSettingsValue,
          "residual reduction needs one actuator per free coordinate: " + std::to_string(n) +
              ", found " + std::to_string(body.actuators().count()),
          {"", 0, 0, "actuators"});

  TimeSeries residuals = makeResidualTable(selectTimes(motion.times(), pass));
  Eigen::VectorXd q(n), u(n), udot(n), demand(n);
  for (int i = 0; i < residuals.rowCount(); ++i) {
    reportProgress(progress, 0.0);
    const double t = residuals.time[static_cast<std::size_t>(i)];
    motion.calcPose(t, q);
    motion.calcSpeed(t, u);
    motion.calcAcceleration(t, udot);
    body.setMotion(t, q, u);
    body.calcDemand(udot, demand);
    setResidualRow(body.sumResiduals(body.columns().partialPivLu().solve(demand)), i, residuals);
  }
  return residuals;
}

BodySpec& findAdjustedBody(const RraOptions& options, ModelSpec& spec) {
  const int index = spec.findBody(options.adjusted_body);
  require(
      index >= 0,
      ErrorCode::kModelReference,
      "the model has no body '" + options.adjusted_body + "' whose mass center could be shifted",
      {"", 0, 0, "adjusted_body"});
  return spec.bodies[static_cast<std::size_t>(index)];
}

MassAdjustment shiftMassCenter(const ReferenceMotion& motion,
                               const ExternalLoads& loads,
                               const RraOptions& options,
                               const RraPassOptions& pass,
                               ModelSpec& spec,
                               const Progress& progress) {
  const auto analyze = [&] {
    return calcResidualStatistics(
        calcDesiredResiduals(spec, motion, loads, options, pass, progress));
  };
  MassAdjustment adjustment;
  adjustment.desired = analyze();
  adjustment.average_before = adjustment.desired.average;
  adjustment.average_after = adjustment.average_before;
  adjustment.mass_before = spec.calcTotalMass();
  adjustment.mass_after = adjustment.mass_before;
  // A model that is too heavy needs an upward residual: the mass comes down.
  const double gravity = spec.gravity.y();
  adjustment.mass_change = adjustment.average_before.force.y() / gravity;
  if (!options.adjust_mass_center) return adjustment;

  BodySpec& body = findAdjustedBody(options, spec);
  const double weight = body.mass * std::abs(gravity);
  const double wanted_x = adjustment.average_before.moment.z() / weight;
  const double wanted_z = -adjustment.average_before.moment.x() / weight;
  const double limit = options.max_mass_center_shift;
  adjustment.shift_x = std::clamp(wanted_x, -limit, limit);
  adjustment.shift_z = std::clamp(wanted_z, -limit, limit);
  adjustment.shift_limited = adjustment.shift_x != wanted_x || adjustment.shift_z != wanted_z;
  body.mass_center.x() -= adjustment.shift_x;
  body.mass_center.z() -= adjustment.shift_z;
  adjustment.desired = analyze();
  adjustment.average_after = adjustment.desired.average;
  return adjustment;
}

}  // namespace gaitmill
