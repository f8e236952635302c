#pragma once

#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "core/render/font.h"
#include "core/render/image.h"

namespace gaitmill {

/// Colour and opacity of what is painted over an image.
struct Ink {
  Rgb color{};
  double opacity = 1;
};

/// Where a text stands relative to its anchor.
enum class TextAnchor { kLeft, kMiddle, kRight };

/// Draws flat, smooth-edged shapes over an image. All positions in pixels from the upper left
/// corner, y down; what lies outside the image is cut off.
class Canvas {
 public:
  explicit Canvas(Image& image) : image_(image) {}

  void fillRectangle(double left, double top, double right, double bottom, const Ink& ink);
  void fillDisc(const Eigen::Vector2d& center, double radius, const Ink& ink);
  /// Lines with a round pen; where they cross, the ink does not add up.
  void drawStrokes(const std::vector<Stroke>& strokes, double pen_width, const Ink& ink);
  void fillTriangle(const Eigen::Vector2d& a,
                    const Eigen::Vector2d& b,
                    const Eigen::Vector2d& c,
                    const Ink& ink);
  /// @param baseline  of the text at its anchor
  /// @param cap_height  of capitals [px]
  void drawText(std::string_view text,
                const Eigen::Vector2d& baseline,
                double cap_height,
                TextAnchor anchor,
                const Ink& ink);

 private:
  void blend(int x, int y, const Ink& ink, double coverage);
  Image& image_;
};

/// Width of a text [px] with capitals of `cap_height` [px].
double measureText(std::string_view text, double cap_height);

}  // namespace gaitmill
