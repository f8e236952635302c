#pragma once

#include <string>
#include <vector>

#include "core/data/comparison.h"
#include "core/data/figure.h"

namespace gaitmill::api {

/// {"name", "title", "caption", "url"}
/// @param url  where the figure is
std::string renderFigureInfo(const FigureInfo& info, const std::string& url);

/// {"items": […], "next_cursor": null}: a list that is always whole.
/// @param folder  path of the figures, without the last slash
/// @param query   with its '?', added to each address; may be empty
std::string renderFigureList(const std::vector<FigureInfo>& figures,
                             const std::string& folder,
                             const std::string& query = "");

/// A comparison as by renderComparison(), with "ids" of the jobs and "plots", where their overlays
/// are.
std::string renderComparisonPage(const std::vector<std::string>& job_ids,
                                 const Comparison& comparison,
                                 const std::vector<FigureInfo>& figures);

}  // namespace gaitmill::api
