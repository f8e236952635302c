#include "core/rra/rra_solver.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/where.h"
#include "core/math/table_filters.h"
#include "core/rra/mass_adjustment.h"
#include "core/rra/rra_autopilot.h"
#include "core/rra/rra_limits.h"
#include "core/rra/rra_simulation.h"

namespace gaitmill {
namespace {

bool isSettled(const MassAdjustment& adjustment, const RraOptions& options) {
  return std::abs(adjustment.mass_change) < options.mass_tolerance &&
         std::abs(adjustment.shift_x) < options.mass_center_tolerance &&
         std::abs(adjustment.shift_z) < options.mass_center_tolerance;
}

// The pass within the recorded motion. @param number  of the pass, from 1
RraPassOptions clipPass(RraPassOptions pass, const TimeSeries& coordinates, int number) {
  pass.start_time = std::max(pass.start_time, coordinates.time.front());
  pass.end_time = std::min(pass.end_time, coordinates.time.back());
  require(pass.start_time < pass.end_time,
          ErrorCode::kInputTimeRange,
          "the motion does not reach into the time range of pass " + std::to_string(number),
          atTime(pass.start_time));
  return pass;
}

RraPassResult solvePass(const ModelSpec& model,
                        const ReferenceMotion& reference,
                        const ExternalLoads& loads,
                        const RraOptions& options,
                        const RraPassOptions& pass,
                        const Progress& progress) {
  RraPassResult result;
  result.used = pass;
  result.adjusted_model = model;
  result.adjustment =
      shiftMassCenter(reference, loads, options, pass, result.adjusted_model, progress);
  simulatePass(result.adjusted_model, reference, loads, options, progress, result);
  if (options.adjust_mass) {
    MassAdjustment& adjustment = result.adjustment;
    adjustment.mass_after = adjustment.mass_before + adjustment.mass_change;
    setTotalMass(result.adjusted_model, adjustment.mass_after, options.inertia_scaling);
  }
  return result;
}

}  // namespace

TimeSeries prepareDesiredMotion(const TimeSeries& coordinates, const RraOptions& options) {
  const TimeSeries padded = padOdd(dropRepeatedRows(coordinates), options.padding_rows);
  return options.lowpass_cutoff ? filterFir(padded, *options.lowpass_cutoff) : padded;
}

RraResult solveRra(const ModelSpec& spec,
                   const TimeSeries& coordinates,
                   const GroundReaction& reaction,
                   const RraOptions& options,
                   const Progress& progress) {
  options.validate();
  require(coordinates.rowCount() > 0, ErrorCode::kTableNoRows, "the motion has no rows");
  const Model model(spec);
  const FreeCoordinates free(model);
  const ExternalLoads loads(model, reaction);
  const ReferenceMotion reference(model, free, prepareDesiredMotion(coordinates, options));

  RraResult result;
  result.options = options;
  result.options.limits = resolveLimits(options.limits, reaction);
  const auto clip = [&](std::size_t pass) {
    return clipPass(options.passes[pass], coordinates, static_cast<int>(pass) + 1);
  };
  if (options.strategy == RraStrategy::kAutopilot) {
    const RraTrial trial{spec, reference, loads, clip(0), result.options.limits};
    runAutopilot(trial, options, progress, result);
    return result;
  }
  const auto listed = static_cast<int>(options.passes.size());
  const int limit = options.max_passes > 0 ? options.max_passes : listed;
  for (int pass = 0; pass < limit && !result.converged; ++pass) {
    const auto report = [&](double fraction) {
      return !progress || progress((pass + fraction) / limit);
    };
    const ModelSpec& received = pass == 0 ? spec : result.passes.back().adjusted_model;
    const RraPassOptions used = clip(static_cast<std::size_t>(std::min(pass, listed - 1)));
    result.passes.push_back(solvePass(received, reference, loads, options, used, report));
    assessPass(result.options.limits, result.passes.back());
    result.kept = pass;
    result.converged = pass + 1 >= listed && isSettled(result.passes.back().adjustment, options);
  }
  return result;
}

}  // namespace gaitmill
