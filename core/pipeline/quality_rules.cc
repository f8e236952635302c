// The checklist as a table: figures of the OpenSim documentation's list of questions for evaluating
// a simulation, of Hicks et al. (2015), J Biomech Eng 137:020905, and of Rajagopal et al. (2016),
// IEEE Trans Biomed Eng 63:2068. Where none of them gives a figure, the source is gaitmill and says
// why.
#include "core/pipeline/quality_rules.h"

#include <limits>

#include "core/base/error.h"

namespace gaitmill {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

constexpr const char* kChecklist = "OpenSim checklist";
constexpr const char* kHicks = "Hicks et al. 2015";
constexpr const char* kPaper = "Rajagopal et al. 2016";
constexpr const char* kTwice = "gaitmill: twice the limit";
constexpr const char* kNoFailure = "";

// Texts that several rules share.
constexpr const char* kTrackingCause =
    "The simulation gives way where the measured motion and the measured forces contradict each "
    "other: the motion of {worst} is the one that bends most.";
constexpr const char* kRraTrackingFix =
    "Raise the weight of {worst} in rra.passes[].weights, and lower that of coordinates that are "
    "followed much more closely than the limit asks for. Check that forces and markers are "
    "synchronous and that the low-pass cutoff (rra.lowpass_cutoff_hz) suits the movement: 6 Hz for "
    "walking, 15 Hz for running.";
constexpr const char* kCmcTrackingCause =
    "The muscles cannot follow the motion of {worst}: they are too weak or switched off where it "
    "needs them, or the motion before computed muscle control is not smooth.";
constexpr const char* kCmcTrackingFix =
    "Look at the reserves and at saturated muscles of the same joint first. Check "
    "cmc.excitation_limits and strength.law; then raise cmc.position_gain and cmc.velocity_gain "
    "together (velocity gain = 2 sqrt(position gain)).";
constexpr const char* kResidualForceCause =
    "Motion, mass and ground reaction do not fit together. Usual reasons: a ground contact that no "
    "force plate recorded, forces and markers that are not synchronous, a wrong body mass, or "
    "accelerations that are noisy because the cutoff frequency is too high.";
constexpr const char* kResidualForceFix =
    "Check that both feet stand on plates throughout the analysed time and shorten "
    "rra.time_range_s otherwise. Compare the subject's mass with the mean vertical force in quiet "
    "standing. Then lower rra.lowpass_cutoff_hz, or rra.actuators.residuals.optimal_force_n, or "
    "the weights of the pelvis' translations.";
constexpr const char* kResidualMomentCause =
    "The ground reaction does not pass the body where the motion needs it to. Usual reasons: force "
    "plates that are registered wrongly in the laboratory, a centre of pressure that jumps while "
    "the foot is hardly loaded, or a trunk whose mass centre is misplaced.";
constexpr const char* kResidualMomentFix =
    "Check position and axes of the plates against the markers of the feet (trial.plates), raise "
    "trial.force_threshold_n, and let residual reduction move the trunk's mass centre in more "
    "passes (rra.max_passes). Lowering the weights of pelvis_tilt, pelvis_list and the lumbar "
    "coordinates trades residual moment for tracking error.";
constexpr const char* kReserveCause =
    "The muscles of the joint cannot give the moment that the motion asks for: they are too weak "
    "for the subject or the task, act at fiber lengths where they have little force, or are "
    "switched off by a limit of their excitation.";
constexpr const char* kReserveFix =
    "Check the subject's mass and height (they set the muscles' strength), strength.law and "
    "strength.max_contraction_velocity; loosen cmc.excitation_limits for muscles of this joint; "
    "lower the reserve's optimal force in the settings' actuators.coordinates, so that it costs "
    "more. A moment that is too large already in inverse dynamics points to the force plate or to "
    "the filter instead.";
constexpr const char* kInfeasibleCause =
    "Even with all muscles, reserves and residuals at their bounds the joint moments cannot be "
    "produced at these instants.";
constexpr const char* kInfeasibleFix =
    "Raise the control_limit of the reserves and residuals so that the simulation runs, and see "
    "which joint needs them: that joint's muscles, moments or excitation limits are what is wrong.";
constexpr const char* kSaturationCause =
    "A muscle at its maximum has nothing left to give: its share goes to other muscles or to "
    "reserves, and its activation says that it is too weak rather than how active it was.";
constexpr const char* kSaturationFix =
    "Compare {worst} with its measured activity. If the subject is strong or the movement "
    "vigorous, check mass and height and strength.law; if a synergist is switched off, loosen its "
    "limit in cmc.excitation_limits.";

}  // namespace

const std::vector<QualityRule>& qualityRules() {
  static const std::vector<QualityRule> rules = {
      // scale
      {"scale",
       "static_pose_rms",
       "cm",
       1,
       4,
       kChecklist,
       "gaitmill: a published walking trial has 3.0 cm",
       "the model in the static pose misses its markers by an RMS of",
       "Segments that are scaled wrongly, markers that sit elsewhere on the subject than on the "
       "model, or a standing pose unlike the one that the placement expects. Markers are moved "
       "onto the measured points afterwards, so inverse kinematics does not show this error: it "
       "hides as an offset of joint angles.",
       "Compare the static pose with a photograph. Correct marker locations and measurements in "
       "the marker set, prefer measurements between joint centres, and lower the placement weight "
       "of markers that do not sit on bone."},
      {"scale",
       "static_pose_peak",
       "cm",
       2,
       10,
       kChecklist,
       "gaitmill: a published walking trial has 8.8 cm",
       "in the static pose the model misses a marker by",
       "{worst} does not sit on the model where it sat on the subject, or its segment is scaled "
       "wrongly. The limit is meant for bony landmarks and joint centres; a marker on soft tissue "
       "or clothing may be further off without harm.",
       "If {worst} is a bony landmark, correct its location or its segment's measurement in the "
       "marker set; if it is not, lower its weight in the placement."},
      {"scale",
       "scale_factor_deviation",
       "%",
       40,
       80,
       "gaitmill: 0.7 to 1.4 of the generic 1.70 m spans heights of 1.2 to 2.4 m",
       kTwice,
       "a body is scaled away from the generic model by",
       "{worst} would be far from human proportions. Usual reasons: swapped or misnamed markers in "
       "the static trial, markers in wrong units, or a pair of markers that includes a shoe sole.",
       "Look at the marker pairs that measure {worst} in the marker set and at their distances in "
       "the static trial; replace the pair, or state the factor under scale.manual."},
      {"scale",
       "scale_side_difference",
       "%",
       6,
       12,
       "gaitmill: 6 % of a thigh is 2.5 cm, more than healthy legs differ by",
       kTwice,
       "the right and the left side are scaled differently by",
       "One of the two sides of {worst} is measured wrongly, unless the subject's limbs do differ.",
       "Compare the distances of the marker pairs on both sides in the static trial, or give both "
       "sides one measurement in the marker set."},
      {"scale",
       "model_mass_difference",
       "%",
       2,
       5,
       "gaitmill: clothes and markers weigh up to 2 % of the body",
       "gaitmill: more than a meal and a change of clothes",
       "the model's mass differs from the subject's by",
       "The model that was given belongs to another mass than the trial states.",
       "Give the mass of the day of the recording, or scale the model again."},
      // inverse kinematics
      {"ik",
       "marker_error_rms",
       "cm",
       2,
       4,
       kChecklist,
       kTwice,
       "inverse kinematics misses the markers by an RMS of up to",
       "Many markers are off at once: the model's segments have other lengths than the subject's, "
       "or its markers were placed in a static pose that did not fit.",
       "Look at the static pose first. Then see which markers have the largest mean error in the "
       "table of markers: a large mean means a misplaced marker, a large peak with a small mean "
       "means soft tissue or a mislabelled frame."},
      {"ik",
       "marker_error_peak",
       "cm",
       4,
       8,
       kChecklist,
       kTwice,
       "inverse kinematics misses a marker by",
       "{worst} moves away from its place on the model: skin and clothing that move, two markers "
       "that were swapped for some frames, or a place on the model that is wrong by that much.",
       "Look at {worst} in the recording at the frame of its largest error. Repair the labels, or "
       "correct its location in the marker set, or lower its weight under ik."},
      {"ik",
       "marker_gaps",
       "%",
       20,
       kNever,
       "gaitmill: a marker seen in fewer than 80 % of the frames is unreliable",
       kNoFailure,
       "a marker is missing, in share of all frames, in",
       "{worst} was hidden from the cameras. Each time it comes or goes, the pose may jump.",
       "Fill the gaps in the motion capture software, or leave {worst} out by giving it weight 0."},
      {"ik",
       "ik_unconverged",
       "%",
       0,
       5,
       "gaitmill: every frame has a best pose, and the solver should find it",
       "gaitmill: as for infeasible instants",
       "no best pose was found, in share of all frames, in",
       "Too few markers were seen in these frames, or markers are mislabelled.",
       "Look at the frames that are named in the warnings, or leave them out with "
       "ik.time_range_s."},
      // inverse dynamics
      {"id",
       "id_residual_force_peak",
       "N",
       25,
       kNever,
       "Hicks et al. 2015, OpenSim checklist: the larger of 25 N and 5 % of the peak ground "
       "reaction",
       kNoFailure,
       "inverse dynamics leaves a force without an origin, of up to",
       "The motion, the model's masses and the ground reaction contradict each other to this "
       "extent. Moments at ankle and knee suffer little from it, moments at hip and trunk more.",
       "Run residual reduction (stage rra) if it was left out. Check that all ground contacts were "
       "recorded and that the motion is filtered (id.lowpass_cutoff_hz)."},
      {"id",
       "id_residual_moment_peak",
       "N.m",
       75,
       kNever,
       kChecklist,
       kNoFailure,
       "inverse dynamics leaves a moment without an origin, of up to",
       kResidualMomentCause,
       "Run residual reduction (stage rra) if it was left out, and check the registration of the "
       "force plates."},
      // residual reduction
      {"rra",
       "rra_tracking_rotation_rms",
       "deg",
       2,
       4,
       kChecklist,
       kTwice,
       "residual reduction departs from the motion by an RMS rotation of",
       kTrackingCause,
       kRraTrackingFix},
      {"rra",
       "rra_tracking_rotation_peak",
       "deg",
       5,
       10,
       kChecklist,
       kTwice,
       "residual reduction departs from the motion by a rotation of up to",
       kTrackingCause,
       kRraTrackingFix},
      {"rra",
       "rra_tracking_translation_rms",
       "cm",
       2,
       4,
       kChecklist,
       kTwice,
       "residual reduction departs from the motion by an RMS translation of",
       kTrackingCause,
       kRraTrackingFix},
      {"rra",
       "rra_tracking_translation_peak",
       "cm",
       5,
       10,
       kChecklist,
       kTwice,
       "residual reduction departs from the motion by a translation of up to",
       kTrackingCause,
       kRraTrackingFix},
      {"rra",
       "rra_residual_force_peak",
       "N",
       25,
       50,
       "Hicks et al. 2015, OpenSim checklist: the larger of 25 N and 5 % of the peak ground "
       "reaction",
       kTwice,
       "after residual reduction the residual force peaks at",
       kResidualForceCause,
       kResidualForceFix},
      {"rra",
       "rra_residual_force_rms",
       "N",
       15,
       30,
       kChecklist,
       kTwice,
       "after residual reduction the residual force has an RMS of",
       kResidualForceCause,
       kResidualForceFix},
      {"rra",
       "rra_residual_moment_peak",
       "N.m",
       75,
       150,
       kChecklist,
       kTwice,
       "after residual reduction the residual moment peaks at",
       kResidualMomentCause,
       kResidualMomentFix},
      {"rra",
       "rra_residual_moment_rms",
       "N.m",
       50,
       100,
       kChecklist,
       kTwice,
       "after residual reduction the residual moment has an RMS of",
       kResidualMomentCause,
       kResidualMomentFix},
      {"rra",
       "rra_mass_change",
       "%",
       2,
       5,
       "gaitmill: clothes and markers weigh up to 2 % of the body; published trials ask for 0.8 %",
       "gaitmill: more than a meal and a change of clothes",
       "over all passes residual reduction changes the body's mass by",
       "The vertical ground reaction carries another mass than the subject's: a wrong mass, a "
       "plate with an offset, or a contact that was not recorded.",
       "Compare the subject's mass with the mean vertical force in quiet standing, and check the "
       "zero of the force plates."},
      {"rra",
       "rra_center_shift",
       "cm",
       5,
       10,
       "gaitmill: published trials ask for 2.5 cm, and 10 cm is as far as one pass may go",
       kTwice,
       "over all passes residual reduction shifts the trunk's mass centre by",
       "The ground reaction's lever arm contradicts the posture: force plates that are registered "
       "wrongly, a forward direction that is mistaken, or trunk markers that lean.",
       "Check position and axes of the plates against the feet, and the trunk's lean in the static "
       "pose."},
      // static optimization
      {"so",
       "so_infeasible",
       "%",
       0,
       5,
       "gaitmill: every instant needs forces that produce it",
       "gaitmill: more than a few instants at contact and toe-off",
       "the muscles cannot produce the motion, in share of all instants, at",
       kInfeasibleCause,
       kInfeasibleFix},
      {"so",
       "so_joint_reserve",
       "%",
       10,
       20,
       kChecklist,
       kTwice,
       "in static optimization a reserve helps the muscles, in share of its joint's largest "
       "moment, by up to",
       kReserveCause,
       kReserveFix},
      {"so",
       "so_saturation",
       "ms",
       100,
       kNever,
       "gaitmill: 2.5 times the 40 ms in which a muscle relaxes",
       kNoFailure,
       "in static optimization a muscle stays at full activation for",
       kSaturationCause,
       kSaturationFix},
      // computed muscle control
      {"cmc",
       "cmc_tracking_rotation_rms",
       "deg",
       2,
       4,
       kChecklist,
       kTwice,
       "computed muscle control departs from the motion by an RMS rotation of",
       kCmcTrackingCause,
       kCmcTrackingFix},
      {"cmc",
       "cmc_tracking_rotation_peak",
       "deg",
       5,
       10,
       kChecklist,
       kTwice,
       "computed muscle control departs from the motion by a rotation of up to",
       kCmcTrackingCause,
       kCmcTrackingFix},
      {"cmc",
       "cmc_tracking_translation_rms",
       "cm",
       2,
       4,
       kChecklist,
       kTwice,
       "computed muscle control departs from the motion by an RMS translation of",
       kCmcTrackingCause,
       kCmcTrackingFix},
      {"cmc",
       "cmc_tracking_translation_peak",
       "cm",
       5,
       10,
       kChecklist,
       kTwice,
       "computed muscle control departs from the motion by a translation of up to",
       kCmcTrackingCause,
       kCmcTrackingFix},
      {"cmc",
       "residual_force_peak",
       "N",
       25,
       50,
       "Hicks et al. 2015, OpenSim checklist: the larger of 25 N and 5 % of the peak ground "
       "reaction",
       kTwice,
       "the residual force at the pelvis peaks at",
       kResidualForceCause,
       kResidualForceFix},
      {"cmc",
       "residual_force_rms",
       "N",
       10,
       20,
       kChecklist,
       kTwice,
       "the residual force at the pelvis has an RMS of",
       kResidualForceCause,
       kResidualForceFix},
      {"cmc",
       "residual_moment_peak",
       "N.m",
       75,
       150,
       kChecklist,
       kTwice,
       "the residual moment at the pelvis peaks at",
       kResidualMomentCause,
       kResidualMomentFix},
      {"cmc",
       "residual_moment_rms",
       "N.m",
       50,
       100,
       kChecklist,
       kTwice,
       "the residual moment at the pelvis has an RMS of",
       kResidualMomentCause,
       kResidualMomentFix},
      {"cmc",
       "residual_moment_share",
       "%",
       1,
       kNever,
       kHicks,
       kNoFailure,
       "the residual moment, in share of the mass centre's height times the peak ground reaction, "
       "peaks at",
       kResidualMomentCause,
       kResidualMomentFix},
      {"cmc",
       "reserve_peak",
       "%",
       10,
       20,
       kHicks,
       kTwice,
       "a reserve actuator helps the muscles, in share of the largest joint moment, by up to",
       kReserveCause,
       kReserveFix},
      {"cmc",
       "joint_reserve",
       "%",
       10,
       20,
       kChecklist,
       kTwice,
       "a reserve helps the muscles, in share of its joint's largest moment, by up to",
       kReserveCause,
       kReserveFix},
      {"cmc",
       "moment_rmse",
       "%",
       3,
       6,
       kPaper,
       kTwice,
       "muscle moments differ from inverse dynamics, RMS in share of the peak, by",
       "Reserves carry part of the moment of {worst}, or the simulation departs from the motion "
       "that inverse dynamics analysed.",
       "See the reserve of {worst} and the tracking errors of computed muscle control; both tell "
       "where the difference comes from."},
      {"cmc",
       "moment_peak_difference",
       "%",
       11,
       22,
       kPaper,
       kTwice,
       "muscle moments differ from inverse dynamics, in share of the peak, by up to",
       "At some instant the muscles of {worst} cannot follow: mostly at foot strike or toe-off, "
       "where moments change within a few milliseconds, or where a limit switches a muscle off.",
       "Find the instant in the figure of joint moments. Filter forces and motion alike "
       "(trial.force_lowpass_cutoff_hz, rra.lowpass_cutoff_hz), and check "
       "cmc.excitation_limits around it."},
      {"cmc",
       "saturation",
       "ms",
       100,
       kNever,
       "gaitmill: ten control windows, 2.5 times the 40 ms in which a muscle relaxes",
       kNoFailure,
       "a muscle stays at full excitation for",
       kSaturationCause,
       kSaturationFix},
      {"cmc",
       "fiber_length_share",
       "%",
       5,
       10,
       "gaitmill: fibers give force between 0.5 and 1.5 optimal lengths (Zajac 1989); 5 % as Hicks "
       "et al. 2015 grant to other unphysical forces",
       kTwice,
       "of all active force over time, fibers outside 0.5 to 1.5 optimal lengths give",
       "{worst} works at lengths where real fibers give hardly any force: its optimal fiber or "
       "tendon slack length does not fit the scaled path, or a joint angle is offset.",
       "Check the joint angles against the literature. Calibrate the tendon slack lengths of the "
       "scaled model (gaitmill model calibrate), {worst} first."},
      {"cmc",
       "residual_work",
       "%",
       5,
       kNever,
       "gaitmill: work that nobody did, held to the 5 % that Hicks et al. 2015 grant to residual "
       "forces",
       kNoFailure,
       "of all work over the cycle, the residuals at the pelvis do",
       kResidualForceCause,
       kResidualForceFix},
      {"cmc",
       "work_imbalance",
       "%",
       5,
       kNever,
       "gaitmill: energy is conserved; stored rows close the balance to about 1 %",
       kNoFailure,
       "of all work over the cycle, no force accounts for",
       "The forces as stored do not explain the change of the body's energy: the simulation takes "
       "steps that are too long for it, or a contact changes within a step.",
       "Lower cmc.integration_step_s, and filter the ground reactions "
       "(trial.force_lowpass_cutoff_hz)."},
      {"cmc",
       "emg_timing",
       "%",
       50,
       kNever,
       "gaitmill: the paper compares by eye; muscles that are on and off by chance disagree half "
       "of "
       "the time",
       kNoFailure,
       "on the mean of all channels, muscles are on while their EMG is off, or off while it is on, "
       "in share of the cycle, for",
       "The simulated muscles work at other times than the measured ones, {worst} most of all: "
       "electrodes that hear a neighbour, channels that are mapped to the wrong muscle, EMG and "
       "motion that are not synchronous, or co-contraction, which a minimum of effort never shows.",
       "Look at the figure of activations and EMG. Check the mapping under emg.channels and the "
       "side, and the synchronisation of the recordings; state the electromechanical delay if the "
       "simulation is early throughout."},
      {"cmc",
       "cmc_infeasible",
       "%",
       0,
       5,
       "gaitmill: every window needs forces that produce it",
       "gaitmill: more than a few windows at contact and toe-off",
       "the muscles cannot produce the motion, in share of all instants, at",
       kInfeasibleCause,
       kInfeasibleFix},
      {"cmc",
       "cmc_finished",
       "",
       0,
       0,
       "gaitmill: a simulation that stops is no result",
       kNoFailure,
       "the forward simulation ran away from the motion before its end",
       "The muscles and reserves could not hold the body to the motion, so that the errors grew "
       "until the simulation was stopped.",
       "See the infeasible windows before the end. Raise the control_limit of reserves and "
       "residuals, shorten cmc.window_s, or end cmc.time_range_s earlier."},
  };
  return rules;
}

namespace {

std::string fillIn(const char* text, const std::string& worst) {
  constexpr const char* kPlace = "{worst}";
  const std::string value = worst.empty() ? "the worst" : worst;
  std::string filled = text;
  for (std::size_t at = filled.find(kPlace); at != std::string::npos;
       at = filled.find(kPlace, at)) {
    filled.replace(at, std::string(kPlace).size(), value);
    at += value.size();
  }
  return filled;
}

}  // namespace

QualityCheck makeQualityCheck(const std::string& figure, double value, const std::string& worst) {
  for (const QualityRule& rule : qualityRules()) {
    if (figure != rule.figure) {
      continue;
    }
    QualityCheck made;
    made.stage = rule.stage;
    made.figure = rule.figure;
    made.worst = worst;
    made.unit = rule.unit;
    made.value = value;
    made.limit = rule.limit;
    made.fail_above = rule.fail_above;
    made.meaning = rule.meaning;
    made.source = rule.source;
    made.fail_source = rule.fail_source;
    made.cause = fillIn(rule.cause, worst);
    made.fix = fillIn(rule.fix, worst);
    return made;
  }
  throw Error(ErrorCode::kInternal, "there is no quality rule '" + figure + "'");
}

}  // namespace gaitmill
