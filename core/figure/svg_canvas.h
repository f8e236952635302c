#pragma once

#include <string>
#include <vector>

#include "core/data/figure.h"
#include "core/figure/palette.h"

namespace gaitmill {

/// Text as XML content or attribute value. Control characters, which XML cannot hold, become
/// spaces.
std::string escapeXml(const std::string& text);

struct Point {
  double x = 0;
  double y = 0;
};

struct TextStyle {
  double size = 11;              ///< [px]
  const char* anchor = "start";  ///< "start", "middle", "end"
  const char* color = "#222222";
  bool is_bold = false;
  double turn = 0;  ///< [deg] clockwise about its place
};

/// Writes SVG elements; lengths in px, y downward.
class SvgCanvas {
 public:
  void addText(const Point& place, const std::string& text, const TextStyle& style);
  void addLine(const Point& from,
               const Point& to,
               const char* color,
               double width,
               const std::vector<double>& dash = {});
  void addRectangle(const Point& corner, const Point& size, const std::string& attributes);
  void addCircle(const Point& center, double radius, const std::string& color);
  /// Through the points; a point that is not finite interrupts it.
  void addCurve(const std::vector<Point>& points, const SeriesStyle& style, double width);
  /// A closed outline, filled with a light shade of the colour.
  void addArea(const std::vector<Point>& outline, const std::string& color);
  /// Until closeWindow(), coordinates count from `corner` and what lies outside is cut off.
  void openWindow(const Point& corner, const Point& size);
  void closeWindow();

  const std::string& content() const { return out_; }

 private:
  std::string out_;
};

}  // namespace gaitmill
