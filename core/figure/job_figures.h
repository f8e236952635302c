#pragma once

#include <string>
#include <vector>

#include "core/data/figure.h"
#include "core/figure/result_source.h"

namespace gaitmill {

/// The figures that a job's tables suffice for, in the order in which a reader asks for them.
std::vector<FigureInfo> listFigures(const ResultSource& source);

/// One of them with its data: angles in degrees, each side over its own gait cycle, or over time if
/// the trial has no cycle.
/// @throws Error kFigureNotFound naming those there are and the nearest
Figure makeFigure(const ResultSource& source, const std::string& name);

}  // namespace gaitmill
