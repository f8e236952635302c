#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/data/time_series.h"

namespace gaitmill {

/// A file as it came: its name (for messages and to tell formats apart) and its bytes.
struct InputFile {
  std::string name;
  std::string bytes;
};

/// Everything a job starts from. Which files are needed depends on the first stage.
struct TrialInput {
  std::optional<InputFile> static_markers;    ///< TRC or C3D, standing, for scale
  std::optional<InputFile> static_markers_2;  ///< TRC or C3D, second pose for marker placement
  std::optional<InputFile> markers;           ///< TRC or C3D, the movement
  std::optional<InputFile> ground_reaction;   ///< MOT/STO or C3D; absent: plates of a C3D `markers`
  std::optional<InputFile>
      emg;  ///< ANC, STO, CSV, text or C3D; absent: channels of a C3D `markers`
  std::optional<InputFile> model;         ///< .osim: generic model, or scaled if scale is skipped
  std::optional<InputFile> coordinates;   ///< MOT/STO, to start after IK
  std::optional<InputFile> marker_set;    ///< JSON, replaces the one that the settings name
  std::optional<InputFile> marker_names;  ///< JSON, {"measured name": "landmark" | null}
  double mass = 0;                        ///< [kg]
  double height = 0;                      ///< [m]
};

enum class Stage { kScale, kIk, kRra, kId, kSo, kCmc };
inline constexpr int kStageCount = 6;

/// "scale", "ik", "rra", "id", "so", "cmc"
const char* stageName(Stage stage);
/// @throws Error kSettingsValue naming the stages there are
Stage parseStage(const std::string& name);

/// What one finished stage leaves behind.
struct StageOutcome {
  Stage stage = Stage::kScale;
  /// Opaque bytes from which a later run goes on behind this stage, bit for bit as this one would.
  std::string checkpoint;
  // What the stage added or replaced, named as in PipelineResult.
  std::map<std::string, std::string> files;
  std::map<std::string, TimeSeries> tables;
  std::map<std::string, TimeSeries> cycle_tables;
};

/// What happens while a pipeline runs; called from its thread.
struct PipelineEvents {
  /// Fraction of one stage in [0, 1]; false asks to stop (Error kCancelled). Asked at every step of
  /// a solver.
  std::function<bool(Stage stage, double fraction)> progress;
  /// A sentence the user should read: an infeasible window, a missing marker. A resumed run does
  /// not repeat what was said before its last checkpoint.
  std::function<void(const std::string& warning)> warn;
  /// After each stage that was computed; not for stages that a checkpoint stands for.
  std::function<void(const StageOutcome& outcome)> stage_done;
};

/// Results of a job, all as values.
struct PipelineResult {
  /// Downloadable files by name: "scaled_model.osim", "ik.mot", "summary.json", ...
  std::map<std::string, std::string> files;
  /// Tables by result name, as far as the stages that ran make them: "moments", "activations",
  /// "excitations", "forces", "fiber_lengths", "fiber_velocities", "kinematics", "residuals",
  /// "reserves", "tracking_errors", "marker_errors", "measured_markers", "ground_reactions",
  /// "joint_powers", "joint_reactions", "muscle_work", "emg", and those of MuscleAnalysis. Every
  /// column has its unit ("" = dimensionless); angles in radians (converted at the edge).
  std::map<std::string, TimeSeries> tables;
  /// The same tables on 0..100 % of the gait cycle (column "percent" is `time`), where a cycle
  /// exists.
  std::map<std::string, TimeSeries> cycle_tables;
  /// stages, quality, settings used, warnings: the content of summary.json.
  std::string summary_json;
  std::vector<std::string> warnings;
};

/// The recipe: which stage gets what, in which order. Holds no state between runs; one object may
/// serve several threads at once.
class Pipeline {
 public:
  /// @param models_folder  where the project's models, marker sets and settings lie
  explicit Pipeline(std::string models_folder = "models");

  /// Runs the stages that the settings ask for ("stages": {"first": "rra", "last": "cmc"}).
  /// @param settings_json  a document like models/settings/default.json; absent fields take
  ///                       defaults
  /// @param checkpoints    of the first stages of an earlier run of the same input and settings, in
  ///                       order; these stages are not computed again. Processor seconds aside, the
  ///                       result is the same to the bit as without them.
  /// @throws Error of any stage, with the stage in `where`; kSettings... naming the field;
  ///   kCheckpointUnusable if a checkpoint is damaged, of another version of the code, or of other
  ///   input: run without checkpoints then
  PipelineResult run(const TrialInput& input,
                     const InputFile& settings_json,
                     const PipelineEvents& events,
                     const std::vector<std::string>& checkpoints = {}) const;

  /// Checks a settings document without running it. @throws Error kSettings...
  void checkSettings(const InputFile& settings_json) const;

  /// Checks cheaply that a job can start: the settings are valid, the parts that their stages need
  /// are there, the subject has the numbers they need, and the marker set exists. Of the files of
  /// `input` it only looks at which there are; their bytes may be empty.
  /// @throws Error kSettings..., kInputMissing and kInputValue naming the part, kMarkerSetNotFound
  void checkInput(const TrialInput& input, const InputFile& settings_json) const;

  /// A settings document with every field that there is and its default; null = none.
  static std::string defaultSettings();

 private:
  std::string models_folder_;
};

/// The code that computes, "0.1.0 81c4…": the version, and 16 hex digits of the hash over the
/// core's sources. Part of the provenance of every result; checkpoints of other code are not gone
/// on from.
const std::string& codeVersion();

}  // namespace gaitmill
