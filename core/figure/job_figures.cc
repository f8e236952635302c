#include "core/figure/job_figures.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/figure/job_builders.h"
#include "core/figure/job_data.h"

namespace gaitmill {

namespace {

/// A table that a figure cannot do without, and a column of it; "" = any.
struct Need {
  const char* table;
  const char* column;
};

struct FigureBuilder {
  const char* name;
  const char* title;
  const char* caption;
  int columns;
  std::vector<Need> needs;
  void (*build)(const JobData& data, Figure& figure);
};

const std::vector<FigureBuilder>& builders() {
  static const std::vector<FigureBuilder> all = {
      {"joint_angles",
       "Joint angles",
       "Coordinates of the motion that the last stage worked on.",
       3,
       {{"kinematics", ""}},
       buildJointAngles},
      {"ground_reactions",
       "Ground reactions",
       "Force under each foot, in newtons and in body weights (BW).",
       3,
       {{"ground_reactions", ""}},
       buildGroundReactions},
      {"moments",
       "Joint moments",
       "Moments of inverse dynamics and, where muscles act, the sum of what the muscles generate.",
       2,
       {{"moments", ""}},
       buildMoments},
      {"moments_active_passive",
       "Active and passive muscle moments",
       "Moments of all muscles at a joint, split into what active and passive fiber forces make.",
       2,
       {{"muscle_moments", ""}},
       buildMomentParts},
      {"joint_powers",
       "Joint powers",
       "Generalized force of inverse dynamics times speed; positive power adds energy to the body.",
       3,
       {{"joint_powers", ""}},
       buildJointPowers},
      {"residuals",
       "Residual forces at the pelvis",
       "What the model needs at the pelvis beyond ground reactions to follow the motion.",
       2,
       {{"residuals", ""}},
       buildResiduals},
      {"reserves",
       "Reserve moments",
       "What actuators at the joints add to the muscles to follow the motion.",
       2,
       {{"reserves", ""}},
       buildReserves},
      {"activations",
       "Muscle activations",
       "Activation of each muscle, 0 at rest to 1.",
       5,
       {{"activations", ""}},
       buildActivations},
      {"activations_emg",
       "Activations and electromyograms",
       "Simulated activation and the envelope of the measured electromyogram.",
       3,
       {{"activations", ""}, {"emg", ""}},
       buildActivationsEmg},
      {"muscle_forces",
       "Muscle forces",
       "Tendon force of each muscle.",
       5,
       {{"forces", ""}, {"activations", ""}},
       buildMuscleForces},
      {"fiber_lengths",
       "Fiber lengths",
       "Fiber length in optimal fiber lengths.",
       5,
       {{"norm_fiber_lengths", ""}},
       buildFiberLengths},
      {"fiber_velocities",
       "Fiber velocities",
       "Fiber velocity in maximum contraction velocities, positive lengthening.",
       5,
       {{"norm_fiber_velocities", ""}},
       buildFiberVelocities},
      {"muscle_powers",
       "Muscle powers",
       "Power of each muscle with its tendon; positive power adds energy to the skeleton.",
       5,
       {{"muscle_powers", ""}},
       buildMusclePowers},
      {"muscle_work",
       "Muscle work per gait cycle",
       "Work of fibers, tendons and both together over one gait cycle.",
       1,
       {{"muscle_work", ""}},
       buildMuscleWork},
      {"joint_reactions",
       "Joint reaction forces",
       "Force on the distal body of a joint in that body's frame, in body weights (BW) where the "
       "mass is known; downward compresses hip, knee and ankle.",
       4,
       {{"joint_reactions", ""}},
       buildJointReactions},
      {"marker_errors",
       "Marker errors",
       "Distance between measured and model markers after inverse kinematics.",
       1,
       {{"marker_errors", ""}},
       buildMarkerErrors},
      {"tracking_errors",
       "Tracking errors",
       "Motion that was asked for minus motion that was simulated.",
       3,
       {{"tracking_errors", ""}},
       buildTrackingErrors},
      {"paper_figure_4",
       "Joint moments, as Figure 4 of Rajagopal et al. 2016",
       "Right hip flexion, knee extension and ankle plantarflexion moments: inverse dynamics "
       "against "
       "the sum over the muscles.",
       3,
       {{"moments", "hip_flexion_r_muscle_moment"},
        {"moments", "knee_angle_r_muscle_moment"},
        {"moments", "ankle_angle_r_muscle_moment"}},
       buildPaperFigure4},
      {"paper_figure_5",
       "Activations and electromyograms, as Figure 5 of Rajagopal et al. 2016",
       "Eight muscle groups of the right leg: simulated activation and electromyogram.",
       4,
       {{"activations", "glmax1_r"}, {"activations", "soleus_r"}, {"emg", ""}},
       buildPaperFigure5},
      {"paper_supplemental_figure_4",
       "Muscle moments, as Supplemental Figure 4 of Rajagopal et al. 2016",
       "Right hip flexion, knee extension and ankle plantarflexion moments of the muscles: total, "
       "active and passive.",
       3,
       {{"muscle_moments", "hip_flexion_r_passive_moment"},
        {"muscle_moments", "knee_angle_r_passive_moment"},
        {"muscle_moments", "ankle_angle_r_passive_moment"}},
       buildPaperSupplementalFigure4},
  };
  return all;
}

bool isPossible(const FigureBuilder& builder, const JobData& data) {
  return std::all_of(builder.needs.begin(), builder.needs.end(), [&](const Need& need) {
    return data.has(need.table, need.column);
  });
}

[[noreturn]] void refuse(const JobData& data, const std::string& name) {
  std::vector<std::string> names;
  std::string list;
  for (const FigureBuilder& builder : builders()) {
    if (isPossible(builder, data)) {
      names.emplace_back(builder.name);
      list.append(list.empty() ? "" : ", ").append(builder.name);
    }
  }
  const std::string nearest = findNearestName(name, names);
  throw Error(ErrorCode::kFigureNotFound,
              "this job has no figure '" + name + "'" +
                  (nearest.empty() ? "" : "; did you mean '" + nearest + "'?") +
                  (nearest.empty() ? "; it has " : " It has ") + (list.empty() ? "none" : list));
}

}  // namespace

std::vector<FigureInfo> listFigures(const ResultSource& source) {
  const JobData data(source);
  std::vector<FigureInfo> figures;
  for (const FigureBuilder& builder : builders()) {
    if (isPossible(builder, data)) {
      figures.push_back({builder.name, builder.title, builder.caption});
    }
  }
  return figures;
}

Figure makeFigure(const ResultSource& source, const std::string& name) {
  const JobData data(source);
  for (const FigureBuilder& builder : builders()) {
    if (builder.name == name && isPossible(builder, data)) {
      Figure figure{builder.name, builder.title, builder.caption, builder.columns, {}};
      builder.build(data, figure);
      return figure;
    }
  }
  refuse(data, name);
}

Panel makePanel(const JobData& data, const std::string& name, const std::string& title, Axis y) {
  Panel panel;
  panel.name = name;
  panel.title = title;
  panel.x = data.makeXAxis();
  panel.y = std::move(y);
  return panel;
}

}  // namespace gaitmill
