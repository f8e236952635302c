#include "core/validation/variability.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/error.h"
#include "core/base/units.h"

namespace gaitmill {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Fewer say nothing about a spread; more take longer than a request should.
constexpr int kFewestDraws = 100;
constexpr int kMostDraws = 100000;

double square(double x) {
  return x * x;
}

double rootOrZero(double x) {
  return std::sqrt(std::max(0.0, x));
}

SlackVariation makeVariation(const SlackCalibration& rest,
                             const MuscleSpec& muscle,
                             const PublishedParameters& published) {
  SlackVariation variation;
  variation.mean = {rest.path_length,
                    muscle.optimal_fiber_length,
                    rest.norm_fiber_length,
                    muscle.pennation_at_optimal,
                    muscle.tendon};
  variation.fiber_sd = 0.01 * published.fiber_cm.sd;
  variation.pennation_sd = toRadians(published.pennation_deg.sd);
  return variation;
}

// sigma_l~/l~ that explains to first order what the other two leave of the printed spread.
double inferNormLengthCv(const SlackVariation& variation,
                         const Muscle& muscle,
                         const PublishedParameters& published) {
  const SlackSensitivity by = calcSensitivity(variation.mean, muscle);
  const double left = square(0.01 * published.slack_cm.sd) -
                      square(by.by_fiber * variation.fiber_sd) -
                      square(by.by_pennation * variation.pennation_sd);
  return rootOrZero(left) / std::abs(by.by_norm_length) / variation.mean.norm_fiber_length;
}

void fillForce(ParameterSpread& row, double force, std::map<std::string, double>& volume_cv) {
  const PublishedParameters& published = *row.published;
  const double fiber_cv =
      std::isnan(published.fiber_cm.sd) ? 0.0 : published.fiber_cm.sd / published.fiber_cm.mean;
  const double force_cv = published.force_n.sd / published.force_n.mean;
  const auto [known, is_first] =
      volume_cv.insert({published.volume_of, rootOrZero(square(force_cv) - square(fiber_cv))});
  row.is_prediction_of_force = !is_first;
  row.volume_cv = known->second;
  row.force_by_fiber_n = force * fiber_cv;
  row.force_sd_n = force * std::hypot(row.volume_cv, fiber_cv);
}

struct SlackDraws {
  NormalDraws normal;
  int draws;
};

void fillSlack(ParameterSpread& row,
               SlackVariation variation,
               const Muscle& muscle,
               std::map<std::string, double>& norm_length_cv,
               SlackDraws& draws) {
  const double cv = inferNormLengthCv(variation, muscle, *row.published);
  const auto [known, is_first] = norm_length_cv.insert({row.published->fibers_of, cv});
  row.is_prediction_of_slack = !is_first;
  row.norm_length_cv = known->second;
  row.slack_by_fiber = drawTendonSlack(variation, muscle, draws.normal, draws.draws);
  variation.norm_length_sd = row.norm_length_cv * variation.mean.norm_fiber_length;
  row.slack = drawTendonSlack(variation, muscle, draws.normal, draws.draws);
  row.pennation_by_length = calcPennationSpread(variation.mean.pennation_at_optimal,
                                                variation.mean.norm_fiber_length,
                                                variation.norm_length_sd);
}

}  // namespace

SlackSpread drawTendonSlack(const SlackVariation& variation,
                            const Muscle& muscle,
                            NormalDraws& normal,
                            int draws) {
  SlackSpread spread;
  spread.draws = draws;
  double mean = 0;
  double squares = 0;
  int count = 0;
  for (int i = 0; i < draws; ++i) {
    SlackInput input = variation.mean;
    input.optimal_fiber_length += variation.fiber_sd * normal.draw();
    input.norm_fiber_length += variation.norm_length_sd * normal.draw();
    input.pennation_at_optimal += variation.pennation_sd * normal.draw();
    const double slack = calcTendonSlack(input, muscle);
    if (std::isnan(slack)) {
      ++spread.rejected;
      continue;
    }
    ++count;
    const double off = slack - mean;
    mean += off / count;
    squares += off * (slack - mean);
  }
  spread.mean = count > 0 ? mean : kNone;
  spread.sd = count > 1 ? std::sqrt(squares / (count - 1)) : kNone;
  return spread;
}

SlackSensitivity calcSensitivity(const SlackInput& input, const Muscle& muscle) {
  // Central differences: the curves are C2, so the error is some 1e-9 of the value.
  constexpr double kStep = 1e-5;
  const auto slope = [&](double SlackInput::*member, double step) {
    SlackInput low = input;
    SlackInput high = input;
    low.*member -= step;
    high.*member += step;
    return (calcTendonSlack(high, muscle) - calcTendonSlack(low, muscle)) / (2 * step);
  };
  return {slope(&SlackInput::optimal_fiber_length, kStep * input.optimal_fiber_length),
          slope(&SlackInput::norm_fiber_length, kStep),
          slope(&SlackInput::pennation_at_optimal, kStep)};
}

double calcPennationSpread(double pennation_at_optimal,
                           double norm_fiber_length,
                           double norm_length_sd) {
  // D = sqrt(1 - l~^2 sin^2 alpha) = cos alpha_o, since sin alpha_o = l~ sin alpha.
  const double sin = std::sin(pennation_at_optimal) / norm_fiber_length;
  return std::abs(sin) / std::cos(pennation_at_optimal) * norm_length_sd;
}

std::vector<ParameterSpread> calcParameterSpreads(const ModelSpec& model,
                                                  const ValidationOptions& options) {
  require(options.draws >= kFewestDraws && options.draws <= kMostDraws,
          ErrorCode::kInputValue,
          "the number of Monte Carlo draws is " + std::to_string(options.draws) + ", not in " +
              std::to_string(kFewestDraws) + " to " + std::to_string(kMostDraws));
  std::vector<ParameterSpread> rows;
  std::map<std::string, double> volume_cv;
  std::map<std::string, double> norm_length_cv;
  SlackDraws draws{NormalDraws(options.seed), options.draws};
  const std::vector<SlackCalibration> rests = calibrateTendonSlack(model, {});
  const std::vector<Muscle> muscles = makeMuscles(model.muscles);
  for (const PublishedParameters& published : publishedParameters()) {
    const int m = model.findMuscle(published.muscle + "_r");
    if (m < 0) {
      continue;
    }
    const MuscleSpec& muscle = model.muscles[static_cast<std::size_t>(m)];
    const SlackCalibration& rest = rests[static_cast<std::size_t>(m)];
    ParameterSpread row;
    row.muscle = muscle.name;
    row.published = &published;
    row.norm_fiber_length = rest.norm_fiber_length;
    fillForce(row, muscle.max_isometric_force, volume_cv);
    if (!std::isnan(published.slack_cm.sd)) {
      fillSlack(row,
                makeVariation(rest, muscle, published),
                muscles[static_cast<std::size_t>(m)],
                norm_length_cv,
                draws);
    } else {
      row.slack.sd = row.slack_by_fiber.sd = row.norm_length_cv = row.pennation_by_length = kNone;
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace gaitmill
