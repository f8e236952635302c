#pragma once

#include <string>

#include "core/data/figure.h"

namespace gaitmill {

struct SvgOptions {
  double width = 960;    ///< [px]; the height follows from the panels
  bool heading = false;  ///< title and caption inside the picture
};

/// The figure as an <svg> element that stands alone or inside HTML: axes with ticks and units,
/// legend, guides, bands, bars; no script, no style sheet, no ids, fonts of the reader. Names are
/// escaped.
std::string renderSvg(const Figure& figure, const SvgOptions& options = {});

}  // namespace gaitmill
