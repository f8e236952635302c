#pragma once

#include <string>
#include <variant>
#include <vector>

#include "service/backup_command.h"
#include "service/config.h"
#include "service/keys_command.h"
#include "service/model_command.h"
#include "service/render_command.h"
#include "service/solve_command.h"
#include "service/validation_command.h"

namespace gaitmill {

/// `gaitmill run`: the pipeline on local files.
struct RunOptions {
  std::string settings = "default";  ///< file, or name of shipped settings
  std::string from;                  ///< first stage; empty = the settings' own
  std::string static_markers;        ///< files; empty = not given
  std::string static_markers_2;
  std::string marker_names;
  std::string markers;
  std::string ground_reaction;
  std::string emg;
  std::string model;
  std::string coordinates;
  double mass = 0;       ///< [kg]
  double height = 0;     ///< [m]
  std::string out;       ///< folder, created if absent
  std::string geometry;  ///< folder of meshes for the report's images; empty = stylised bones
  std::string models;    ///< folder
};

/// `gaitmill model`: what is in a model document.
struct ModelOptions {
  std::string path;  ///< empty = the model that ships with gaitmill
  ModelReport report = ModelReport::kTable;
  std::string models;
};

/// `gaitmill sample`: the sample trial as files.
struct SampleOptionsOnDisk {
  enum class Content { kRecorded, kWithTruth };
  std::string out;
  Content content = Content::kRecorded;
  std::string models;
};

/// `gaitmill serve`, or `gaitmill work`: jobs of the same database without requests.
struct ServeOptions {
  enum class Action { kServe, kWork, kPrintConfig };
  Action action = Action::kServe;
  Configuration configuration;
};

struct VersionOptions {};

/// Nothing to run: help was asked for, or the command line is wrong.
struct PrintAndExit {
  std::string text;
  int exit_code = 0;
};

using Command = std::variant<ServeOptions,
                             RunOptions,
                             ModelOptions,
                             CalibrateOptions,
                             ValidateModelOptions,
                             RenderOptions,
                             SampleOptionsOnDisk,
                             BackupOptions,
                             RestoreOptions,
                             KeysOptions,
                             ChildOptions,
                             VersionOptions,
                             PrintAndExit>;

/// What the process tells its caller.
enum ExitCode : int {
  kExitSuccess = 0,
  kExitFailed = 1,    ///< an input is wrong, or a job failed
  kExitUsage = 2,     ///< the command line or the configuration is wrong
  kExitInternal = 3,  ///< a fault of gaitmill itself, or of the machine
};

/// Reads the command line without the program's name; for `serve` and `work` also GAITMILL_…
/// variables and the configuration file. Never exits.
/// @throws Error kConfig, kFileNotFound for those two
Command parseCommandLine(const std::vector<std::string>& arguments);

}  // namespace gaitmill
