#pragma once

#include <string>
#include <vector>

#include "core/data/figure.h"

namespace gaitmill {

/// How a series is drawn, whatever draws it.
struct SeriesStyle {
  std::string color;         ///< "#0072B2"
  std::vector<double> dash;  ///< [px] drawn, left out, ...; empty = solid
};

/// The styles of a panel's series, in their order. Colours are those of Okabe and Ito (2008, "Color
/// universal design"), which readers with any colour vision tell apart; the dash says it once more
/// for prints without colour. Series of one name share a style.
std::vector<SeriesStyle> findStyles(const Panel& panel);

/// One entry of a legend.
struct LegendEntry {
  std::string name;
  SeriesStyle style;
  SeriesMark mark = SeriesMark::kLine;
};

/// The named series of a panel, each name once, in their order; a line stands before its band.
std::vector<LegendEntry> makeLegend(const Panel& panel);

/// The one legend of all panels if a name looks the same in all of them, no two names look alike,
/// and they are few; empty if each panel needs its own.
std::vector<LegendEntry> makeSharedLegend(const Figure& figure);

}  // namespace gaitmill
