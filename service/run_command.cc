#include "service/run_command.h"

#include <spdlog/fmt/fmt.h>

#include <filesystem>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/io/files.h"
#include "service/provenance.h"
#include "service/run_views.h"
#include "service/settings_catalog.h"
#include "service/shipped_catalog.h"
#include "service/storage/sha256.h"

namespace gaitmill {

namespace {

using nlohmann::json;

constexpr const char* kStageOrder[] = {"scale", "ik", "rra", "id", "so", "cmc"};

std::optional<InputFile> readOptional(const std::string& path) {
  if (path.empty()) {
    return std::nullopt;
  }
  return InputFile{std::filesystem::path(path).filename().string(), readFile(path)};
}

TrialInput readTrial(const RunOptions& options) {
  TrialInput input;
  input.static_markers = readOptional(options.static_markers);
  input.static_markers_2 = readOptional(options.static_markers_2);
  input.marker_names = readOptional(options.marker_names);
  input.markers = readOptional(options.markers);
  input.ground_reaction = readOptional(options.ground_reaction);
  input.emg = readOptional(options.emg);
  input.model = readOptional(options.model);
  input.coordinates = readOptional(options.coordinates);
  input.mass = options.mass;
  input.height = options.height;
  return input;
}

InputFile readSettings(const RunOptions& options) {
  InputFile settings = std::filesystem::is_regular_file(options.settings)
                           ? *readOptional(options.settings)
                           : SettingsCatalog(options.models).find(options.settings);
  return options.from.empty() ? settings
                              : mergeSettings(settings, makeFirstStageSettings(options.from));
}

// One line when a stage begins.
PipelineEvents makeEvents(std::ostream& progress) {
  PipelineEvents events;
  events.progress = [&progress, last = std::string()](Stage stage, double) mutable {
    if (last != stageName(stage)) {
      last = stageName(stage);
      progress << last << " ...\n" << std::flush;
    }
    return true;
  };
  events.warn = [&progress](const std::string& warning) {
    progress << "warning: " << warning << '\n';
  };
  return events;
}

std::string describeExtent(const json& stage) {
  if (stage.contains("frames")) {
    return stage["frames"].dump() + " frames";
  }
  return stage.contains("simulated_seconds") ? stage["simulated_seconds"].dump() + " s simulated"
                                             : "";
}

void appendQuality(const json& value, const std::string& path, std::string& text) {
  if (value.is_object()) {
    for (const auto& [name, child] : value.items()) {
      std::string child_path = path;
      child_path.append(path.empty() ? "" : ".").append(name);
      appendQuality(child, child_path, text);
    }
  } else if (value.is_number()) {
    text += fmt::format("{:<62} {:>12.4g}\n", path, value.get<double>());
  }
}

// What the report says of where its numbers come from.
ReportProvenance describeRun(const TrialInput& trial,
                             const InputFile& settings,
                             const RunOptions& options) {
  ReportProvenance provenance;
  provenance.job_id = std::filesystem::path(options.out).lexically_normal().filename().string();
  provenance.model = trial.model ? trial.model->name : ShippedCatalog::kDefaultModel;
  provenance.settings_name = settings.name;
  provenance.version = sourceVersion();
  const auto add = [&provenance](const char* part, const std::optional<InputFile>& file) {
    if (file) {
      provenance.inputs.push_back({part,
                                   file->name,
                                   static_cast<std::int64_t>(file->bytes.size()),
                                   calcSha256(file->bytes)});
    }
  };
  add("markers", trial.markers);
  add("grf", trial.ground_reaction);
  add("static", trial.static_markers);
  add("static2", trial.static_markers_2);
  add("emg", trial.emg);
  add("model", trial.model);
  add("coordinates", trial.coordinates);
  add("marker_names", trial.marker_names);
  return provenance;
}

}  // namespace

std::string formatSummary(const std::string& summary_json) {
  const json summary = json::parse(summary_json);
  const json stages = summary.value("stages", json::object());
  std::string text = fmt::format("{:<8} {:>10}  {}\n", "stage", "seconds", "extent");
  for (const char* name : kStageOrder) {
    if (stages.contains(name)) {
      const json& stage = stages[name];
      text += fmt::format(
          "{:<8} {:>10.3f}  {}\n", name, stage.value("seconds", 0.0), describeExtent(stage));
    }
  }
  text += "\n";
  appendQuality(summary.value("quality", json::object()), "", text);
  return text;
}

void runOnFiles(const RunOptions& options,
                const PipelineFunctions& functions,
                std::ostream& out,
                std::ostream& progress) {
  const InputFile settings = readSettings(options);
  const TrialInput trial = readTrial(options);
  functions.check_input(trial, settings);
  const PipelineResult result = functions.run(trial, settings, makeEvents(progress), {});
  for (const auto& [name, bytes] : result.files) {
    writeFile(options.out + "/" + name, bytes);
  }
  for (const auto& [name, table] : result.tables) {
    writeFile(options.out + "/" + kTablesFolder + "/" + name + ".sto",
              functions.encode_sto(table, api::AngleUnit::kRadians));
  }
  const auto warn = [&progress](const std::string& sentence) {
    progress << "warning: " << sentence << '\n';
  };
  const ReportProvenance provenance = describeRun(trial, settings, options);
  for (const auto& [name, bytes] :
       makeRunViews(result, provenance, functions, options.geometry, warn)) {
    writeFile(options.out + "/" + name, bytes);
  }
  out << formatSummary(result.summary_json);
  const auto acceptance = result.files.find("acceptance.txt");
  if (acceptance != result.files.end()) {
    out << '\n' << acceptance->second;
  }
}

}  // namespace gaitmill
