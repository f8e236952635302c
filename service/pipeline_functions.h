#pragma once

#include <functional>
#include <string>
#include <vector>

#include "api/dto/result.h"
#include "api/dto/trial.h"
#include "core/data/figure.h"
#include "core/figure/comparison.h"
#include "core/figure/result_source.h"
#include "core/pipeline/pipeline.h"
#include "core/report/report.h"
#include "service/draw_task.h"

namespace gaitmill {

/// As Pipeline::run: goes on after the stages whose checkpoints are given.
using PipelineRunner = std::function<PipelineResult(const TrialInput& input,
                                                    const InputFile& settings,
                                                    const PipelineEvents& events,
                                                    const std::vector<std::string>& checkpoints)>;
/// As Pipeline::checkInput: whether a job can start. Looks only at which files there are.
using InputCheck = std::function<void(const TrialInput& input, const InputFile& settings)>;
/// Reads every file of an upload; fills `files`, `events` and `warnings` of the view, without the
/// match against marker sets. Called from several threads at once.
/// @throws Error of the parser that refuses a file
using TrialInspector = std::function<api::TrialView(const api::TrialUpload& upload)>;
/// A catalog document to the JSON of what was understood (api::CatalogEntry::summary_json).
/// @throws Error of the reader that refuses it
using DocumentReader = std::function<std::string(const InputFile& document)>;
/// What draws in the process that calls it. @param geometry  folder of meshes; empty = none
using DrawingMaker = std::function<Drawing(const std::string& geometry)>;
using StoEncoder = std::function<std::string(const TimeSeries& table, api::AngleUnit angles)>;

using NamedResults = std::vector<NamedResult>;

/// What is shown of results besides images.
struct FigureFunctions {
  std::function<std::vector<FigureInfo>(const ResultSource& results)> list;
  /// @throws Error kFigureNotFound
  std::function<Figure(const ResultSource& results, const std::string& name)> make;
  std::function<Comparison(const NamedResults& jobs)> compare;
  std::function<std::vector<FigureInfo>(const NamedResults& jobs)> list_overlays;
  /// @throws Error kFigureNotFound
  std::function<Figure(const NamedResults& jobs, const std::string& name)> make_overlay;
  std::function<std::vector<ReportInstant>(const ResultSource& results)> find_instants;
  std::function<std::string(const ReportContent& content)> render_report;
};

/// What the service needs of the physics, so that its tests can put something quick in its place.
struct PipelineFunctions {
  PipelineRunner run;
  InputCheck check_input;
  TrialInspector inspect;
  DocumentReader read_model;
  DocumentReader read_marker_set;  ///< JSON with the members "markers", those of inverse kinematics
  StoEncoder encode_sto;
  FigureFunctions figures;
  DrawingMaker make_drawing;
  std::string default_settings;  ///< a document with every field and its default
};

}  // namespace gaitmill
