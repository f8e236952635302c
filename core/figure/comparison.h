#pragma once

#include <string>
#include <vector>

#include "core/data/comparison.h"
#include "core/data/figure.h"
#include "core/figure/result_source.h"

namespace gaitmill {

/// The results of a job and what the reader calls it.
struct NamedResult {
  std::string label;
  const ResultSource* results = nullptr;
};

/// Difference tables of several jobs on the cycle axis, each against the first: radians and SI
/// units as in the tables. Tables and columns that a job does not have are left out.
/// @param results  at least two @throws Error kInputValue
Comparison compareResults(const std::vector<NamedResult>& results);

/// The figures that all of the jobs have.
std::vector<FigureInfo> listCommonFigures(const std::vector<NamedResult>& results);

/// The same figure of several jobs in one: a colour for each job, its label in the legend; dashes
/// stay those of the curves. Panels that a job does not have show the others; bands are left out.
/// @throws Error kInputValue without a job; kFigureNotFound naming the job that has not got it
Figure overlayFigures(const std::vector<NamedResult>& results, const std::string& name);

}  // namespace gaitmill
