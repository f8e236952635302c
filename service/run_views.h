#pragma once

#include <functional>
#include <map>
#include <string>

#include "core/pipeline/pipeline.h"
#include "core/report/report.h"
#include "service/pipeline_functions.h"

namespace gaitmill {

/// What people look at of a run that has just ended, as files by name: plots/<figure>.vl.json
/// (Vega-Lite), report.html and the images in it. Without a renderer that works the images are left
/// out.
/// @param geometry  folder of meshes; empty = stylised bones
/// @param warn      takes a sentence on what is left out
std::map<std::string, std::string> makeRunViews(
    const PipelineResult& result,
    const ReportProvenance& provenance,
    const PipelineFunctions& functions,
    const std::string& geometry,
    const std::function<void(const std::string&)>& warn);

/// "Right heel strike" to "right_heel_strike.png".
std::string makeImageName(const std::string& instant);
/// "Right heel strike, 0.25 s"
std::string makeImageCaption(const ReportInstant& instant);

// A pose of a report: two beside each other on a page of paper, at twice a screen's pixels.
inline constexpr int kReportPoseWidth = 640;   ///< [px]
inline constexpr int kReportPoseHeight = 720;  ///< [px]

}  // namespace gaitmill
