#include "core/validation/parameter_figures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/validation/muscle_title.h"
#include "core/validation/published_parameters.h"
#include "core/validation/series.h"
#include "core/validation/side.h"
#include "core/validation/variability.h"

namespace gaitmill {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// A muscle of the model and its row of the table, null = not printed.
struct ParameterRow {
  const MuscleSpec* muscle;
  const PublishedParameters* published;
};

bool isLeft(const std::string& name) {
  return name.size() > 2 && name.compare(name.size() - 2, 2, "_l") == 0;
}

std::vector<ParameterRow> makeRows(const ModelSpec& model) {
  const bool has_right = std::any_of(
      model.muscles.begin(), model.muscles.end(), [](const auto& m) { return !isLeft(m.name); });
  std::vector<ParameterRow> rows;
  for (const MuscleSpec& muscle : model.muscles) {
    if (!has_right || !isLeft(muscle.name)) {
      rows.push_back({&muscle, findPublished(findMuscleBase(muscle.name))});
    }
  }
  return rows;
}

// One of the four parameters, in the unit in which it is printed.
struct Quantity {
  const char* name;
  const char* title;
  const char* unit;
  int decimals;
  double rounding;  ///< of the print
  std::function<double(const MuscleSpec&)> own;
  PublishedValue PublishedParameters::*printed;
};

const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> all = {
      {"max_isometric_force",
       "Maximum isometric force",
       "N",
       0,
       kForceRounding_n,
       [](const MuscleSpec& m) { return m.max_isometric_force; },
       &PublishedParameters::force_n},
      {"optimal_fiber_length",
       "Optimal fiber length",
       "cm",
       1,
       kLengthRounding_cm,
       [](const MuscleSpec& m) { return 100 * m.optimal_fiber_length; },
       &PublishedParameters::fiber_cm},
      {"tendon_slack_length",
       "Tendon slack length",
       "cm",
       1,
       kLengthRounding_cm,
       [](const MuscleSpec& m) { return 100 * m.tendon_slack_length; },
       &PublishedParameters::slack_cm},
      {"pennation_at_optimal",
       "Pennation at optimal fiber length",
       "deg",
       1,
       kAngleRounding_deg,
       [](const MuscleSpec& m) { return toDegrees(m.pennation_at_optimal); },
       &PublishedParameters::pennation_deg},
  };
  return all;
}

void addBar(Series& series, const std::string& category, double value) {
  series.categories.push_back(category);
  series.y.push_back(value);
}

// As in Table II, an asterisk marks the slack length of a rigid tendon.
std::string makeCategory(const MuscleSpec& muscle, const Quantity& quantity) {
  const bool is_marked =
      quantity.printed == &PublishedParameters::slack_cm && muscle.tendon == TendonKind::kRigid;
  return makeMuscleTitle(muscle.name) + (is_marked ? " *" : "");
}

// "Beyond the print's rounding: rectus femoris +0.3 cm" or that there is none.
std::string describeDifferences(const std::vector<ParameterRow>& rows, const Quantity& quantity) {
  std::string list;
  int compared = 0;
  for (const ParameterRow& row : rows) {
    if (row.published == nullptr) {
      continue;
    }
    ++compared;
    const double printed = (row.published->*quantity.printed).mean;
    const double difference = quantity.own(*row.muscle) - printed;
    if (std::abs(difference) > 1.001 * quantity.rounding) {
      list += (list.empty() ? "" : "; ") + makeMuscleTitle(row.muscle->name) +
              (difference > 0 ? " +" : " ") + formatFixed(difference, quantity.decimals + 1);
    }
  }
  if (compared == 0) {
    return "No muscle of this model has a printed value.";
  }
  return list.empty() ? "All " + std::to_string(compared) + " agree to the printed digit."
                      : "Different from the print [" + std::string(quantity.unit) + "]: " + list;
}

Panel makeParameterPanel(const std::vector<ParameterRow>& rows, const Quantity& quantity) {
  Panel panel;
  panel.name = quantity.name;
  panel.title = quantity.title;
  panel.y = {quantity.title, quantity.unit, 0.0};
  Series own = makeSeries("this model", SeriesRole::kSimulated, SeriesMark::kBars);
  Series printed = makeSeries("Rajagopal et al. 2016", SeriesRole::kReference, SeriesMark::kBars);
  for (const ParameterRow& row : rows) {
    const std::string category = makeCategory(*row.muscle, quantity);
    addBar(own, category, quantity.own(*row.muscle));
    addBar(printed,
           category,
           row.published == nullptr ? kNone : (row.published->*quantity.printed).mean);
  }
  panel.series = {own, printed};
  panel.note = describeDifferences(rows, quantity);
  return panel;
}

// A bar series over the muscles of the table.
Series makeBars(const std::vector<ParameterSpread>& rows,
                const std::string& name,
                SeriesRole role,
                const std::function<double(const ParameterSpread&)>& value) {
  Series series = makeSeries(name, role, SeriesMark::kBars);
  for (const ParameterSpread& row : rows) {
    addBar(series, makeMuscleTitle(row.muscle), value(row));
  }
  return series;
}

// "gluteus maximus 3 4.6 (printed 4.9)" of rows that another compartment predicts.
std::string listPredictions(const std::vector<ParameterSpread>& rows,
                            bool ParameterSpread::*is_prediction,
                            const std::function<double(const ParameterSpread&)>& value,
                            const std::function<double(const ParameterSpread&)>& printed,
                            int decimals) {
  std::string list;
  for (const ParameterSpread& row : rows) {
    if (row.*is_prediction) {
      list += (list.empty() ? "" : "; ") + makeMuscleTitle(row.muscle) + " " +
              formatFixed(value(row), decimals) + " (printed " +
              formatFixed(printed(row), decimals) + ")";
    }
  }
  return list;
}

double percentOf(double part, double whole) {
  return 100 * part / whole;
}

Panel makeForcePanel(const std::vector<ParameterSpread>& rows) {
  const auto printed = [](const ParameterSpread& r) {
    return percentOf(r.published->force_n.sd, r.published->force_n.mean);
  };
  const auto recomputed = [](const ParameterSpread& r) {
    const double fiber = r.published->fiber_cm.sd / r.published->fiber_cm.mean;
    return 100 * std::hypot(r.volume_cv, std::isnan(fiber) ? 0.0 : fiber);
  };
  Panel panel;
  panel.name = "force_sd";
  panel.title = "Spread of maximum isometric force";
  panel.y = {"Standard deviation over mean", "%", 0.0};
  panel.series = {
      makeBars(rows, "printed", SeriesRole::kReference, printed),
      makeBars(rows, "recomputed", SeriesRole::kSimulated, recomputed),
      makeBars(rows, "from fiber length alone", SeriesRole::kPassive, [](const ParameterSpread& r) {
        return percentOf(r.published->fiber_cm.sd, r.published->fiber_cm.mean);
      })};
  panel.note =
      "The spread of volume is printed nowhere in the paper: it is inferred from the first "
      "compartment of each measured muscle. Predicted so [%]: " +
      listPredictions(rows, &ParameterSpread::is_prediction_of_force, recomputed, printed, 1) + ".";
  return panel;
}

Panel makeFiberPanel(const std::vector<ParameterSpread>& rows) {
  Panel panel;
  panel.name = "fiber_length_sd";
  panel.title = "Spread of optimal fiber length";
  panel.y = {"Standard deviation", "cm", 0.0};
  panel.series = {makeBars(rows, "printed", SeriesRole::kReference, [](const ParameterSpread& r) {
    return r.published->fiber_cm.sd;
  })};
  panel.note = "Measured: an input of the formulas, not recomputed.";
  return panel;
}

std::string describeMonteCarlo(const std::vector<ParameterSpread>& rows,
                               const ValidationOptions& options) {
  double rejected = 0;
  double most = -1;
  std::string worst;
  int count = 0;
  for (const ParameterSpread& row : rows) {
    if (std::isnan(row.slack.sd)) {
      continue;
    }
    const double fraction = static_cast<double>(row.slack.rejected) / row.slack.draws;
    rejected += fraction;
    ++count;
    if (fraction > most) {
      most = fraction;
      worst = makeMuscleTitle(row.muscle);
    }
  }
  if (count == 0) {
    return "";
  }
  return "Monte Carlo of " + std::to_string(options.draws) + " draws per muscle, seed " +
         std::to_string(options.seed) + "; rejected " + formatFixed(100 * rejected / count, 2) +
         " % of the draws, at most " + formatFixed(100 * most, 1) + " % (" + worst + "). ";
}

std::string describeSlackDifferences(const std::vector<ParameterSpread>& rows) {
  // The input spreads are printed to 0.1 cm, often two digits: a few percent are rounding.
  constexpr double kRemarkable = 0.05;
  std::string list;
  for (const ParameterSpread& row : rows) {
    const double printed = 0.01 * row.published->slack_cm.sd;
    const double ratio = row.slack.sd / printed - 1;
    if (std::abs(ratio) > kRemarkable) {
      list += (list.empty() ? "" : "; ") + makeMuscleTitle(row.muscle) + " " +
              (ratio > 0 ? "+" : "") + formatFixed(100 * ratio, 0) + " %";
    }
  }
  return list.empty() ? "No spread differs by more than 5 % from the print. "
                      : "More than 5 % from the print: " + list + ". ";
}

Panel makeSlackPanel(const std::vector<ParameterSpread>& rows, const ValidationOptions& options) {
  const auto printed = [](const ParameterSpread& r) {
    return r.published->slack_cm.sd;
  };
  const auto recomputed = [](const ParameterSpread& r) {
    return 100 * r.slack.sd;
  };
  Panel panel;
  panel.name = "slack_length_sd";
  panel.title = "Spread of tendon slack length";
  panel.y = {"Standard deviation", "cm", 0.0};
  panel.series = {makeBars(rows, "printed", SeriesRole::kReference, printed),
                  makeBars(rows, "recomputed", SeriesRole::kSimulated, recomputed),
                  makeBars(rows,
                           "from fiber length and pennation alone",
                           SeriesRole::kPassive,
                           [](const ParameterSpread& r) { return 100 * r.slack_by_fiber.sd; })};
  panel.note =
      describeMonteCarlo(rows, options) + describeSlackDifferences(rows) +
      "Predicted from another compartment [cm]: " +
      listPredictions(rows, &ParameterSpread::is_prediction_of_slack, recomputed, printed, 1) + ".";
  return panel;
}

Panel makePennationPanel(const std::vector<ParameterSpread>& rows) {
  Panel panel;
  panel.name = "pennation_sd";
  panel.title = "Spread of pennation at optimal fiber length";
  panel.y = {"Standard deviation", "deg", 0.0};
  panel.series = {
      makeBars(rows,
               "printed",
               SeriesRole::kReference,
               [](const ParameterSpread& r) { return r.published->pennation_deg.sd; }),
      makeBars(rows,
               "from normalised fiber length alone",
               SeriesRole::kPassive,
               [](const ParameterSpread& r) { return toDegrees(r.pennation_by_length); })};
  panel.note =
      "The spread of the measured pennation, the other part, is printed nowhere and cannot be "
      "recomputed.";
  return panel;
}

Panel makeInputPanel(const std::vector<ParameterSpread>& rows) {
  Panel panel;
  panel.name = "inferred_inputs";
  panel.title = "Inputs inferred";
  panel.y = {"Standard deviation over mean", "%", 0.0};
  panel.series = {makeBars(rows,
                           "inferred, volume fraction",
                           SeriesRole::kPlain,
                           [](const ParameterSpread& r) { return 100 * r.volume_cv; }),
                  makeBars(rows,
                           "inferred, normalised fiber length",
                           SeriesRole::kPlain,
                           [](const ParameterSpread& r) { return 100 * r.norm_length_cv; })};
  panel.note =
      "So that the formulas give the printed spreads of one compartment of each measured muscle.";
  return panel;
}

}  // namespace

Figure makeParameterFigure(const ModelSpec& model) {
  const std::vector<ParameterRow> rows = makeRows(model);
  Figure figure;
  figure.name = "parameters";
  figure.title = "Muscle parameters";
  figure.caption =
      "Maximum isometric force, optimal fiber length, tendon slack length and pennation at optimal "
      "fiber length of each muscle of the right leg, beside the values that Rajagopal et al. "
      "(2016) "
      "print for the generic model (Supplemental Table I; Table II differs from it in the last "
      "digit of three slack lengths). * rigid tendon.";
  figure.columns = 1;
  for (const Quantity& quantity : quantities()) {
    figure.panels.push_back(makeParameterPanel(rows, quantity));
  }
  return figure;
}

bool hasVariabilityFigure(const ModelSpec& model) {
  const auto& table = publishedParameters();
  return findRightCoordinate(model, "hip_flexion") != nullptr &&
         std::any_of(table.begin(), table.end(), [&model](const PublishedParameters& row) {
           return findRightMuscle(model, row.muscle).isValid();
         });
}

Figure makeVariabilityFigure(const ModelSpec& model, const ValidationOptions& options) {
  const std::vector<ParameterSpread> rows = calcParameterSpreads(model, options);
  Figure figure;
  figure.name = "parameter_variability";
  figure.title = "Variability of muscle parameters";
  figure.caption =
      "Standard deviations of Supplemental Table I of Rajagopal et al. (2016) and the same "
      "recomputed by the paper's formulas: force from the spreads of muscle volume and fiber "
      "length; tendon slack length by Monte Carlo over optimal fiber length, normalised fiber "
      "length and pennation, calibrating the slack length for every draw; pennation from the "
      "spread of normalised fiber length. Mean normalised fiber lengths are those at which this "
      "model's muscles rest in the calibration pose (hip flexed 7°, abducted 2°, knee 0°, "
      "plantarflexion 20°, activation 1 %). The spreads of volume and of normalised fiber length "
      "are not printed and are inferred; only the compartments listed as predicted test the "
      "formulas. Gluteus minimus, piriformis and tensor fasciae latae have no printed spreads of "
      "length and angle.";
  figure.columns = 1;
  figure.panels = {makeForcePanel(rows),
                   makeFiberPanel(rows),
                   makeSlackPanel(rows, options),
                   makePennationPanel(rows),
                   makeInputPanel(rows)};
  return figure;
}

}  // namespace gaitmill
