#include "core/validation/fiber_length_figure.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/figure/muscle_names.h"
#include "core/sample/gait_pattern.h"
#include "core/validation/muscle_title.h"
#include "core/validation/posed_muscles.h"
#include "core/validation/series.h"

namespace gaitmill {

namespace {

constexpr int kSteps = 100;  ///< of the gait cycle
constexpr double kActivation = 0.01;
/// Right toe-off of the trial that the pattern was fitted to: 1.047 s between heel strikes at 0.248
/// and 1.3925 s (Rajagopal et al. 2016, walking).
constexpr double kToeOff_percent = 69.8;

/// Largest and smallest length that any muscle reaches.
struct Extremes {
  double low = INFINITY;
  double high = -INFINITY;
  std::string low_muscle;
  std::string high_muscle;

  void include(const Series& series) {
    const auto [least, most] = std::minmax_element(series.y.begin(), series.y.end());
    if (*least < low) {
      low = *least;
      low_muscle = series.name;
    }
    if (*most > high) {
      high = *most;
      high_muscle = series.name;
    }
  }
};

bool isRight(const std::string& muscle) {
  return findMuscleBase(muscle) != muscle && muscle.back() == 'r';
}

std::vector<Series> makeLengths(const ModelSpec& model) {
  PosedMuscles posed(model);
  const GaitPattern pattern;
  const GaitMotion motion(posed.model(), pattern);
  Eigen::VectorXd q(posed.model().coordinateCount());
  Eigen::VectorXd rates(q.size());
  Eigen::VectorXd accelerations(q.size());
  std::vector<Series> all;
  for (const MuscleSpec& muscle : model.muscles) {
    all.push_back(makeSeries(makeMuscleTitle(muscle.name)));
  }
  for (int i = 0; i <= kSteps; ++i) {
    motion.calc(pattern.period * i / kSteps, q, rates, accelerations);
    posed.setPose(Eigen::VectorXd(q));
    for (std::size_t m = 0; m < all.size(); ++m) {
      if (isRight(model.muscles[m].name)) {
        const MuscleIndex index(static_cast<int>(m));
        all[m].x.push_back(100.0 * i / kSteps);
        all[m].y.push_back(posed.calcForce(index, kActivation).fiber_length /
                           posed.muscle(index).optimalFiberLength());
      }
    }
  }
  return all;
}

Extremes findExtremes(const std::vector<Series>& series) {
  Extremes extremes;
  for (const Series& one : series) {
    extremes.include(one);
  }
  return extremes;
}

Panel makePanel(const std::string& title, std::vector<Series> series, const Axis& y) {
  Panel panel;
  panel.title = title;
  panel.name = title;
  for (char& letter : panel.name) {
    letter = letter == ' ' ? '_' : static_cast<char>(std::tolower(letter));
  }
  panel.x = {"Gait cycle", "%", 0.0, 100.0};
  panel.y = y;
  panel.guides = {{Guide::Direction::kVertical, kToeOff_percent, "toe-off"},
                  {Guide::Direction::kHorizontal, 1, ""}};
  const Extremes extremes = findExtremes(series);
  panel.note = "From " + formatFixed(extremes.low, 2) + " (" + extremes.low_muscle + ") to " +
               formatFixed(extremes.high, 2) + " (" + extremes.high_muscle + ")";
  panel.series = std::move(series);
  return panel;
}

// One panel for each of the gluteal muscles, whose nine compartments would be too many curves for
// one; one for each group of the others.
std::string findPanelTitle(const MuscleName& muscle) {
  return muscle.group == MuscleGroup::kGluteals ? muscle.display.substr(0, muscle.display.find(','))
                                                : groupName(muscle.group);
}

struct PanelSeries {
  std::string title;
  std::vector<Series> series;
};

std::vector<PanelSeries> groupSeries(const ModelSpec& model, std::vector<Series> lengths) {
  std::map<std::pair<MuscleGroup, std::string>, std::vector<Series>> groups;
  for (std::size_t m = 0; m < lengths.size(); ++m) {
    if (!lengths[m].y.empty()) {
      const MuscleName name = findMuscleName(findMuscleBase(model.muscles[m].name));
      groups[{name.group, findPanelTitle(name)}].push_back(std::move(lengths[m]));
    }
  }
  std::vector<PanelSeries> panels;
  for (auto& [key, series] : groups) {
    panels.push_back({key.second, std::move(series)});
  }
  return panels;
}

// The same ordinate in all panels, its ends on tenths.
Axis makeOrdinate(const std::vector<PanelSeries>& panels) {
  Extremes all;
  for (const PanelSeries& panel : panels) {
    const Extremes extremes = findExtremes(panel.series);
    all.low = std::min(all.low, extremes.low);
    all.high = std::max(all.high, extremes.high);
  }
  return {"Normalised fiber length",
          "",
          std::min(0.9, std::floor(10 * all.low) / 10),
          std::max(1.1, std::ceil(10 * all.high) / 10)};
}

}  // namespace

bool hasFiberLengthFigure(const ModelSpec& model) {
  const bool has_right = std::any_of(model.muscles.begin(),
                                     model.muscles.end(),
                                     [](const MuscleSpec& muscle) { return isRight(muscle.name); });
  if (!has_right) {
    return false;
  }
  try {
    const PosedMuscles posed(model);
    const GaitMotion motion(posed.model(), {});
    return true;
  } catch (const Error&) {
    return false;
  }
}

Figure makeFiberLengthFigure(const ModelSpec& model) {
  std::vector<PanelSeries> panels = groupSeries(model, makeLengths(model));
  const Axis ordinate = makeOrdinate(panels);
  Figure figure;
  figure.name = "fiber_lengths_gait";
  figure.title = "Fiber lengths over a gait cycle";
  figure.caption =
      "Fiber length over optimal fiber length of the right leg's muscles, from right heel strike "
      "to "
      "the next. The motion is gaitmill's embedded walking pattern, five harmonics fitted to the "
      "walking trial of Rajagopal et al. (2016), on this model; no muscle is computed to drive it: "
      "each is in static equilibrium with its tendon at 1 % activation. Dashed: optimal length, "
      "and "
      "toe-off of that trial.";
  figure.columns = 3;
  for (PanelSeries& panel : panels) {
    figure.panels.push_back(makePanel(panel.title, std::move(panel.series), ordinate));
  }
  return figure;
}

}  // namespace gaitmill
