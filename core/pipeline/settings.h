#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/analysis/acceptance.h"
#include "core/analysis/emg_channels.h"
#include "core/analysis/emg_envelope.h"
#include "core/analysis/foot_contacts.h"
#include "core/analysis/gait_window.h"
#include "core/cmc/cmc_options.h"
#include "core/data/marker_set.h"
#include "core/data/model_spec.h"
#include "core/id/id_options.h"
#include "core/ik/ik_options.h"
#include "core/intake/force_reading.h"
#include "core/intake/laboratory.h"
#include "core/intake/marker_faults.h"
#include "core/intake/marker_names.h"
#include "core/io/grf_reader.h"
#include "core/io/trc_reader.h"
#include "core/pipeline/pipeline.h"
#include "core/rra/rra_options.h"
#include "core/scale/strength.h"
#include "core/so/so_options.h"

namespace gaitmill {

/// Values by coordinate as a settings document states them. A name that the model does not have
/// stands for both sides: "hip_flexion" for hip_flexion_r and hip_flexion_l.
using CoordinateValues = std::map<std::string, double>;

/// Free coordinates that a list of coordinates does not name.
enum class OtherCoordinates {
  kNone,     ///< get nothing, and a listed name that the model lacks is an error
  kMuscles,  ///< get a usual value where muscles cross the joint; names it lacks are skipped
  kAll,      ///< get a usual value unless they are what residuals act on; the same
};

/// Ideal actuators beside the model's own muscles and torque actuators. Controls count in units of
/// optimal force.
struct ActuatorSetSettings {
  /// Residual forces and torques between ground and one body, along ground axes.
  struct Residuals {
    std::string body = "pelvis";
    std::optional<Eigen::Vector3d> point;  ///< [m] in the body; absent = its mass centre
    double optimal_force = 10;             ///< [N]
    double optimal_moment = 15;            ///< [N.m]
    double control_limit = 1000;
  };
  std::optional<Residuals> residuals;
  CoordinateValues coordinates;  ///< optimal force by coordinate [N.m|N]
  OtherCoordinates others = OtherCoordinates::kNone;
  double other_optimal_force = 1;  ///< of the others [N.m|N]
  std::string name_suffix = "_reserve";
  double control_limit = 1000;
};

/// Actuators of residual reduction: light at the pelvis, so that the joints do the work.
ActuatorSetSettings makeTrackingActuators();
/// Residuals and reserves of static optimization and computed muscle control.
ActuatorSetSettings makeReserveActuators();
/// How closely residual reduction follows each coordinate.
CoordinateValues makeTrackingWeights();

/// How force files are read.
struct ForceSettings {
  GrfOptions reading;
  /// Critically damped zero-lag low-pass, two passes ("second order"), of force and moment [Hz].
  std::optional<double> lowpass_cutoff;
};

struct RraSettings {
  RraStrategy strategy = RraStrategy::kAutopilot;
  bool automatic_cutoff = true;              ///< by the kind of gait; else as stated next
  std::optional<double> lowpass_cutoff = 6;  ///< [Hz] of the coordinates; none = unfiltered
  TimeRange range;
  ActuatorSetSettings actuators = makeTrackingActuators();
  std::string adjusted_body = "torso";
  InertiaScaling inertia = InertiaScaling::kWithMass;
  /// What a pass tracks with. Passes beyond the list repeat its last entry.
  struct Pass {
    CoordinateValues weights;
    OtherCoordinates others = OtherCoordinates::kNone;
    std::optional<TimeRange> range;  ///< replaces the common one
  };
  std::vector<Pass> passes = {{makeTrackingWeights(), OtherCoordinates::kAll, {}}};
  int max_passes = 6;               ///< where passes are listed: as many, unless stated
  double mass_tolerance = 0.05;     ///< [kg] stop when a pass asks for less
  double center_tolerance = 0.001;  ///< [m]
};

/// How EMG is read and held against the simulated activations.
struct EmgSettings {
  EmgSource source = EmgSource::kAuto;
  EmgOptions processing;
  /// From the EMG to the activation that it stands for: added to the times of the recording [s].
  double electromechanical_delay = 0;
  EmgChannelOptions mapping;
};

/// Where the subject's sizes come from.
enum class ScaleMethod {
  kAuto,    ///< from the static trial where there is one, else from the motion
  kStatic,  ///< from marker distances of a static trial
  kMotion,  ///< fitted to the motion together with marker offsets and poses
};

/// Names the marker set that follows from the names of the markers.
inline constexpr const char* kAutomaticMarkerSet = "auto";

/// A settings document (models/settings/*.json) as values. Every field has a default, and the
/// defaults together run any trial with the model's own marker names.
struct PipelineSettings {
  std::string name;
  std::string description;
  Stage first = Stage::kScale;
  Stage last = Stage::kCmc;
  std::vector<Stage> skipped;

  TrcOptions trc;
  MarkerOverrides marker_names;  ///< over those of the trial's own part and over what names tell
  ForceSettings forces;
  // What is stated here is not read out of the data.
  LaboratoryOptions laboratory;
  ForceReadingOptions force_reading;
  std::optional<double> force_time_offset;  ///< [s] added to the times of the forces
  std::optional<bool> angles_in_degrees;    ///< of a coordinates file
  MarkerFaultOptions marker_faults;
  std::optional<TimeRange> gait_cycle;  ///< two strikes of the right foot; absent = from the trial
  std::vector<ContactStatement> contacts;  ///< which foot stands where; wins over all evidence
  std::optional<CycleChoice> cycle;        ///< that is simulated; absent = the first complete one

  /// Set where the job is one of the paper's two trials: the result then holds the acceptance list.
  std::optional<PaperTrial> paper_trial;

  /// Name of models/marker_sets/*.json, or kAutomaticMarkerSet.
  std::string marker_set = kAutomaticMarkerSet;
  ScaleMethod scale_method = ScaleMethod::kAuto;
  std::optional<double> fiber_damping;

  double ik_warn_rms = 0.02;  ///< [m]
  double ik_warn_max = 0.04;  ///< [m]
  TimeRange ik_range;

  RraSettings rra;

  StrengthLaw strength_law = StrengthLaw::kAsIntended;
  std::optional<double> strength_height;  ///< [m] replaces the subject's height in the law
  std::optional<double> max_contraction_velocity = 15;  ///< after residual reduction [l0M / s]

  IdOptions id;
  int id_pass = 0;  ///< residual reduction pass whose motion is analysed, from 1; 0 = the last

  SoOptions so;
  ActuatorSetSettings so_actuators = makeReserveActuators();
  double so_interval = 0.010;  ///< [s] between rows

  CmcOptions cmc;
  TimeRange cmc_range;
  ActuatorSetSettings cmc_actuators = makeReserveActuators();

  EmgSettings emg;

  bool runs(Stage stage) const;
};

/// Reads a settings document. @throws Error kSettingsJson with line and column;
///   kSettingsUnknownField naming the nearest field; kSettingsValue, kInputMissing naming the field
PipelineSettings readSettings(const InputFile& document);

/// The document that says everything: every field with its value, null where there is none.
std::string writeSettings(PipelineSettings settings);

/// Actuators of a set on a model. Residuals are FX FY FZ MX MY MZ; coordinate actuators are named
/// after their coordinate plus the suffix. @throws Error kInputCoordinates, kModelReference
std::vector<ActuatorSpec> makeActuators(const ActuatorSetSettings& settings,
                                        const ModelSpec& model);

/// Expands names that stand for both sides. @throws Error kInputCoordinates naming the nearest name
std::map<std::string, double> expandSides(const CoordinateValues& values, const ModelSpec& model);

/// Tracking weights on a model. Coordinates that are not listed weigh by their joint: the base
/// most, then what carries much of the body's mass.
std::map<std::string, double> fitWeights(const RraSettings::Pass& pass, const ModelSpec& model);

/// The same as tasks. Light segments that are not listed, such as toes, are followed with four
/// times the bandwidth: between two controls their small inertia gives way to what the ramp misses
/// (spec/rra.md 9.9).
std::vector<TrackingTask> fitTasks(const RraSettings::Pass& pass, const ModelSpec& model);

}  // namespace gaitmill
