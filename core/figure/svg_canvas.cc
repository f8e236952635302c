#include "core/figure/svg_canvas.h"

#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/figure/markup.h"

namespace gaitmill {

namespace {

std::string number(double value) {
  std::string text = formatFixed(value, 1);
  if (text.size() > 2 && text.compare(text.size() - 2, 2, ".0") == 0) {
    text.resize(text.size() - 2);
  }
  return text;
}

std::string attribute(const char* name, double value) {
  return std::string(" ") + name + "=\"" + number(value) + "\"";
}

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + escapeXml(value) + "\"";
}

std::string dashAttribute(const std::vector<double>& dash) {
  std::string lengths;
  for (const double length : dash) {
    lengths += (lengths.empty() ? "" : " ") + number(length);
  }
  return dash.empty() ? "" : attribute("stroke-dasharray", lengths);
}

std::string pointText(const Point& point) {
  return number(point.x) + " " + number(point.y);
}

}  // namespace

std::string escapeXml(const std::string& text) {
  std::string allowed = text;
  std::replace_if(
      allowed.begin(),
      allowed.end(),
      [](char letter) { return static_cast<unsigned char>(letter) < 0x20; },
      ' ');
  return escapeMarkup(allowed);
}

void SvgCanvas::addText(const Point& place, const std::string& text, const TextStyle& style) {
  out_ += "<text" + attribute("x", place.x) + attribute("y", place.y) +
          attribute("font-size", style.size) + attribute("fill", style.color);
  if (std::string(style.anchor) != "start") {
    out_ += attribute("text-anchor", style.anchor);
  }
  if (style.is_bold) {
    out_ += " font-weight=\"600\"";
  }
  if (style.turn != 0) {
    out_ += attribute("transform", "rotate(" + number(style.turn) + " " + pointText(place) + ")");
  }
  out_ += ">" + escapeXml(text) + "</text>";
}

void SvgCanvas::addLine(const Point& from,
                        const Point& to,
                        const char* color,
                        double width,
                        const std::vector<double>& dash) {
  out_ += "<line" + attribute("x1", from.x) + attribute("y1", from.y) + attribute("x2", to.x) +
          attribute("y2", to.y) + attribute("stroke", color) + attribute("stroke-width", width) +
          dashAttribute(dash) + "/>";
}

void SvgCanvas::addRectangle(const Point& corner,
                             const Point& size,
                             const std::string& attributes) {
  out_ += "<rect" + attribute("x", corner.x) + attribute("y", corner.y) +
          attribute("width", size.x) + attribute("height", size.y) + " " + attributes + "/>";
}

void SvgCanvas::addCircle(const Point& center, double radius, const std::string& color) {
  out_ += "<circle" + attribute("cx", center.x) + attribute("cy", center.y) +
          attribute("r", radius) + attribute("fill", color) + "/>";
}

void SvgCanvas::addCurve(const std::vector<Point>& points, const SeriesStyle& style, double width) {
  std::string path;
  bool is_open = false;
  for (const Point& point : points) {
    const bool is_finite = std::isfinite(point.x) && std::isfinite(point.y);
    if (is_finite) {
      path += (is_open ? "L" : "M") + pointText(point);
    }
    is_open = is_finite;
  }
  if (!path.empty()) {
    out_ += "<path" + attribute("d", path) + " fill=\"none\" stroke-linejoin=\"round\"" +
            attribute("stroke", style.color) + attribute("stroke-width", width) +
            dashAttribute(style.dash) + "/>";
  }
}

void SvgCanvas::addArea(const std::vector<Point>& outline, const std::string& color) {
  std::string path;
  for (const Point& point : outline) {
    path += (path.empty() ? "M" : "L") + pointText(point);
  }
  if (!path.empty()) {
    out_ +=
        "<path" + attribute("d", path + "Z") + attribute("fill", color) + " fill-opacity=\"0.2\"/>";
  }
}

void SvgCanvas::openWindow(const Point& corner, const Point& size) {
  out_ += "<svg" + attribute("x", corner.x) + attribute("y", corner.y) +
          attribute("width", size.x) + attribute("height", size.y) + " overflow=\"hidden\">";
}

void SvgCanvas::closeWindow() {
  out_ += "</svg>";
}

}  // namespace gaitmill
