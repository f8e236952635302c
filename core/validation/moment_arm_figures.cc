#include "core/validation/moment_arm_figures.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/validation/muscle_title.h"
#include "core/validation/posed_muscles.h"
#include "core/validation/series.h"
#include "core/validation/side.h"

namespace gaitmill {

namespace {

struct ArmPanel {
  ArmJoint joint;
  const char* name;
  const char* title;
  const char* ordinate;
  const char* arm_of;  ///< coordinate whose arm is shown, without side
  double sign;         ///< of the ordinate relative to -dl/dq
  const char* varied;  ///< coordinate on the abscissa, without side
  const char* abscissa;
  double low_deg;
  double high_deg;
  std::vector<std::string> muscles;  ///< without side
};

constexpr const char* kKneeFlexion = "Knee flexion";
constexpr const char* kHipFlexion = "Hip flexion";

// Supplemental Figures 1a-h and 2a-h in their order; the action named on the ordinate is positive.
const std::vector<ArmPanel>& armPanels() {
  static const std::vector<std::string> gluteus_maximus = {"glmax1", "glmax2", "glmax3"};
  static const std::vector<std::string> gluteus_medius = {"glmed1", "glmed2", "glmed3"};
  static const std::vector<ArmPanel> panels = {
      {ArmJoint::kKnee,
       "recfem_vasint",
       "(1a) Rectus femoris, vastus intermedius",
       "Knee extension moment arm",
       "knee_angle",
       -1,
       "knee_angle",
       kKneeFlexion,
       0,
       120,
       {"recfem", "vasint"}},
      {ArmJoint::kKnee,
       "vaslat_vasmed",
       "(1b) Vastus lateralis, vastus medialis",
       "Knee extension moment arm",
       "knee_angle",
       -1,
       "knee_angle",
       kKneeFlexion,
       0,
       120,
       {"vaslat", "vasmed"}},
      {ArmJoint::kKnee,
       "bflh_bfsh",
       "(1c) Biceps femoris",
       "Knee flexion moment arm",
       "knee_angle",
       1,
       "knee_angle",
       kKneeFlexion,
       0,
       120,
       {"bflh", "bfsh"}},
      {ArmJoint::kKnee,
       "semimem_semiten",
       "(1d) Semimembranosus, semitendinosus",
       "Knee flexion moment arm",
       "knee_angle",
       1,
       "knee_angle",
       kKneeFlexion,
       0,
       120,
       {"semimem", "semiten"}},
      {ArmJoint::kKnee,
       "grac_sart",
       "(1e) Gracilis, sartorius",
       "Knee flexion moment arm",
       "knee_angle",
       1,
       "knee_angle",
       kKneeFlexion,
       0,
       120,
       {"grac", "sart"}},
      {ArmJoint::kKnee,
       "gaslat_gasmed",
       "(1f) Gastrocnemius at the knee",
       "Knee flexion moment arm",
       "knee_angle",
       1,
       "knee_angle",
       kKneeFlexion,
       0,
       120,
       {"gaslat", "gasmed"}},
      {ArmJoint::kAnkle,
       "tibant",
       "(1g) Tibialis anterior",
       "Ankle dorsiflexion moment arm",
       "ankle_angle",
       1,
       "ankle_angle",
       "Ankle dorsiflexion",
       -40,
       30,
       {"tibant"}},
      {ArmJoint::kAnkle,
       "gaslat_gasmed_soleus",
       "(1h) Triceps surae",
       "Ankle plantarflexion moment arm",
       "ankle_angle",
       -1,
       "ankle_angle",
       "Ankle dorsiflexion",
       -40,
       30,
       {"gaslat", "gasmed", "soleus"}},
      {ArmJoint::kHip,
       "glmax_extension",
       "(2a) Gluteus maximus",
       "Hip extension moment arm",
       "hip_flexion",
       -1,
       "hip_flexion",
       kHipFlexion,
       -30,
       120,
       gluteus_maximus},
      {ArmJoint::kHip,
       "glmed_extension",
       "(2b) Gluteus medius",
       "Hip extension moment arm",
       "hip_flexion",
       -1,
       "hip_flexion",
       kHipFlexion,
       -30,
       120,
       gluteus_medius},
      {ArmJoint::kHip,
       "glmax_adduction",
       "(2c) Gluteus maximus",
       "Hip adduction moment arm",
       "hip_adduction",
       1,
       "hip_adduction",
       "Hip adduction",
       -50,
       30,
       gluteus_maximus},
      {ArmJoint::kHip,
       "glmed_adduction",
       "(2d) Gluteus medius",
       "Hip adduction moment arm",
       "hip_adduction",
       1,
       "hip_adduction",
       "Hip adduction",
       -50,
       30,
       gluteus_medius},
      {ArmJoint::kHip,
       "glmax_rotation",
       "(2e) Gluteus maximus",
       "Hip internal rotation moment arm",
       "hip_rotation",
       1,
       "hip_flexion",
       kHipFlexion,
       -30,
       120,
       gluteus_maximus},
      {ArmJoint::kHip,
       "glmed_rotation",
       "(2f) Gluteus medius",
       "Hip internal rotation moment arm",
       "hip_rotation",
       1,
       "hip_flexion",
       kHipFlexion,
       -30,
       120,
       gluteus_medius},
      {ArmJoint::kHip,
       "psoas_flexion",
       "(2g) Psoas",
       "Hip flexion moment arm",
       "hip_flexion",
       1,
       "hip_flexion",
       kHipFlexion,
       -30,
       120,
       {"psoas"}},
      {ArmJoint::kHip,
       "semimem_semiten_flexion",
       "(2h) Semimembranosus, semitendinosus",
       "Hip flexion moment arm",
       "hip_flexion",
       1,
       "hip_flexion",
       kHipFlexion,
       -30,
       120,
       {"semimem", "semiten"}},
  };
  return panels;
}

bool hasPanel(const ModelSpec& model, const ArmPanel& panel) {
  const CoordinateSpec* varied = findRightCoordinate(model, panel.varied);
  return varied != nullptr && findRightCoordinate(model, panel.arm_of) != nullptr &&
         !makeSweep(*varied, panel.low_deg, panel.high_deg).empty() &&
         !findRightMuscles(model, panel.muscles).empty();
}

// "4.9 cm at 25 deg": where each curve is largest in magnitude.
std::string describePeak(const Series& series) {
  std::size_t peak = 0;
  for (std::size_t i = 0; i < series.y.size(); ++i) {
    if (std::abs(series.y[i]) > std::abs(series.y[peak])) {
      peak = i;
    }
  }
  return series.name + " " + formatFixed(series.y[peak], 1) + " cm at " +
         formatFixed(series.x[peak], 0) + "°";
}

Panel makePanel(PosedMuscles& posed, const ArmPanel& shown) {
  const ModelSpec& spec = posed.model().spec();
  const std::string varied = std::string(shown.varied) + "_r";
  const CoordinateIndex arm_of = posed.model().getCoordinate(std::string(shown.arm_of) + "_r");
  const std::vector<MuscleIndex> muscles = findRightMuscles(spec, shown.muscles);

  Panel panel;
  panel.name = shown.name;
  panel.title = shown.title;
  panel.x = {shown.abscissa, "deg"};
  panel.y = {shown.ordinate, "cm"};
  for (const MuscleIndex m : muscles) {
    panel.series.push_back(
        makeSeries(makeMuscleTitle(spec.muscles[static_cast<std::size_t>(m.value())].name)));
  }
  for (const double angle :
       makeSweep(*spec.findCoordinate(varied), shown.low_deg, shown.high_deg)) {
    posed.setPose({{varied, angle}});
    for (std::size_t i = 0; i < muscles.size(); ++i) {
      panel.series[i].x.push_back(toDegrees(angle));
      panel.series[i].y.push_back(100 * shown.sign * posed.findMomentArm(muscles[i], arm_of));
    }
  }
  for (const Series& series : panel.series) {
    panel.note += (panel.note.empty() ? "Largest: " : "; ") + describePeak(series);
  }
  return panel;
}

struct JointText {
  const char* name;
  const char* title;
  const char* source;
};

JointText describe(ArmJoint joint) {
  switch (joint) {
    case ArmJoint::kHip:
      return {"hip_moment_arms", "Moment arms at the hip", "Supplemental Figure 2a-h"};
    case ArmJoint::kKnee:
      return {"knee_moment_arms", "Moment arms at the knee", "Supplemental Figure 1a-f"};
    case ArmJoint::kAnkle:
      return {"ankle_moment_arms", "Moment arms at the ankle", "Supplemental Figure 1g, h"};
  }
  return {"", "", ""};
}

}  // namespace

bool hasMomentArmFigure(const ModelSpec& model, ArmJoint joint) {
  return std::any_of(armPanels().begin(), armPanels().end(), [&](const ArmPanel& panel) {
    return panel.joint == joint && hasPanel(model, panel);
  });
}

Figure makeMomentArmFigure(const ModelSpec& model, ArmJoint joint) {
  const JointText text = describe(joint);
  Figure figure;
  figure.name = text.name;
  figure.title = text.title;
  figure.caption =
      std::string(
          "Moment arm of each muscle's path, the shortening of the path per angle with the "
          "patella moving along with the knee. Right leg; angles that are not on the "
          "abscissa are 0. The action named on the ordinate is positive. Muscles, ranges "
          "and ordinates of Rajagopal et al. (2016), ") +
      text.source + ".";
  PosedMuscles posed(model);
  for (const ArmPanel& panel : armPanels()) {
    if (panel.joint == joint && hasPanel(model, panel)) {
      figure.panels.push_back(makePanel(posed, panel));
    }
  }
  return figure;
}

}  // namespace gaitmill
