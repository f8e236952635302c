#include "core/validation/curve_figures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/muscle/muscle.h"
#include "core/validation/muscle_title.h"
#include "core/validation/posed_muscles.h"
#include "core/validation/series.h"
#include "core/validation/tendon_slack.h"

namespace gaitmill {

namespace {

constexpr int kSamples = 200;  ///< intervals of a drawn curve

// A curve sampled evenly; x and y are multiplied for display.
struct Sampling {
  double low;
  double high;
  double x_unit = 1;
  double y_unit = 1;
};

Series sample(const std::string& name,
              SeriesRole role,
              const Sampling& range,
              const std::function<double(double)>& function) {
  Series series = makeSeries(name, role);
  for (int i = 0; i <= kSamples; ++i) {
    const double x = range.low + (range.high - range.low) * i / kSamples;
    series.x.push_back(range.x_unit * x);
    series.y.push_back(range.y_unit * function(x));
  }
  return series;
}

// One of a muscle's normalised curves as a function.
std::function<double(double)> valueOf(const Muscle& muscle,
                                      CurvePoint (Muscle::*curve)(double) const noexcept) {
  return [&muscle, curve](double x) {
    return (muscle.*curve)(x).value;
  };
}

// What figures say of the curves of a muscle, whatever its kind.
struct CurveFacts {
  std::string source;
  double active_min_length;
  double active_max_length;
  double passive_strain_at_one_force;
  double max_eccentric_force;
  double tendon_strain_at_one_force;
};

CurveFacts findFacts(const MuscleSpec& spec) {
  // Active force of the last two never ends; lengths beyond these are not seen in people.
  constexpr double kShort = 0.35;
  constexpr double kLong = 1.75;
  switch (spec.kind) {
    case MuscleKind::kThelen2003:
      return {"Thelen 2003",
              kShort,
              kLong,
              spec.thelen.passive_strain_at_one_force,
              spec.thelen.max_eccentric_force,
              spec.thelen.tendon_strain_at_one_force};
    case MuscleKind::kSchutte1993:
      return {"Schutte et al. 1993",
              kShort,
              kLong,
              0.5,
              1.4,
              solveTendonStretch(makeMuscles({spec}).front(), 1) - 1};
    case MuscleKind::kMillard2012:
      break;
  }
  const MuscleCurvesSpec& curves = spec.curves;
  return {"Millard et al. 2013; Figure 3 of Rajagopal et al. 2016",
          curves.active_min_length,
          curves.active_max_length,
          curves.passive_strain_at_one_force,
          curves.max_eccentric_force,
          curves.tendon_strain_at_one_force};
}

// Ranges over which the curves are worth seeing: a little beyond the active range, the speeds, and
// the tendon's strain at maximum force.
Sampling lengthRange(const CurveFacts& facts) {
  return {std::max(0.0, facts.active_min_length - 0.05),
          std::min(facts.active_max_length, 1 + facts.passive_strain_at_one_force + 0.05)};
}

Sampling tendonRange(const CurveFacts& facts) {
  return {-0.1 * facts.tendon_strain_at_one_force, 1.1 * facts.tendon_strain_at_one_force};
}

Guide makeGuide(double value, const std::string& label) {
  return {Guide::Direction::kVertical, value, label};
}

// The parameters that most muscles have, and how many have them.
struct CommonCurves {
  const MuscleSpec* spec = nullptr;
  int count = 0;
};

CommonCurves findCommonCurves(const ModelSpec& model) {
  std::vector<CommonCurves> kinds;
  for (const MuscleSpec& muscle : model.muscles) {
    auto same = std::find_if(kinds.begin(), kinds.end(), [&muscle](const CommonCurves& kind) {
      return haveSameCurves(*kind.spec, muscle);
    });
    if (same == kinds.end()) {
      kinds.push_back({&muscle, 1});
    } else {
      ++same->count;
    }
  }
  return *std::max_element(
      kinds.begin(), kinds.end(), [](const auto& a, const auto& b) { return a.count < b.count; });
}

Panel makeNormalisedLengthPanel(const CurveFacts& facts, const Muscle& muscle) {
  Panel panel;
  panel.name = "force_length";
  panel.title = "Fiber force against length";
  panel.x = {"Normalised fiber length", ""};
  panel.y = {"Normalised fiber force", "", 0.0, 1.5};
  panel.series = {sample("active",
                         SeriesRole::kActive,
                         lengthRange(facts),
                         valueOf(muscle, &Muscle::calcActiveForceLength)),
                  sample("passive",
                         SeriesRole::kPassive,
                         lengthRange(facts),
                         valueOf(muscle, &Muscle::calcPassiveForceLength))};
  panel.guides = {makeGuide(1, "optimal")};
  panel.note = "Active from " + formatFixed(facts.active_min_length, 2) + " to " +
               formatFixed(facts.active_max_length, 2) + "; passive force 1 at " +
               formatFixed(1 + facts.passive_strain_at_one_force, 2);
  return panel;
}

Panel makeNormalisedVelocityPanel(const CurveFacts& facts, const Muscle& muscle) {
  Panel panel;
  panel.name = "force_velocity";
  panel.title = "Fiber force against velocity";
  panel.x = {"Normalised fiber velocity", ""};
  panel.y = {"Normalised fiber force", "", 0.0, 1.5};
  panel.series = {sample(
      "active", SeriesRole::kActive, {-1.1, 1.1}, valueOf(muscle, &Muscle::calcForceVelocity))};
  panel.guides = {makeGuide(0, "isometric")};
  panel.note = "Largest while lengthening " + formatFixed(facts.max_eccentric_force, 2);
  return panel;
}

Panel makeNormalisedTendonPanel(const CurveFacts& facts, const Muscle& muscle) {
  Panel panel;
  panel.name = "tendon_force_strain";
  panel.title = "Tendon force against strain";
  panel.x = {"Tendon strain", "%"};
  panel.y = {"Normalised tendon force", ""};
  Sampling range = tendonRange(facts);
  range.x_unit = 100;
  panel.series = {sample("tendon", SeriesRole::kPlain, range, [&muscle](double strain) {
    return muscle.calcTendonForceLength(1 + strain).value;
  })};
  panel.guides = {makeGuide(100 * facts.tendon_strain_at_one_force, "maximum isometric force")};
  return panel;
}

// The curves of one muscle, in its own units.
struct MuscleView {
  const MuscleSpec& spec;
  const CurveFacts& facts;
  const Muscle& muscle;
};

Panel makeLengthPanel(const MuscleView& view) {
  const double l0 = view.spec.optimal_fiber_length;
  Sampling range = lengthRange(view.facts);
  range.x_unit = 100 * l0;
  range.y_unit = view.spec.max_isometric_force;
  const auto active = valueOf(view.muscle, &Muscle::calcActiveForceLength);
  const auto passive = valueOf(view.muscle, &Muscle::calcPassiveForceLength);
  Panel panel;
  panel.name = "force_length";
  panel.title = "Fiber force against length";
  panel.x = {"Fiber length", "cm"};
  panel.y = {"Fiber force", "N", 0.0, 1.5 * view.spec.max_isometric_force};
  panel.series = {
      sample("active", SeriesRole::kActive, range, active),
      sample("passive", SeriesRole::kPassive, range, passive),
      sample("sum", SeriesRole::kPlain, range, [&](double x) { return active(x) + passive(x); })};
  panel.guides = {makeGuide(100 * l0, "optimal")};
  return panel;
}

Panel makeVelocityPanel(const MuscleView& view) {
  Panel panel;
  panel.name = "force_velocity";
  panel.title = "Fiber force against velocity";
  panel.x = {"Fiber velocity", "cm/s"};
  panel.y = {"Fiber force", "N", 0.0};
  panel.series = {
      sample("active",
             SeriesRole::kActive,
             {-1.1, 1.1, 100 * view.muscle.maxFiberSpeed(), view.spec.max_isometric_force},
             valueOf(view.muscle, &Muscle::calcForceVelocity))};
  panel.guides = {makeGuide(0, "isometric")};
  return panel;
}

Panel makeTendonPanel(const MuscleView& view) {
  const double slack = view.spec.tendon_slack_length;
  Panel panel;
  panel.name = "tendon_force_length";
  panel.title = "Tendon force against length";
  panel.x = {"Tendon length", "cm"};
  panel.y = {"Tendon force", "N", 0.0};
  Series series =
      sample("tendon", SeriesRole::kPlain, tendonRange(view.facts), [&view](double strain) {
        return view.muscle.calcTendonForceLength(1 + strain).value;
      });
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    series.x[i] = 100 * slack * (1 + series.x[i]);
    series.y[i] *= view.spec.max_isometric_force;
  }
  panel.series = {series};
  panel.guides = {makeGuide(100 * slack, "slack")};
  return panel;
}

// Force of the whole unit, held at a path length, with the tendon in equilibrium.
Panel makeIsometricPanel(const MuscleView& view) {
  const double l0 = view.spec.optimal_fiber_length;
  const double slack = view.spec.tendon_slack_length;
  const Sampling range{slack + 0.3 * l0,
                       slack * (1 + view.facts.tendon_strain_at_one_force) + 1.5 * l0};
  Panel panel;
  panel.name = "isometric_force";
  panel.title = "Isometric force of muscle and tendon";
  panel.x = {"Path length", "cm"};
  panel.y = {"Tendon force", "N", 0.0};
  for (const double activation : {1.0, 0.5, view.muscle.minimumActivation()}) {
    Series series = sample(
        "activation " + formatFixed(activation, 2), SeriesRole::kPlain, range, [&](double length) {
          return calcIsometricForce(view.muscle, activation, length).total;
        });
    for (double& x : series.x) {
      x *= 100;
    }
    panel.series.push_back(series);
  }
  return panel;
}

std::string describeParameters(const MuscleSpec& spec) {
  return "Maximum isometric force " + formatFixed(spec.max_isometric_force, 0) +
         " N, optimal fiber length " + formatFixed(100 * spec.optimal_fiber_length, 2) +
         " cm, tendon slack length " + formatFixed(100 * spec.tendon_slack_length, 2) +
         " cm, pennation at optimal fiber length " +
         formatFixed(toDegrees(spec.pennation_at_optimal), 1) +
         " deg, maximum contraction velocity " + formatFixed(spec.max_contraction_velocity, 1) +
         " fiber lengths/s. " +
         (spec.tendon == TendonKind::kRigid ? "The tendon is rigid, so it has no curve of its own."
                                            : "The tendon is elastic.");
}

}  // namespace

Figure makeForceLengthVelocityFigure(const ModelSpec& model) {
  const CommonCurves common = findCommonCurves(model);
  const CurveFacts facts = findFacts(*common.spec);
  const Muscle muscle = makeMuscles({*common.spec}).front();
  Figure figure;
  figure.name = "force_length_velocity";
  figure.title = "Force-length-velocity and tendon curves";
  figure.caption =
      "Normalised curves of the muscle model (" + facts.source +
      "): force over maximum isometric force, length over optimal fiber length, velocity over "
      "maximum contraction velocity, lengthening positive; active force at activation 1. " +
      std::to_string(common.count) + " of the model's " + std::to_string(model.muscles.size()) +
      " muscles have these curves.";
  figure.columns = 3;
  figure.panels = {makeNormalisedLengthPanel(facts, muscle),
                   makeNormalisedVelocityPanel(facts, muscle),
                   makeNormalisedTendonPanel(facts, muscle)};
  return figure;
}

Figure makeMuscleCurvesFigure(const ModelSpec& model, MuscleIndex muscle) {
  const MuscleSpec& spec = model.muscles[static_cast<std::size_t>(muscle.value())];
  const std::vector<Muscle> built = makeMuscles({spec});
  const CurveFacts facts = findFacts(spec);
  const MuscleView view{spec, facts, built.front()};
  Figure figure;
  figure.name = "muscle_curves_" + spec.name;
  figure.title = "Curves of " + makeSidedTitle(spec.name);
  figure.caption = describeParameters(spec) +
                   " Fiber forces are those at activation 1, the one against velocity at optimal "
                   "fiber length with lengthening positive; in the last panel fiber and tendon are "
                   "in equilibrium at zero velocity.";
  figure.panels = {makeLengthPanel(view), makeVelocityPanel(view)};
  if (spec.tendon != TendonKind::kRigid) {
    figure.panels.push_back(makeTendonPanel(view));
  }
  figure.panels.push_back(makeIsometricPanel(view));
  return figure;
}

}  // namespace gaitmill
