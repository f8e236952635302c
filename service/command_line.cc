#include "service/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "core/base/error.h"

namespace gaitmill {

namespace {

constexpr const char* kFooter =
    "Exit codes: 0 success; 1 an input is wrong or a job failed; 2 the command line is wrong; "
    "3 a fault of gaitmill itself or of the machine.";

void addModels(CLI::App& command, std::string& models) {
  command.add_option("--models", models, "Folder of models, marker sets and settings")
      ->envname("GAITMILL_MODELS");
}

void addGeometry(CLI::App& command, std::string& geometry) {
  command
      .add_option(
          "--geometry", geometry, "Folder of .vtp, .stl and .obj bones; stylised ones if left out")
      ->envname("GAITMILL_GEOMETRY")
      ->check(CLI::ExistingDirectory);
}

// "slow_down" is the flag --slow-down.
std::string findFlag(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

// What `serve` and `work` are told on the command line, before it becomes a configuration.
struct ServeFlags {
  std::map<std::string, std::string> values;
  std::string file;
  bool print = false;
};

std::string findFault(const ConfigField& field, const std::string& text) {
  ServeConfig scratch;
  try {
    setConfigField(field, text, scratch);
    return "";
  } catch (const Error& error) {
    return error.message();
  }
}

std::string findDefault(const ConfigField& field) {
  ServeConfig defaults;
  std::ostringstream text;
  std::visit([&](const auto member) { text << defaults.*member; }, field.member);
  return text.str();
}

void addConfiguration(CLI::App& command, ServeFlags& flags) {
  for (const ConfigField& field : configFields()) {
    command
        .add_option_function<std::string>(
            field.flag(),
            [&flags, name = field.name](const std::string& text) { flags.values[name] = text; },
            field.help)
        ->check([&field](const std::string& text) { return findFault(field, text); })
        ->type_name(field.unit.empty() ? "" : "[" + field.unit + "]")
        ->default_str(findDefault(field));
  }
  command.add_option("--config", flags.file, "File with a JSON object of these values")
      ->envname("GAITMILL_CONFIG")
      ->check(CLI::ExistingFile);
  command.footer(
      std::string("Every flag has a variable, GAITMILL_DB for --db, and a member in the ") +
      "file, \"db\";\na flag wins over a variable, and that over the file.\n" + kFooter);
}

void addServe(CLI::App& app, ServeFlags& flags) {
  CLI::App* serve = app.add_subcommand("serve", "Run the web service until SIGTERM or SIGINT");
  addConfiguration(*serve, flags);
  serve->add_flag(
      "--print-config", flags.print, "Print the configuration in force as JSON and end");
  CLI::App* work = app.add_subcommand(
      "work", "Run jobs of a database without the web service, beside one or alone");
  addConfiguration(*work, flags);
}

std::optional<std::string> findVariable(const std::string& name) {
  const char* value = std::getenv(name.c_str());
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

ServeOptions makeServeOptions(const std::string& command, const ServeFlags& flags) {
  ServeOptions options;
  options.action = command == "work" ? ServeOptions::Action::kWork
                   : flags.print     ? ServeOptions::Action::kPrintConfig
                                     : ServeOptions::Action::kServe;
  options.configuration = loadConfiguration(flags.values, flags.file, findVariable);
  return options;
}

void addDatabase(CLI::App& command, std::string& path) {
  command.add_option("--db", path, "Database file")->envname("GAITMILL_DB")->capture_default_str();
  command.footer(kFooter);
}

void addBackup(CLI::App& app, BackupOptions& backup, RestoreOptions& restore) {
  CLI::App* save = app.add_subcommand("backup", "Copy the database, in use or not");
  save->add_option("file", backup.file, "File for the copy; one that is there is replaced")
      ->required();
  addDatabase(*save, backup.database);
  CLI::App* load = app.add_subcommand("restore", "Put a backup in the place of the database");
  load->add_option("file", restore.file, "The backup")->required()->check(CLI::ExistingFile);
  load->add_flag_callback(
      "--overwrite",
      [&restore] { restore.overwrite = RestoreOptions::Overwrite::kYes; },
      "Replace a database that is there");
  addDatabase(*load, restore.database);
}

struct KeyFlags {
  std::string database = "gaitmill.db";
  CreateKeyOptions create;
  ListKeysOptions list;
  RevokeKeyOptions revoke;
};

void addKeys(CLI::App& app, KeyFlags& keys) {
  CLI::App* command = app.add_subcommand("keys", "Make, list and revoke API keys");
  command->require_subcommand(1);
  command->fallthrough();
  addDatabase(*command, keys.database);
  CLI::App* create = command->add_subcommand("create", "Make a key and print it, once");
  create->add_option("--tenant", keys.create.tenant, "Whose trials and jobs it sees")
      ->capture_default_str();
  create->add_option("--name", keys.create.name, "For people: \"lab computer\"")->required();
  create->add_option("--scopes", keys.create.scopes, "read, write, admin")
      ->delimiter(',')
      ->capture_default_str();
  CLI::App* list = command->add_subcommand("list", "All keys, without their secrets");
  list->add_option("--tenant", keys.list.tenant, "Only of this one");
  CLI::App* revoke = command->add_subcommand("revoke", "End a key");
  revoke->add_option("id", keys.revoke.key_id, "key_...")->required();
}

KeysOptions makeKeysOptions(const CLI::App& app, const KeyFlags& keys) {
  const std::string action = app.get_subcommand("keys")->get_subcommands().front()->get_name();
  if (action == "create") {
    return {keys.database, keys.create};
  }
  if (action == "list") {
    return {keys.database, keys.list};
  }
  return {keys.database, keys.revoke};
}

// How the service starts this program as its own child; not for people, so not in the help.
void addChildren(CLI::App& app, ChildOptions& child) {
  for (const char* name : {"solve", "inspect", "draw"}) {
    CLI::App* command = app.add_subcommand(name)->group("");
    command->add_option("--models", child.models)->required();
    command->add_option("--geometry", child.geometry);
    command->add_option("--parent", child.parent)->required();
    command->add_option("--memory-mb", child.limits.memory_mb)->required();
    command->add_option("--nice", child.limits.nice)->required();
  }
}

void addRunFiles(CLI::App& command, RunOptions& options) {
  const auto add = [&](const char* flag, std::string& path, const char* help) {
    command.add_option(flag, path, help)->check(CLI::ExistingFile);
  };
  add("--static",
      options.static_markers,
      "Standing trial for scaling, TRC or C3D; without it, the movement is fitted");
  add("--static2", options.static_markers_2, "Second pose for marker placement, TRC or C3D");
  add("--markers", options.markers, "The movement, TRC or C3D; a C3D brings its forces and EMG");
  add("--grf", options.ground_reaction, "Ground reactions, MOT, STO or C3D");
  add("--emg", options.emg, "EMG, MOT, STO, CSV, ANC or C3D; for comparison only");
  add("--model", options.model, "Model document; scaled, if scaling is left out");
  add("--coordinates", options.coordinates, "Kinematics, MOT or STO; to start after IK");
  add("--marker-names",
      options.marker_names,
      "Landmarks by measured marker, JSON; null = a marker to ignore");
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
  addGeometry(*command, options.geometry);
  addModels(*command, options.models);
  command->footer(kFooter);
}

void addCalibrate(CLI::App& model, CalibrateOptions& options) {
  CLI::App* command =
      model.add_subcommand("calibrate", "Slack lengths that give fibers their measured lengths");
  command->add_option("file", options.path, "An .osim document; the shipped model if left out")
      ->check(CLI::ExistingFile);
  command
      ->add_option("--targets",
                   options.targets,
                   "Table muscle,norm_fiber_length or muscle,fiber_length_m; left out, the table "
                   "shows where the model's own muscles rest")
      ->check(CLI::ExistingFile);
  command->add_option("-o,--out", options.out, "Write the calibrated model here");
  addModels(*command, options.models);
  command->footer(kFooter);
}

void addRender(CLI::App& app, RenderOptions& options) {
  CLI::App* command =
      app.add_subcommand("render", "Draw a pose, a strip of poses or an animation of a motion");
  command->add_option("out", options.out, "Image: .png, or .webp for an animation")->required();
  const auto add = [&](const char* flag, std::string& path, const char* help) {
    command->add_option(flag, path, help)->check(CLI::ExistingPath);
  };
  add("--results", options.results, "Folder that 'gaitmill run' has left");
  add("--model", options.model, "Model document, .osim");
  add("--motion", options.motion, "Coordinates over time, MOT or STO");
  add("--values", options.muscle_values, "Table that muscles are coloured by, STO");
  addGeometry(*command, options.geometry);
  // What they take is said and checked where the web service has them.
  const std::vector<std::pair<const char*, const char*>> parameters = {
      {"time", "Instant of a pose [s]"},
      {"percent", "The same in percent of the gait cycle"},
      {"poses", "Poses of a strip, 1 to 24"},
      {"start", "Begin of a strip or an animation [s]"},
      {"end", "End of a strip or an animation [s]"},
      {"rate", "Frames per second of an animation"},
      {"slow_down", "4 plays at a quarter of the real speed"},
      {"width", "Of one pose [px]"},
      {"height", "Of one pose [px]"},
      {"view", "sagittal, frontal, oblique, or AZIMUTH,ELEVATION [deg]"},
      {"color", "activation, force, fiber_length or none"},
      {"bones", "true or false; so the next five"},
      {"muscles", ""},
      {"markers", ""},
      {"forces", ""},
      {"ground", ""},
      {"legend", ""}};
  for (const auto& [name, help] : parameters) {
    command->add_option_function<std::string>(
        findFlag(name),
        [&options, name = std::string(name)](const std::string& text) {
          options.parameters[name] = text;
        },
        help);
  }
  command->footer(kFooter);
}

void addValidation(CLI::App& model, ValidateModelOptions& options) {
  using Form = ValidateModelOptions::Form;
  CLI::App* command =
      model.add_subcommand("validation", "Validation figures of a model, as Vega-Lite");
  command->add_option("file", options.path, "An .osim document")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("figure", options.figure, "Name of the figure; left out, the list of them");
  command->add_option("--seed", options.seed, "Of random draws")->capture_default_str();
  const std::map<std::string, Form> forms = {
      {"vega-lite", Form::kVegaLite}, {"data", Form::kData}, {"svg", Form::kSvg}};
  command->add_option("--format", options.form, "vega-lite, data or svg")
      ->transform(CLI::CheckedTransformer(forms));
  command->footer(kFooter);
}

struct ModelFlags {
  ModelOptions show;
  CalibrateOptions calibrate;
  ValidateModelOptions validation;
};

void addModel(CLI::App& app, ModelFlags& flags) {
  ModelOptions& options = flags.show;
  CLI::App* command = app.add_subcommand("model", "Show what is in a model document");
  command->add_option("file", options.path, "An .osim document; the shipped model if left out")
      ->check(CLI::ExistingFile);
  command->add_flag_callback(
      "--json", [&options] { options.report = ModelReport::kJson; }, "As JSON");
  addModels(*command, options.models);
  addCalibrate(*command, flags.calibrate);
  addValidation(*command, flags.validation);
  command->footer(kFooter);
}

Command chooseModel(const CLI::App& model, const ModelFlags& flags) {
  if (model.got_subcommand("calibrate")) {
    return flags.calibrate;
  }
  return model.got_subcommand("validation") ? Command(flags.validation) : Command(flags.show);
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

// The options of every command, as far as they were given.
struct Parsed {
  ServeFlags serve;
  RunOptions run;
  ModelFlags model;
  RenderOptions render;
  SampleOptionsOnDisk sample;
  BackupOptions backup;
  RestoreOptions restore;
  KeyFlags keys;
  ChildOptions child;
};

Command choose(const CLI::App& app, Parsed& parsed) {
  const std::string chosen = app.get_subcommands().front()->get_name();
  if (chosen == "serve" || chosen == "work") {
    return makeServeOptions(chosen, parsed.serve);
  }
  const std::map<std::string, ChildOptions::Task> children = {
      {"solve", ChildOptions::Task::kSolve},
      {"inspect", ChildOptions::Task::kInspect},
      {"draw", ChildOptions::Task::kDraw}};
  if (children.count(chosen) > 0) {
    parsed.child.task = children.at(chosen);
    return parsed.child;
  }
  if (chosen == "model") {
    return chooseModel(*app.get_subcommand("model"), parsed.model);
  }
  if (chosen == "keys") {
    return makeKeysOptions(app, parsed.keys);
  }
  const std::map<std::string, Command> others = {{"run", parsed.run},
                                                 {"render", parsed.render},
                                                 {"sample", parsed.sample},
                                                 {"backup", parsed.backup},
                                                 {"restore", parsed.restore},
                                                 {"version", VersionOptions{}}};
  return others.at(chosen);
}

}  // namespace

Command parseCommandLine(const std::vector<std::string>& arguments) {
  Parsed parsed;
  CLI::App app("Gait trials in, joint moments and muscle activations out.", "gaitmill");
  app.require_subcommand(1);
  app.footer(kFooter);
  addServe(app, parsed.serve);
  addRun(app, parsed.run);
  addModel(app, parsed.model);
  addRender(app, parsed.render);
  addSample(app, parsed.sample);
  addBackup(app, parsed.backup, parsed.restore);
  addKeys(app, parsed.keys);
  addChildren(app, parsed.child);
  app.add_subcommand("version", "Print the version")->footer(kFooter);
  try {
    // CLI11 takes the arguments in reverse.
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::Error& error) {
    return explain(app, error);
  }
  return choose(app, parsed);
}

}  // namespace gaitmill
