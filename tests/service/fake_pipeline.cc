#include "tests/service/fake_pipeline.h"

#include <chrono>
#include <csignal>
#include <limits>
#include <thread>

#include <nlohmann/json.hpp>

#include "core/base/error.h"

namespace gaitmill {

namespace {

using nlohmann::json;

constexpr Stage kStages[] = {
    Stage::kScale, Stage::kIk, Stage::kRra, Stage::kId, Stage::kSo, Stage::kCmc};

void runStage(const json& settings, Stage stage, const PipelineEvents& events) {
  const std::string name = stageName(stage);
  if (settings.value("fail_at", "") == name) {
    throw Error(ErrorCode::kInputMarkers, "markers are missing", {"walk.trc", 7, 3, "RASI"})
        .addContext(name);
  }
  if (settings.value("crash_at", "") == name) {
    std::raise(SIGKILL);
  }
  const int steps = settings.value("steps", 4);
  for (int step = 0; step <= steps; ++step) {
    const bool goes_on = events.progress(stage, static_cast<double>(step) / steps);
    if (!goes_on && !settings.value("deaf", false)) {
      throw Error(ErrorCode::kCancelled, "stopped");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(settings.value("step_ms", 0)));
  }
}

PipelineResult runFake(const TrialInput& input,
                       const InputFile& settings_file,
                       const PipelineEvents& events) {
  const json settings = json::parse(settings_file.bytes);
  if (settings.contains("warn")) {
    events.warn(settings["warn"]);
  }
  for (const Stage stage : kStages) {
    runStage(settings, stage, events);
  }
  PipelineResult result;
  result.files["scaled_model.osim"] = input.markers ? input.markers->bytes : "";
  for (const char* name : {"moments", "activations", "forces", "kinematics", "residuals"}) {
    result.tables[name] = makeFakeTable(name);
  }
  result.cycle_tables["moments"] = makeFakeTable("moments");
  result.summary_json =
      R"({"quality": {"moments": {"ankle_angle_r": {"rmse_nm": 0.25, "worst": "left"}}}})";
  return result;
}

void checkFakeSettings(const InputFile& settings) {
  const json object = json::parse(settings.bytes);
  require(!object.contains("nonsense"),
          ErrorCode::kSettingsUnknownField,
          "unknown field",
          {settings.name, 0, 0, "nonsense"});
}

api::TrialView inspectFake(const api::TrialUpload& upload) {
  api::TrialView view;
  for (const auto& [part, file] : upload.files) {
    require(!file.bytes.empty(), ErrorCode::kFileEmpty, "no bytes", {file.name, 1, 1, ""});
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

}  // namespace

TimeSeries makeFakeTable(const std::string& name) {
  TimeSeries table = makeTimeSeries(name, {"hip_flexion_r", "hip_angle"}, {0.0, 0.5, 1.0});
  table.units = {"N.m", "rad"};
  table.values << 1.5, 0.1, std::numeric_limits<double>::quiet_NaN(), 0.2, -2.0, 0.3;
  return table;
}

PipelineFunctions makeFakePipeline() {
  return {runFake, checkFakeSettings, inspectFake, [](const TimeSeries& table, api::AngleUnit) {
            return table.name + "\nversion=1\nendheader\n";
          }};
}

}  // namespace gaitmill
