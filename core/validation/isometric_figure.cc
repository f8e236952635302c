#include "core/validation/isometric_figure.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/validation/isometric_moments.h"
#include "core/validation/series.h"
#include "core/validation/side.h"

namespace gaitmill {

namespace {

enum class MomentKind { kPassive, kActive };

struct MomentPanel {
  const char* name;
  const char* title;
  MomentKind kind;
  const char* varied;  ///< coordinate on the abscissa and of the moment, without side
  const char* abscissa;
  const char* ordinate;
  const char* positive;  ///< action of a positive moment
  const char* negative;
  double low_deg;
  double high_deg;
  const char* fixed;  ///< coordinate held elsewhere than at 0, empty = none
  double fixed_deg;
};

// Supplemental Figure 3a-g in its order.
constexpr MomentPanel kPanels[] = {
    {"hip_flexion_passive",
     "(a) Hip, passive",
     MomentKind::kPassive,
     "hip_flexion",
     "Hip flexion",
     "Passive hip flexion moment",
     "flexion",
     "extension",
     -30,
     120,
     "knee_angle",
     10},
    {"hip_flexion_active",
     "(b) Hip flexors and extensors",
     MomentKind::kActive,
     "hip_flexion",
     "Hip flexion",
     "Hip flexion moment",
     "flexion",
     "extension",
     -30,
     120,
     "knee_angle",
     10},
    {"hip_adduction_active",
     "(c) Hip adductors and abductors",
     MomentKind::kActive,
     "hip_adduction",
     "Hip adduction",
     "Hip adduction moment",
     "adduction",
     "abduction",
     -50,
     30,
     "",
     0},
    {"knee_passive",
     "(d) Knee, passive",
     MomentKind::kPassive,
     "knee_angle",
     "Knee flexion",
     "Passive knee flexion moment",
     "flexion",
     "extension",
     0,
     120,
     "hip_flexion",
     70},
    {"knee_active",
     "(e) Knee flexors and extensors",
     MomentKind::kActive,
     "knee_angle",
     "Knee flexion",
     "Knee flexion moment",
     "flexion",
     "extension",
     0,
     120,
     "hip_flexion",
     70},
    {"ankle_passive",
     "(f) Ankle, passive",
     MomentKind::kPassive,
     "ankle_angle",
     "Ankle dorsiflexion",
     "Passive ankle dorsiflexion moment",
     "dorsiflexion",
     "plantarflexion",
     -40,
     30,
     "knee_angle",
     80},
    {"ankle_active",
     "(g) Ankle dorsiflexors and plantarflexors",
     MomentKind::kActive,
     "ankle_angle",
     "Ankle dorsiflexion",
     "Ankle dorsiflexion moment",
     "dorsiflexion",
     "plantarflexion",
     -40,
     30,
     "knee_angle",
     80},
};

bool hasPanel(const ModelSpec& model, const MomentPanel& panel) {
  const CoordinateSpec* varied = findRightCoordinate(model, panel.varied);
  const std::string fixed = panel.fixed;
  return varied != nullptr && !makeSweep(*varied, panel.low_deg, panel.high_deg).empty() &&
         (fixed.empty() || findRightCoordinate(model, fixed) != nullptr);
}

// "flexion 130 N·m at 12°": where a curve is largest in magnitude.
std::string describePeak(const Series& series) {
  const auto peak = std::max_element(series.y.begin(), series.y.end(), [](double a, double b) {
    return std::abs(a) < std::abs(b);
  });
  const double angle = series.x[static_cast<std::size_t>(peak - series.y.begin())];
  return series.name + " " + formatFixed(*peak, 0) + " N·m at " + formatFixed(angle, 0) + "°";
}

Panel makePanel(PosedMuscles& posed, const MomentPanel& shown) {
  const std::string varied = std::string(shown.varied) + "_r";
  const CoordinateIndex coordinate = posed.model().getCoordinate(varied);
  std::vector<CoordinateValue> pose = {{varied, 0}};
  if (std::string(shown.fixed) != "") {
    pose.push_back({std::string(shown.fixed) + "_r", toRadians(shown.fixed_deg)});
  }
  Panel panel;
  panel.name = shown.name;
  panel.title = shown.title;
  panel.x = {shown.abscissa, "deg"};
  panel.y = {shown.ordinate, "N·m"};
  Series passive = makeSeries("passive", SeriesRole::kPassive);
  Series positive = makeSeries(shown.positive, SeriesRole::kPlain);
  Series negative = makeSeries(shown.negative, SeriesRole::kPlain);
  for (const double angle :
       makeSweep(posed.model().coordinate(coordinate), shown.low_deg, shown.high_deg)) {
    pose.front().value = angle;
    posed.setPose(pose);
    const IsometricMoments moments = calcIsometricMoments(posed, coordinate);
    const auto add = [angle](Series& series, double moment) {
      series.x.push_back(toDegrees(angle));
      series.y.push_back(moment);
    };
    add(passive, moments.passive);
    add(positive, moments.positive);
    add(negative, moments.negative);
  }
  panel.series = shown.kind == MomentKind::kPassive ? std::vector<Series>{passive}
                                                    : std::vector<Series>{positive, negative};
  for (const Series& series : panel.series) {
    panel.note += (panel.note.empty() ? "Largest: " : "; ") + describePeak(series);
  }
  panel.guides = {{Guide::Direction::kHorizontal, 0, ""}};
  return panel;
}

}  // namespace

bool hasIsometricFigure(const ModelSpec& model) {
  return !model.muscles.empty() &&
         std::any_of(std::begin(kPanels), std::end(kPanels), [&model](const MomentPanel& panel) {
           return hasPanel(model, panel);
         });
}

Figure makeIsometricFigure(const ModelSpec& model) {
  Figure figure;
  figure.name = "isometric_moments";
  figure.title = "Maximum isometric and passive joint moments";
  figure.caption =
      "Joint moments of the right leg's muscles held still, in the poses of Rajagopal et al. "
      "(2016), Supplemental Figure 3a-g: at the hip with the knee at 10°, at the knee with the hip "
      "flexed 70°, at the ankle with the knee at 80°, other angles 0. Agonists, the muscles whose "
      "moment arm has the sign of the moment at that angle, are at activation 1 with fiber and "
      "tendon in equilibrium; their antagonists add passive force. Passive: stretched fibers of "
      "all muscles.";
  PosedMuscles posed(model);
  for (const MomentPanel& panel : kPanels) {
    if (hasPanel(model, panel)) {
      figure.panels.push_back(makePanel(posed, panel));
    }
  }
  return figure;
}

}  // namespace gaitmill
