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
  std::optional<InputFile> static_markers;    ///< TRC, standing, for scale
  std::optional<InputFile> static_markers_2;  ///< TRC, second pose for marker placement
  std::optional<InputFile> markers;           ///< TRC, the movement
  std::optional<InputFile> ground_reaction;   ///< MOT/STO
  std::optional<InputFile> emg;               ///< STO/CSV envelopes, for comparison only
  std::optional<InputFile> model;        ///< .osim: generic model, or scaled if scale is skipped
  std::optional<InputFile> coordinates;  ///< MOT/STO, to start after IK
  double mass = 0;                       ///< [kg]
  double height = 0;                     ///< [m]
};

enum class Stage { kScale, kIk, kRra, kId, kSo, kCmc };
inline constexpr int kStageCount = 6;

/// "scale", "ik", "rra", "id", "so", "cmc"
const char* stageName(Stage stage);
/// @throws Error kSettingsValue naming the stages there are
Stage parseStage(const std::string& name);

/// What happens while a pipeline runs; called from its thread.
struct PipelineEvents {
  /// Fraction of one stage in [0, 1]; false asks to stop (Error kCancelled).
  std::function<bool(Stage stage, double fraction)> progress;
  /// A sentence the user should read: an infeasible window, a missing marker.
  std::function<void(const std::string& warning)> warn;
};

/// Results of a job, all as values.
struct PipelineResult {
  /// Downloadable files by name: "scaled_model.osim", "ik.mot", "summary.json", ...
  std::map<std::string, std::string> files;
  /// Tables by result name: "moments", "activations", "forces", "kinematics", "residuals". Units in
  /// the table; angles in radians (converted at the edge).
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
  /// defaults
  /// @throws Error of any stage, with the stage as context; kSettings... naming the field
  PipelineResult run(const TrialInput& input,
                     const InputFile& settings_json,
                     const PipelineEvents& events) const;

  /// Checks a settings document without running it. @throws Error kSettings...
  void checkSettings(const InputFile& settings_json) const;

 private:
  std::string models_folder_;
};

}  // namespace gaitmill
