#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/analysis/acceptance.h"
#include "core/analysis/emg_channels.h"
#include "core/analysis/emg_comparison.h"
#include "core/analysis/emg_envelope.h"
#include "core/analysis/foot_contacts.h"
#include "core/analysis/gait.h"
#include "core/analysis/joint_reserves.h"
#include "core/analysis/marker_statistics.h"
#include "core/analysis/muscle_analysis.h"
#include "core/analysis/muscle_limits.h"
#include "core/analysis/power_balance.h"
#include "core/analysis/quality_check.h"
#include "core/cmc/cmc_result.h"
#include "core/data/decision.h"
#include "core/data/ground_reaction.h"
#include "core/data/marker_set.h"
#include "core/data/marker_trajectories.h"
#include "core/data/model_spec.h"
#include "core/data/time_series.h"
#include "core/id/id_result.h"
#include "core/ik/ik_result.h"
#include "core/intake/marker_faults.h"
#include "core/intake/marker_names.h"
#include "core/math/events.h"
#include "core/pipeline/pipeline.h"
#include "core/pipeline/settings.h"
#include "core/rra/rra_result.h"
#include "core/scale/scale_result.h"
#include "core/so/so_result.h"

namespace gaitmill {

/// What follows from muscle forces, of CMC where it ran, else of static optimization.
struct JobAnalysis {
  MuscleAnalysis muscles;
  TimeSeries joint_reactions;
  TimeSeries muscle_work;
  /// Over the gait cycle where the rows cover one, else over all rows.
  WorkBalance balance;
};

/// The EMG of a trial, ready to be shown and compared.
struct JobEmg {
  EmgEnvelopes processed;  ///< its times later by the electromechanical delay
  std::vector<EmgChannel> channels;
};

/// One run of the recipe: settings, input, and what each stage left behind. Private to
/// core/pipeline. Stages fill their own member and never touch an earlier one; a member is empty
/// until its stage ran.
struct Job {
  const TrialInput* input = nullptr;
  const PipelineEvents* events = nullptr;
  PipelineSettings settings;
  std::string models_folder;
  std::uint64_t fingerprint = 0;  ///< of input and settings; checkpoints carry it
  /// What an earlier run has said already is not said again.
  bool quiet = false;

  ModelSpec generic;   ///< unscaled, the strength law's reference
  ModelSpec scaled;    ///< of the subject; what residual reduction starts from
  ModelSpec adjusted;  ///< after residual reduction and strength; what ID, SO and CMC use
  /// Which landmark each marker of the static trials and the movement is.
  MarkerMapping marker_names;
  MarkerSetSpec marker_set;  ///< what scaling and inverse kinematics work with
  std::vector<MarkerTrajectories> static_poses;
  MarkerTrajectories markers;
  GroundReaction reaction;          ///< each force acts on one body all the time
  Gait gait;                        ///< contacts, events, cycles, and what is simulated
  TimeSeries measured_coordinates;  ///< from IK or from a file [rad|m]
  TimeSeries motion;                ///< after residual reduction: what SO and CMC follow
  std::optional<JobEmg> emg;        ///< if the trial has any that can be used

  std::optional<ScaleResult> scale;
  std::optional<IkResult> ik;
  std::optional<RraResult> rra;
  std::optional<IdResult> id;
  std::optional<SoResult> so;
  std::optional<CmcResult> cmc;
  std::optional<JobAnalysis> analysis;  ///< not in checkpoints: follows from the stage's result

  std::array<double, kStageCount> seconds{};  ///< processor time of each stage, 0 = not run
  std::vector<std::string> warnings;
  Decisions decisions;         ///< on the input files
  MarkerRepair marker_repair;  ///< of the movement

  bool ran(Stage stage) const { return seconds[static_cast<std::size_t>(stage)] > 0; }
  void warn(const std::string& sentence);
};

/// Whether the subject's sizes are fitted to the motion: as set, else where no static trial came.
bool scalesByMotion(const TrialInput& input, const PipelineSettings& settings);

/// Checks that the stages have the parts and numbers of the subject that they need. Looks at no
/// byte of a file. @throws Error kInputMissing, kInputValue naming the part
void checkParts(const TrialInput& input, const PipelineSettings& settings);

/// Tells which landmark each marker is, and takes the marker set of the job from that or from where
/// the settings say. Jobs that neither scale nor solve inverse kinematics have neither.
/// @throws Error kMarkerNames, and what openMarkerSet throws
void resolveMarkers(Job& job);

/// Whether the marker set follows from the markers' names.
bool isAutomatic(const TrialInput& input, const PipelineSettings& settings);

/// The marker set that came with the input, else the one that the settings name.
/// @throws Error kMarkerSetNotFound, kSettingsValue, and what readMarkerSet throws
MarkerSetSpec openMarkerSet(const TrialInput& input,
                            const PipelineSettings& settings,
                            const std::string& models_folder);

/// Reads the settings and all input files that the chosen stages need. `resumed`: an earlier run
/// has passed on the warnings of these files. @throws Error
Job openJob(const TrialInput& input,
            const InputFile& settings,
            const std::string& models_folder,
            const PipelineEvents& events,
            bool resumed);

/// Runs one stage on what the job has, and takes its result over.
/// @throws Error with the stage in `where`
void runStage(Stage stage, Job& job);

/// Makes a stage's result what later stages work on: models, motion. Analyses muscle forces.
void takeOver(Stage stage, Job& job);

/// Fills job.gait and job.reaction: tells which foot stands on which plate and when, and what
/// follows. @param plates  of selectForces, empty without forces
/// @throws Error kGrfColumns if no force can be given to a foot, kSettingsValue
void takeFeet(const GroundReaction& plates, Job& job);

/// What a stage computes unless its own range is stated: the hull of the ranges that are stated for
/// later stages, else one gait cycle with complete forces (Gait::window), else everything. Behind a
/// residual reduction with a stated range: everything that it leaves.
TimeRange findDefaultRange(Stage stage, const Job& job);

/// The gait cycle: as set, else the one that is simulated, else the first; empty if there is none.
std::optional<GaitCycle> findGaitCycle(const Job& job);
/// The cycles of one foot that the kinematics cover.
std::vector<GaitCycle> findGaitCycles(const Job& job, Foot foot);

/// Columns of makeGroundReactionTable, over the time of the kinematics.
TimeSeries makeGroundReactions(const Job& job);
/// <marker>_x, _y, _z [m] in ground of the markers that IK weighs, on the rows of IK.
TimeSeries makeMeasuredMarkers(const Job& job);

/// Fills job.analysis once the stage that settles the muscle forces is taken over.
void analyze(Stage stage, Job& job);
/// Tables beyond what the stage itself computed.
void addAnalysis(Stage stage, const Job& job, StageOutcome& outcome);

/// How far to trust a finished job; members of stages that did not run are empty.
struct JobQuality {
  std::optional<TrackingError> rra_tracking;  ///< of the pass that inverse dynamics analyses
  std::optional<TrackingError> cmc_tracking;
  std::vector<MomentComparison> moments;      ///< muscles against inverse dynamics, right leg
  std::vector<ActuatorStatistics> residuals;  ///< of CMC
  std::vector<ActuatorStatistics> reserves;
  std::vector<JointReserve> joint_reserves;       ///< empty without inverse dynamics
  std::vector<Saturation> saturations;            ///< of CMC, one per muscle
  std::vector<FiberRange> fibers;                 ///< of CMC, one per muscle
  std::vector<MarkerStatistics> markers;          ///< of IK
  std::vector<ActuatorStatistics> rra_residuals;  ///< of the last pass
  std::vector<ActuatorStatistics> so_residuals;
  std::vector<ActuatorStatistics> so_reserves;
  std::vector<JointReserve> so_joint_reserves;
  std::vector<Saturation> so_saturations;
  std::vector<EmgComparison> emg;  ///< of the channels whose muscles are known
  /// Largest vertical ground reaction of all feet together [N]; NaN without forces.
  double peak_reaction = std::numeric_limits<double>::quiet_NaN();
  /// Mean height of the whole body's mass centre over the CMC run [m].
  double mass_center_height = std::numeric_limits<double>::quiet_NaN();
  std::vector<QualityCheck> checks;
};

/// Lengths between which fibers give active force [l0M] (Zajac 1989, Crit Rev Biomed Eng 17:359).
inline constexpr double kShortestFiber = 0.5;
inline constexpr double kLongestFiber = 1.5;
/// From this control on a muscle counts as fully excited.
inline constexpr double kFullExcitation = 0.99;

/// Holds the figures of a job against what the field takes for trustworthy.
void addChecks(const Job& job, JobQuality& quality);
JobQuality calcQuality(const Job& job);

/// The paper's acceptance list with ours, the paper's and OpenSim's figures side by side; empty
/// unless the settings say that the job is one of the paper's trials and all stages ran.
std::optional<std::string> makeAcceptanceText(const Job& job, const JobQuality& quality);

/// Tables and files that a stage adds or replaces, once it has run; without checkpoint and summary.
StageOutcome makeOutcome(Stage stage, const Job& job);

/// summary.json: stages with processor seconds and counts, quality, every setting used, warnings.
std::string makeSummary(const Job& job, const JobQuality& quality);

}  // namespace gaitmill
