#pragma once

#include <string>
#include <vector>

#include "core/render/camera.h"
#include "core/render/color_scale.h"
#include "core/render/image.h"

namespace gaitmill {

/// What a legend explains.
struct LegendContent {
  std::vector<std::string> instant;   ///< lines: time and percentage, as far as known
  const ColorScale* scale = nullptr;  ///< of the muscles; null = not coloured by a quantity
  bool forces = false;
  bool measured_markers = false;
  bool model_markers = false;
};

/// Where a picture has what. In wide pictures the legend stands left of the body, in others below.
struct Layout {
  double cap_height = 10;  ///< of the legend's text [px]
  bool beside = true;
  Frame legend;  ///< [px]; without extent where the picture is too small for one
  Frame body;    ///< what the body may fill [px]
};

/// @param width  [px] of the whole picture; a strip's poses share one legend below
Layout makeLayout(int width, int height, const LegendContent& content, bool strip);

/// @param pixels_per_newton  length of the forces' arrows in the picture
void drawLegend(const LegendContent& content,
                const Layout& layout,
                double pixels_per_newton,
                Image& image);

/// Text below a pose of a strip.
void drawLabel(const std::string& text,
               const Eigen::Vector2d& middle,
               double cap_height,
               Image& image);

}  // namespace gaitmill
