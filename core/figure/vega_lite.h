#pragma once

#include <string>

#include "core/data/figure.h"

namespace gaitmill {

/// A complete Vega-Lite v5 specification with its data inside: panels in columns, each with bands,
/// bars, curves, guides, axis titles with units. Ordinates have four significant digits; NaN is
/// null and interrupts a curve.
std::string renderVegaLite(const Figure& figure);

/// The bare numbers: {"name", "title", "caption", "panels": [{"name", "title", "x": {"label",
/// "unit"}, "y": ..., "series": [{"name", "mark", "x" or "categories", "y", "low"}], "guides":
/// [{"direction", "value", "label"}], "note"}]}, full precision, NaN as null.
std::string renderFigureData(const Figure& figure);

}  // namespace gaitmill
