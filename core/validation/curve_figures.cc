#include "core/validation/curve_figures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/muscle/muscle.h"
#include "core/muscle/muscle_curves.h"
#include "core/validation/muscle_title.h"
#include "core/validation/posed_muscles.h"
#include "core/validation/series.h"

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

std::function<double(double)> valueOf(const QuinticCurve& curve) {
  return [&curve](double x) {
    return curve.calc(x).value;
  };
}

// Ranges over which the curves are worth seeing: a little beyond the active range, the speeds, and
// the tendon's strain at maximum force.
Sampling lengthRange(const MuscleCurvesSpec& spec) {
  return {std::max(0.0, spec.active_min_length - 0.05),
          std::min(spec.active_max_length, 1 + spec.passive_strain_at_one_force + 0.05)};
}

Sampling tendonRange(const MuscleCurvesSpec& spec) {
  return {-0.1 * spec.tendon_strain_at_one_force, 1.1 * spec.tendon_strain_at_one_force};
}

Guide makeGuide(double value, const std::string& label) {
  return {Guide::Direction::kVertical, value, label};
}

// The parameters that most muscles have, and how many have them.
struct CommonCurves {
  const MuscleCurvesSpec* spec = nullptr;
  int count = 0;
};

CommonCurves findCommonCurves(const ModelSpec& model) {
  std::vector<CommonCurves> kinds;
  for (const MuscleSpec& muscle : model.muscles) {
    auto same = std::find_if(kinds.begin(), kinds.end(), [&muscle](const CommonCurves& kind) {
      return haveSameCurves(*kind.spec, muscle.curves);
    });
    if (same == kinds.end()) {
      kinds.push_back({&muscle.curves, 1});
    } else {
      ++same->count;
    }
  }
  return *std::max_element(
      kinds.begin(), kinds.end(), [](const auto& a, const auto& b) { return a.count < b.count; });
}

Panel makeNormalisedLengthPanel(const MuscleCurvesSpec& spec, const MuscleCurves& curves) {
  Panel panel;
  panel.name = "force_length";
  panel.title = "Fiber force against length";
  panel.x = {"Normalised fiber length", ""};
  panel.y = {"Normalised fiber force", "", 0.0, 1.5};
  panel.series = {
      sample("active", SeriesRole::kActive, lengthRange(spec), valueOf(curves.active_force_length)),
      sample("passive",
             SeriesRole::kPassive,
             lengthRange(spec),
             valueOf(curves.passive_force_length))};
  panel.guides = {makeGuide(1, "optimal")};
  panel.note = "Active from " + formatFixed(spec.active_min_length, 2) + " to " +
               formatFixed(spec.active_max_length, 2) + "; passive force 1 at " +
               formatFixed(1 + spec.passive_strain_at_one_force, 2);
  return panel;
}

Panel makeNormalisedVelocityPanel(const MuscleCurvesSpec& spec, const MuscleCurves& curves) {
  Panel panel;
  panel.name = "force_velocity";
  panel.title = "Fiber force against velocity";
  panel.x = {"Normalised fiber velocity", ""};
  panel.y = {"Normalised fiber force", "", 0.0, 1.5};
  panel.series = {
      sample("active", SeriesRole::kActive, {-1.1, 1.1}, valueOf(curves.force_velocity))};
  panel.guides = {makeGuide(0, "isometric")};
  panel.note = "Largest while lengthening " + formatFixed(spec.max_eccentric_force, 2);
  return panel;
}

Panel makeNormalisedTendonPanel(const MuscleCurvesSpec& spec, const MuscleCurves& curves) {
  Panel panel;
  panel.name = "tendon_force_strain";
  panel.title = "Tendon force against strain";
  panel.x = {"Tendon strain", "%"};
  panel.y = {"Normalised tendon force", ""};
  Sampling range = tendonRange(spec);
  range.x_unit = 100;
  panel.series = {sample("tendon", SeriesRole::kPlain, range, [&curves](double strain) {
    return curves.tendon_force_length.calc(1 + strain).value;
  })};
  panel.guides = {makeGuide(100 * spec.tendon_strain_at_one_force, "maximum isometric force")};
  return panel;
}

// The curves of one muscle, in its own units.
struct MuscleView {
  const MuscleSpec& spec;
  const MuscleCurves& curves;
  const Muscle& muscle;
};

Panel makeLengthPanel(const MuscleView& view) {
  const double l0 = view.spec.optimal_fiber_length;
  Sampling range = lengthRange(view.spec.curves);
  range.x_unit = 100 * l0;
  range.y_unit = view.spec.max_isometric_force;
  const QuinticCurve& active = view.curves.active_force_length;
  const QuinticCurve& passive = view.curves.passive_force_length;
  Panel panel;
  panel.name = "force_length";
  panel.title = "Fiber force against length";
  panel.x = {"Fiber length", "cm"};
  panel.y = {"Fiber force", "N", 0.0, 1.5 * view.spec.max_isometric_force};
  panel.series = {sample("active", SeriesRole::kActive, range, valueOf(active)),
                  sample("passive", SeriesRole::kPassive, range, valueOf(passive)),
                  sample("sum", SeriesRole::kPlain, range, [&](double x) {
                    return active.calc(x).value + passive.calc(x).value;
                  })};
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
             valueOf(view.curves.force_velocity))};
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
      sample("tendon", SeriesRole::kPlain, tendonRange(view.spec.curves), [&view](double strain) {
        return view.curves.tendon_force_length.calc(1 + strain).value;
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
                       slack * (1 + view.spec.curves.tendon_strain_at_one_force) + 1.5 * l0};
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
  const MuscleCurves curves(*common.spec);
  Figure figure;
  figure.name = "force_length_velocity";
  figure.title = "Force-length-velocity and tendon curves";
  figure.caption =
      "Normalised curves of the muscle model (Millard et al. 2013; Figure 3 of Rajagopal et al. "
      "2016): force over maximum isometric force, length over optimal fiber length, velocity over "
      "maximum contraction velocity, lengthening positive; active force at activation 1. " +
      std::to_string(common.count) + " of the model's " + std::to_string(model.muscles.size()) +
      " muscles have these curves.";
  figure.columns = 3;
  figure.panels = {makeNormalisedLengthPanel(*common.spec, curves),
                   makeNormalisedVelocityPanel(*common.spec, curves),
                   makeNormalisedTendonPanel(*common.spec, curves)};
  return figure;
}

Figure makeMuscleCurvesFigure(const ModelSpec& model, MuscleIndex muscle) {
  const MuscleSpec& spec = model.muscles[static_cast<std::size_t>(muscle.value())];
  const std::vector<Muscle> built = makeMuscles({spec});
  const MuscleCurves curves(spec.curves);
  const MuscleView view{spec, curves, built.front()};
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
