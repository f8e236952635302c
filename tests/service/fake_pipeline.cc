#include "tests/service/fake_pipeline.h"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <limits>
#include <thread>
#include <vector>

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
    outcome.files["adjusted_model.osim"] = R"({"markers": []})";
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

// A figure of each of these tables that a job has.
std::vector<FigureInfo> listFakeFigures(const ResultSource& results) {
  std::vector<FigureInfo> list;
  for (const char* name : {"moments", "activations"}) {
    if (results.has(name, ResultSource::Axis::kTime)) {
      list.push_back({name, std::string("The ") + name, "As they are."});
    }
  }
  return list;
}

Figure makeFakeFigure(const ResultSource& results, const std::string& name) {
  for (const FigureInfo& info : listFakeFigures(results)) {
    if (info.name == name) {
      const TimeSeries& table = results.table(name, ResultSource::Axis::kTime);
      Series series;
      series.name = table.labels.front();
      series.x = table.time;
      series.y = {table.values(0, 0), table.values(1, 0), table.values(2, 0)};
      Panel panel;
      panel.name = table.labels.front();
      panel.title = panel.name;
      panel.x = {"Time", "s"};
      panel.y = {"Moment", "N·m"};
      panel.series.push_back(series);
      return {info.name, info.title, info.caption, 1, {panel}};
    }
  }
  throw Error(ErrorCode::kFigureNotFound, "there is no figure '" + name + "'");
}

std::string renderFakeReport(const ReportContent& content) {
  std::string html = "<!doctype html><title>" + content.provenance.job_id + "</title>";
  for (const Figure& figure : content.figures) {
    html += "<h2>" + figure.title + "</h2>";
  }
  for (const ReportImage& image : content.images) {
    html += "<p>" + image.caption + ": " + image.bytes + "</p>";
  }
  for (const ReportInput& input : content.provenance.inputs) {
    html += "<p>" + input.part + " " + input.sha256 + "</p>";
  }
  return html;
}

FigureFunctions makeFakeFigures() {
  FigureFunctions figures;
  figures.list = listFakeFigures;
  figures.make = makeFakeFigure;
  figures.compare = [](const NamedResults& jobs) {
    Comparison comparison;
    for (const NamedResult& job : jobs) {
      comparison.labels.push_back(job.label);
    }
    return comparison;
  };
  figures.list_overlays = [](const NamedResults& jobs) {
    return listFakeFigures(*jobs.front().results);
  };
  figures.make_overlay = [](const NamedResults& jobs, const std::string& name) {
    return makeFakeFigure(*jobs.front().results, name);
  };
  figures.find_instants = [](const ResultSource& results) {
    const TimeSeries& motion = results.table("kinematics", ResultSource::Axis::kTime);
    return std::vector<ReportInstant>{{"Right heel strike", motion.time.front()},
                                      {"Right toe-off", motion.time.back()}};
  };
  figures.render_report = renderFakeReport;
  return figures;
}

// What a picture is of, in words. Views and figures of certain names do what children must survive.
void misbehave(const DrawTask& task) {
  if (task.figure == "crash" || task.options.width == 666) {
    std::raise(SIGKILL);
  }
  if (task.figure == "sleep" || task.options.width == 777) {
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
  }
  if (task.figure == "memory") {
    std::vector<std::vector<char>> all;
    while (true) {
      all.emplace_back(std::size_t{1} << 28U, 'x');
    }
  }
}

Picture drawFake(const DrawTask& task, const DrawData& data) {
  misbehave(task);
  if (task.kind == DrawTask::Kind::kListValidations) {
    return {kFiguresType,
            encodeFigures({{"curves", "Curves", "Of muscles.", 2, {}},
                           {"moment_arms", "Moment arms", "Of muscles.", 2, {}}})};
  }
  if (task.kind == DrawTask::Kind::kValidation) {
    require(task.figure == "curves" || task.figure == "sleep",
            ErrorCode::kFigureNotFound,
            "figures are curves, moment_arms");
    return {kFiguresType, encodeFigures({{task.figure, "Curves", data.picture.model_osim, 2, {}}})};
  }
  const bool is_still = task.kind != DrawTask::Kind::kAnimation;
  return {is_still ? "image/png" : "image/webp",
          "picture of " + std::to_string(data.picture.kinematics.rowCount()) + " rows at " +
              std::to_string(task.start).substr(0, 4)};
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
  functions.figures = makeFakeFigures();
  functions.make_drawing = [](const std::string&) {
    return Drawing(drawFake);
  };
  functions.default_settings = R"({"steps": 4, "step_ms": 0})";
  return functions;
}

}  // namespace gaitmill
