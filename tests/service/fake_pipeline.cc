#include "tests/service/fake_pipeline.h"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <limits>
#include <thread>

#include <nlohmann/json.hpp>

#include "core/base/error.h"

namespace gaitmill {

namespace {

using nlohmann::json;

bool goesOn(const json& settings, Stage stage, double fraction, const PipelineEvents& events) {
  return events.progress(stage, fraction) || settings.value("deaf", false);
}

void requireGoingOn(const json& settings,
                    Stage stage,
                    double fraction,
                    const PipelineEvents& events) {
  require(goesOn(settings, stage, fraction, events), ErrorCode::kCancelled, "stopped");
}

void waitForGate(const json& settings, Stage stage, const PipelineEvents& events) {
  if (!settings.contains("gate")) {
    return;
  }
  const std::string gate = settings["gate"].get<std::string>() + "." + stageName(stage);
  while (!std::filesystem::exists(gate)) {
    requireGoingOn(settings, stage, 0.0, events);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

void computeStage(const json& settings, Stage stage, const PipelineEvents& events) {
  const std::string name = stageName(stage);
  requireGoingOn(settings, stage, 0.0, events);
  waitForGate(settings, stage, events);
  if (settings.value("fail_at", "") == name) {
    Where where{"walk.trc", 7, 3, "RASI"};
    where.stage = name;
    throw Error(ErrorCode::kInputMarkers, "markers are missing", where).addContext(name);
  }
  if (settings.value("crash_at", "") == name) {
    std::raise(SIGKILL);
  }
  const int steps = settings.value("steps", 4);
  for (int step = 0; step <= steps; ++step) {
    requireGoingOn(settings, stage, static_cast<double>(step) / steps, events);
    std::this_thread::sleep_for(std::chrono::milliseconds(settings.value("step_ms", 0)));
  }
}

StageOutcome makeOutcome(const TrialInput& input, Stage stage) {
  StageOutcome outcome;
  outcome.stage = stage;
  const std::string name = stageName(stage);
  outcome.checkpoint = "checkpoint of " + name;
  outcome.files[name + ".txt"] = "what " + name + " leaves\n";
  if (stage == Stage::kScale) {
    outcome.files["scaled_model.osim"] = input.markers ? input.markers->bytes : "";
  }
  if (stage == Stage::kId) {
    outcome.tables["moments"] = makeFakeTable("moments");
    outcome.tables["moments"].values(0, 0) = 1.25;
  }
  if (stage == Stage::kCmc) {
    for (const char* table : {"moments", "activations", "forces", "kinematics", "residuals"}) {
      outcome.tables[table] = makeFakeTable(table);
    }
    outcome.cycle_tables["moments"] = makeFakeTable("moments");
  }
  return outcome;
}

template <class Map>
void mergeInto(Map& target, const Map& source) {
  for (const auto& [name, value] : source) {
    target[name] = value;
  }
}

PipelineResult runFake(const TrialInput& input,
                       const InputFile& settings_file,
                       const PipelineEvents& events,
                       const std::vector<std::string>& checkpoints) {
  const json settings = json::parse(settings_file.bytes);
  PipelineResult result;
  if (settings.contains("warn")) {
    result.warnings.push_back(settings["warn"]);
    if (checkpoints.empty() && events.warn) {
      events.warn(settings["warn"]);
    }
  }
  for (int i = 0; i < kStageCount; ++i) {
    const auto stage = static_cast<Stage>(i);
    const StageOutcome outcome = makeOutcome(input, stage);
    if (static_cast<std::size_t>(i) < checkpoints.size()) {
      require(checkpoints[static_cast<std::size_t>(i)] == outcome.checkpoint,
              ErrorCode::kCheckpointUnusable,
              "not a checkpoint of this stage");
    } else {
      computeStage(settings, stage, events);
      if (events.stage_done) {
        events.stage_done(outcome);
      }
    }
    mergeInto(result.files, outcome.files);
    mergeInto(result.tables, outcome.tables);
    mergeInto(result.cycle_tables, outcome.cycle_tables);
  }
  result.summary_json =
      R"({"quality": {"moments": {"ankle_angle_r": {"rmse_nm": 0.25, "worst": "left"}}}})";
  return result;
}

void checkFakeInput(const TrialInput& input, const InputFile& settings) {
  const json object = json::parse(settings.bytes);
  require(!object.contains("nonsense"),
          ErrorCode::kSettingsUnknownField,
          "unknown field",
          {settings.name, 0, 0, "nonsense"});
  require(input.markers || input.coordinates,
          ErrorCode::kInputMissing,
          "there are no markers",
          {"", 0, 0, "markers"});
}

api::TrialView inspectFake(const api::TrialUpload& upload) {
  api::TrialView view;
  for (const auto& [part, file] : upload.files) {
    require(file.bytes->size() > 0, ErrorCode::kFileEmpty, "no bytes", {file.name, 1, 1, ""});
    api::UnderstoodFile understood;
    understood.part = part;
    understood.name = file.name;
    understood.format = "trc";
    understood.frames = 3;
    understood.labels_kind = "markers";
    understood.labels = {"RASI", "LASI"};
    view.files.push_back(understood);
  }
  return view;
}

// Documents are {"markers": […], …}.
std::string readFakeDocument(const InputFile& document) {
  const json object = json::parse(document.bytes, nullptr, false);
  require(object.is_object() && object.contains("markers"),
          ErrorCode::kModelXml,
          "not such a document",
          {document.name, 1, 1, ""});
  return object.dump();
}

}  // namespace

TimeSeries makeFakeTable(const std::string& name) {
  TimeSeries table = makeTimeSeries(name, {"hip_flexion_r", "hip_angle"}, {0.0, 0.5, 1.0});
  table.units = {"N.m", "rad"};
  table.values << 1.5, 0.1, std::numeric_limits<double>::quiet_NaN(), 0.2, -2.0, 0.3;
  return table;
}

PipelineFunctions makeFakePipeline() {
  PipelineFunctions functions;
  functions.run = runFake;
  functions.check_input = checkFakeInput;
  functions.inspect = inspectFake;
  functions.read_model = readFakeDocument;
  functions.read_marker_set = readFakeDocument;
  functions.encode_sto = [](const TimeSeries& table, api::AngleUnit) {
    return table.name + "\nversion=1\nendheader\n";
  };
  functions.default_settings = R"({"steps": 4, "step_ms": 0})";
  return functions;
}

}  // namespace gaitmill
