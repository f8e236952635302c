#pragma once

#include <string>

#include "core/data/figure.h"

namespace gaitmill {

/// A curve without points yet.
inline Series makeSeries(const std::string& name,
                         SeriesRole role = SeriesRole::kPlain,
                         SeriesMark mark = SeriesMark::kLine) {
  Series series;
  series.name = name;
  series.role = role;
  series.mark = mark;
  return series;
}

}  // namespace gaitmill
