#include "core/rra/rra_autopilot.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/base/text.h"
#include "core/rra/mass_fit.h"
#include "core/rra/rra_limits.h"
#include "core/rra/rra_simulation.h"

namespace gaitmill {
namespace {

// Passes where the options do not say how many.
constexpr int kUsualPasses = 6;
// A deviation answers a weight about inversely: raised a little past what the share asks for, and
// by no more than this at once, since coordinates share what they give way.
constexpr double kRaise = 1.2;
constexpr double kLargestRaise = 25;
// Below this share of its limit a coordinate can give way to lower the residuals.
constexpr double kRoom = 0.8;
constexpr double kLargestCut = 0.1;
constexpr double kSmallestWeight = 1e-3;
constexpr double kLargestWeight = 1e5;
// A pass counts as better if the merit falls by this share.
constexpr double kGain = 0.01;

std::string formatFigure(const LimitedFigure& figure) {
  return figure.name + " " + formatFixed(figure.value, 1) + " " + figure.unit + " (limit " +
         formatFixed(figure.limit, 1) + ")";
}

// The figures that exceed their limits, worst first, at most three of them by name.
std::string describeExcess(std::vector<LimitedFigure> figures) {
  figures.erase(std::remove_if(figures.begin(),
                               figures.end(),
                               [](const LimitedFigure& figure) { return figure.share() <= 1; }),
                figures.end());
  std::stable_sort(figures.begin(), figures.end(), [](const auto& a, const auto& b) {
    return a.share() > b.share();
  });
  constexpr std::size_t kNamed = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(kNamed, figures.size()); ++i) {
    text += (i == 0 ? "" : ", ") + formatFigure(figures[i]);
  }
  if (figures.size() > kNamed) {
    text += " and " + std::to_string(figures.size() - kNamed) + " more";
  }
  return text;
}

// What the residuals exceed their limits by, and what the deviations do.
double calcResidualMerit(const RraPassResult& pass, const RraLimits& limits) {
  RraPassResult residuals_only;
  residuals_only.residuals = pass.residuals;
  return calcMerit(listFigures(residuals_only, limits));
}

bool residualsExceed(const RraPassResult& pass, const RraLimits& limits) {
  return calcResidualMerit(pass, limits) > 0;
}

// What a pass tries out of the best one so far. Raising some weights and lowering others may undo
// each other, hence the last.
enum class Attempt { kFull, kHalf, kWorseSideOnly, kNone };

const char* describeAttempt(Attempt attempt) {
  switch (attempt) {
    case Attempt::kFull:
      return "weights are changed";
    case Attempt::kHalf:
      return "half the change is tried";
    case Attempt::kWorseSideOnly:
      return "only what exceeds more, deviations or residuals, is worked on";
    case Attempt::kNone:
      break;
  }
  return "no change of weights helps";
}

const CoordinateDeviation* findDeviation(const RraPassResult& pass, const std::string& coordinate) {
  const auto found =
      std::find_if(pass.deviations.begin(), pass.deviations.end(), [&](const auto& deviation) {
        return deviation.coordinate == coordinate;
      });
  return found == pass.deviations.end() ? nullptr : &*found;
}

// The factor for one weight in full; 1 = none.
double findFactor(double share, bool raise, bool lower) {
  if (share > 1) {
    return raise ? std::min(kRaise * share * share, kLargestRaise) : 1;
  }
  return lower && share < kRoom ? std::max(share / kRoom, kLargestCut) : 1;
}

std::string explainChange(const CoordinateDeviation& deviation) {
  const std::string percent = formatFixed(100 * deviation.share, 0) + " % of its limit";
  return deviation.share > 1 ? "strays to " + percent
                             : "strays to " + percent + " only, and residuals exceed theirs";
}

// The tasks of the next pass, out of those of `base`.
void changeWeights(const RraPassResult& base,
                   const RraLimits& limits,
                   Attempt attempt,
                   RraPassResult& next) {
  const double residual_merit = calcResidualMerit(base, limits);
  const bool one_side = attempt == Attempt::kWorseSideOnly;
  const bool residuals_are_worse = residual_merit > base.merit - residual_merit;
  const bool raise = !(one_side && residuals_are_worse);
  const bool lower = residual_merit > 0 && !(one_side && !residuals_are_worse);
  const double strength = attempt == Attempt::kHalf ? 0.5 : 1;
  next.used = base.used;
  for (TrackingTask& task : next.used.tasks) {
    const CoordinateDeviation* const deviation = findDeviation(base, task.coordinate);
    if (deviation == nullptr || task.weight == 0) continue;
    const double before = task.weight;
    task.weight =
        std::clamp(before * std::pow(findFactor(deviation->share, raise, lower), strength),
                   std::min(kSmallestWeight, before),
                   std::max(kLargestWeight, before));
    if (task.weight != before) {
      next.weight_changes.push_back(
          {task.coordinate, before, task.weight, explainChange(*deviation)});
    }
  }
}

class Autopilot {
 public:
  Autopilot(const RraTrial& trial,
            const RraOptions& options,
            const Progress& progress,
            RraResult& result)
      : trial_(trial),
        options_(options),
        progress_(progress),
        result_(result),
        max_passes_(options.max_passes > 0 ? options.max_passes : kUsualPasses),
        model_(trial.model) {}

  void run();

 private:
  void settleMass();
  void simulate(RraPassResult pass);
  bool decide();
  void prune();
  void warnOfMass();
  void warnOfLimits();

  RraPassResult& best() { return result_.passes[static_cast<std::size_t>(result_.kept)]; }
  int passCount() const { return static_cast<int>(result_.passes.size()); }

  const RraTrial& trial_;
  const RraOptions& options_;
  const Progress& progress_;
  RraResult& result_;
  const int max_passes_;
  ModelSpec model_;  // adjusted
  Attempt attempt_ = Attempt::kFull;
};

void Autopilot::run() {
  settleMass();
  RraPassResult first;
  first.used = trial_.first;
  first.adjustment = sumAdjustments(result_.mass_steps);
  simulate(std::move(first));
  while (decide()) {
    RraPassResult next;
    next.from_pass = result_.kept + 1;
    changeWeights(best(), trial_.limits, attempt_, next);
    // The mass is settled: what follows changes nothing about it.
    next.adjustment = result_.passes.front().adjustment;
    next.adjustment.average_before = next.adjustment.average_after;
    next.adjustment.mass_before = next.adjustment.mass_after;
    next.adjustment.mass_change = next.adjustment.shift_x = next.adjustment.shift_z = 0;
    simulate(std::move(next));
  }
  result_.converged = best().merit == 0;
  best().adjusted_model = std::move(model_);
  warnOfMass();
  warnOfLimits();
}

void Autopilot::settleMass() {
  result_.mass_steps =
      fitMassAndCenter(trial_.reference, trial_.loads, options_, trial_.first, model_, progress_);
}

void Autopilot::simulate(RraPassResult pass) {
  const auto report = [&](double fraction) {
    return !progress_ || progress_((passCount() + fraction) / max_passes_);
  };
  simulatePass(model_, trial_.reference, trial_.loads, options_, report, pass);
  pass.deviations = calcDeviations(pass.tracking_errors, trial_.limits);
  pass.merit = calcMerit(listFigures(pass, trial_.limits));
  result_.passes.push_back(std::move(pass));
}

// Compares the last pass with the best one and says what follows. False to stop.
bool Autopilot::decide() {
  RraPassResult& last = result_.passes.back();
  const bool better = result_.kept < 0 || last.merit < (1 - kGain) * best().merit;
  const std::string merit = "sum of what exceeds the limits " + formatFixed(last.merit, 3);
  if (better) {
    result_.kept = passCount() - 1;
    attempt_ = Attempt::kFull;
    last.decision = merit + ": " + describeExcess(listFigures(last, trial_.limits));
  } else {
    attempt_ = static_cast<Attempt>(static_cast<int>(attempt_) + 1);
    last.decision = merit + ", no better than " + formatFixed(best().merit, 3) + " of pass " +
                    std::to_string(result_.kept + 1) + ": taken back";
  }
  prune();
  if (last.merit == 0) {
    last.decision = "all limits hold: kept";
    return false;
  }
  const bool spent = passCount() >= max_passes_;
  const bool goes_on = attempt_ != Attempt::kNone && !spent;
  last.decision +=
      std::string("; ") + (spent ? "no more passes allowed" : describeAttempt(attempt_));
  if (!goes_on) {
    last.decision += ", pass " + std::to_string(result_.kept + 1) + " is kept";
  }
  return goes_on;
}

// Tables of passes that are not kept would be most of what a job stores.
void Autopilot::prune() {
  for (RraPassResult& pass : result_.passes) {
    if (&pass == &best()) continue;
    for (TimeSeries* table : {&pass.coordinates,
                              &pass.speeds,
                              &pass.actuator_forces,
                              &pass.residual_sums,
                              &pass.tracking_errors}) {
      *table = {};
    }
  }
}

void Autopilot::warnOfMass() {
  const MassAdjustment total = sumAdjustments(result_.mass_steps);
  if (total.mass_limited) {
    result_.warnings.push_back(
        "the vertical ground reaction asks for a body mass further from " +
        formatFixed(total.mass_before, 1) + " kg than the " +
        formatFixed(100 * options_.max_mass_change, 0) +
        " % that are believable: a wrong mass, a plate with an offset, or a contact beside the "
        "plates within the simulated time");
  }
  if (total.shift_limited) {
    result_.warnings.push_back(
        "the mass centre of " + options_.adjusted_body + " went as far as it may (" +
        formatFixed(100 * options_.max_mass_center_shift, 0) +
        " cm): force plates that are registered wrongly, or a mistaken forward direction");
  }
}

void Autopilot::warnOfLimits() {
  if (result_.converged) return;
  const std::vector<LimitedFigure> figures = listFigures(best(), trial_.limits);
  const bool residuals = residualsExceed(best(), trial_.limits);
  const bool deviates = std::any_of(best().deviations.begin(),
                                    best().deviations.end(),
                                    [](const auto& deviation) { return deviation.share > 1; });
  const char* const cause =
      residuals && deviates
          ? "motion and forces contradict each other: a contact that no plate recorded, forces and "
            "markers that are not synchronous, or plates that are registered wrongly"
      : residuals ? "accelerations that are noisier than the forces: a cutoff that is too high, or "
                    "centres of pressure that jump"
                  : "the motion is not one that these forces produce: a cutoff that is too low, or "
                    "markers that slipped";
  result_.warnings.push_back("limits do not hold after " + std::to_string(passCount()) +
                             " passes: " + describeExcess(figures) + "; likely " + cause);
}

}  // namespace

void runAutopilot(const RraTrial& trial,
                  const RraOptions& options,
                  const Progress& progress,
                  RraResult& result) {
  Autopilot(trial, options, progress, result).run();
}

}  // namespace gaitmill
