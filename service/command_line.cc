#include "service/command_line.h"

#include <CLI/CLI.hpp>
#include <sstream>

namespace gaitmill {

namespace {

constexpr const char* kFooter =
    "Exit codes: 0 success; 1 an input is wrong or a job failed; 2 the command line is wrong; "
    "3 a fault of gaitmill itself or of the machine.";

void addModels(CLI::App& command, std::string& models) {
  command.add_option("--models", models, "Folder of models, marker sets and settings")
      ->envname("GAITMILL_MODELS");
}

void addServe(CLI::App& app, ServeConfig& config) {
  CLI::App* command = app.add_subcommand("serve", "Run the web service until SIGTERM or SIGINT");
  command->add_option("--db", config.database, "Database file, created if absent")
      ->envname("GAITMILL_DB")
      ->capture_default_str();
  command->add_option("--host", config.host, "Address to listen on")
      ->envname("GAITMILL_HOST")
      ->capture_default_str();
  command->add_option("--port", config.port, "Port to listen on; 0 takes a free one and prints it")
      ->envname("GAITMILL_PORT")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command->add_option("--workers", config.workers, "Jobs at a time; 0 = one per hardware thread")
      ->envname("GAITMILL_WORKERS")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  command->add_option("--log-level", config.log_level, "What the log on standard error holds")
      ->envname("GAITMILL_LOG_LEVEL")
      ->check(CLI::IsMember({"debug", "info", "warn", "error", "off"}))
      ->capture_default_str();
  addModels(*command, config.models);
  command->footer(std::string("Every flag has a variable: GAITMILL_DB for --db, and so on.\n") +
                  kFooter);
}

void addRunFiles(CLI::App& command, RunOptions& options) {
  const auto add = [&](const char* flag, std::string& path, const char* help) {
    command.add_option(flag, path, help)->check(CLI::ExistingFile);
  };
  add("--static", options.static_markers, "Standing trial for scaling, TRC");
  add("--static2", options.static_markers_2, "Second pose for marker placement, TRC");
  add("--markers", options.markers, "The movement, TRC");
  add("--grf", options.ground_reaction, "Ground reactions, MOT or STO");
  add("--emg", options.emg, "EMG envelopes, MOT, STO or CSV; for comparison only");
  add("--model", options.model, "Model document; scaled, if scaling is left out");
  add("--coordinates", options.coordinates, "Kinematics, MOT or STO; to start after IK");
}

void addRun(CLI::App& app, RunOptions& options) {
  CLI::App* command =
      app.add_subcommand("run", "Run the pipeline on local files, without a server");
  command->add_option("--settings", options.settings, "Settings file, or name of shipped settings")
      ->capture_default_str();
  command->add_option("--from", options.from, "Stage to start with; its inputs must be given")
      ->check(CLI::IsMember({"scale", "ik", "rra", "id", "so", "cmc"}));
  addRunFiles(*command, options);
  command->add_option("--mass", options.mass, "Body mass [kg]")
      ->required()
      ->check(CLI::Range(5.0, 300.0));
  command->add_option("--height", options.height, "Body height [m]")
      ->required()
      ->check(CLI::Range(0.4, 2.6));
  command->add_option("--out", options.out, "Folder for the results")->required();
  addModels(*command, options.models);
  command->footer(kFooter);
}

void addModel(CLI::App& app, ModelOptions& options) {
  CLI::App* command = app.add_subcommand("model", "Show what is in a model document");
  command->add_option("file", options.path, "An .osim document; the shipped model if left out")
      ->check(CLI::ExistingFile);
  command->add_flag_callback(
      "--json", [&options] { options.report = ModelReport::kJson; }, "As JSON");
  addModels(*command, options.models);
  command->footer(kFooter);
}

void addSample(CLI::App& app, SampleOptionsOnDisk& options) {
  CLI::App* command =
      app.add_subcommand("sample", "Write the sample trial that ships with gaitmill");
  command->add_option("--out", options.out, "Folder for the files")->required();
  command->add_flag_callback(
      "--truth",
      [&options] { options.content = SampleOptionsOnDisk::Content::kWithTruth; },
      "Also write the true model, coordinates and moments");
  addModels(*command, options.models);
  command->footer(kFooter);
}

PrintAndExit explain(const CLI::App& app, const CLI::Error& error) {
  std::ostringstream out;
  std::ostringstream complaint;
  const bool is_help = app.exit(error, out, complaint) == 0;
  return {out.str() + complaint.str(), is_help ? kExitSuccess : kExitUsage};
}

}  // namespace

Command parseCommandLine(const std::vector<std::string>& arguments) {
  ServeConfig serve;
  RunOptions run;
  ModelOptions model;
  SampleOptionsOnDisk sample;
  CLI::App app("Gait trials in, joint moments and muscle activations out.", "gaitmill");
  app.require_subcommand(1);
  app.footer(kFooter);
  addServe(app, serve);
  addRun(app, run);
  addModel(app, model);
  addSample(app, sample);
  app.add_subcommand("version", "Print the version")->footer(kFooter);
  try {
    // CLI11 takes the arguments in reverse.
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::Error& error) {
    return explain(app, error);
  }
  const std::string chosen = app.get_subcommands().front()->get_name();
  if (chosen == "serve") {
    return serve;
  }
  if (chosen == "run") {
    return run;
  }
  if (chosen == "model") {
    return model;
  }
  return chosen == "sample" ? Command(sample) : Command(VersionOptions{});
}

}  // namespace gaitmill
