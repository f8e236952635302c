#include "core/figure/svg.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/text.h"
#include "core/figure/palette.h"
#include "core/figure/svg_canvas.h"
#include "core/figure/text_layout.h"
#include "core/figure/ticks.h"

namespace gaitmill {

namespace {

constexpr double kGap = 8;              // between panels [px]
constexpr double kAxisLeft = 48;        // tick labels and axis title left of the plot [px]
constexpr double kRight = 12;           // beside the plot, for half a tick label [px]
constexpr double kLine = 14;            // from one line of text to the next [px]
constexpr double kTextSize = 11;        // [px]
constexpr double kSmallSize = 9.5;      // tick labels, notes, guides [px]
constexpr double kSample = 24;          // of a line in the legend [px]
constexpr double kBoldSize = 12.5;      // of which bold titles are as wide [px]
constexpr double kTurn = 65;            // of long categories [deg]
constexpr double kTurnedHeight = 0.91;  // sine of it
constexpr double kNarrow = 230;         // below this a plot has no room for labels of guides [px]
constexpr const char* kFrame = "#8c8c8c";
constexpr const char* kGrid = "#e4e4e4";
constexpr const char* kZero = "#b0b0b0";
constexpr const char* kGuide = "#555555";
constexpr const char* kQuiet = "#555555";  // of text that is not the first to be read

double toDouble(std::size_t count) {
  return static_cast<double>(count);
}

/// Where a legend's entries stand, line by line.
struct LegendPlace {
  LegendEntry entry;
  Point place;
};

std::vector<LegendPlace> placeLegend(const std::vector<LegendEntry>& legend, double width) {
  std::vector<LegendPlace> places;
  Point next{0, 0};
  for (const LegendEntry& entry : legend) {
    const double length = kSample + 6 + estimateTextWidth(entry.name, kTextSize) + 16;
    if (next.x > 0 && next.x + length > width) {
      next = {0, next.y + kLine};
    }
    places.push_back({entry, next});
    next.x += length;
  }
  return places;
}

double findHeight(const std::vector<LegendPlace>& places) {
  return places.empty() ? 0 : places.back().place.y + kLine + 4;
}

void drawLegend(const std::vector<LegendPlace>& places, const Point& corner, SvgCanvas& canvas) {
  for (const LegendPlace& item : places) {
    const Point start{corner.x + item.place.x, corner.y + item.place.y + 6};
    const Point end{start.x + kSample, start.y};
    const std::string& color = item.entry.style.color;
    switch (item.entry.mark) {
      case SeriesMark::kLine:
        canvas.addCurve({start, end}, item.entry.style, 1.8);
        break;
      case SeriesMark::kBand:
        canvas.addRectangle(
            {start.x, start.y - 5}, {kSample, 10}, "fill=\"" + color + "\" fill-opacity=\"0.2\"");
        break;
      case SeriesMark::kPoints:
        canvas.addCircle({0.5 * (start.x + end.x), start.y}, 2.5, color);
        break;
      case SeriesMark::kBars:
        canvas.addRectangle({start.x + 6, start.y - 5}, {10, 10}, "fill=\"" + color + "\"");
        break;
    }
    canvas.addText({end.x + 6, start.y + 4}, item.entry.name, {});
  }
}

std::vector<std::string> findCategories(const Panel& panel) {
  std::vector<std::string> categories;
  for (const Series& series : panel.series) {
    for (const std::string& category : series.categories) {
      if (std::find(categories.begin(), categories.end(), category) == categories.end()) {
        categories.push_back(category);
      }
    }
  }
  return categories;
}

/// What is asked for of one panel, and the space that each of its parts takes.
struct PanelPlan {
  const Panel* panel = nullptr;
  double width = 0;  ///< [px] of the whole panel
  std::vector<std::string> title;
  std::vector<std::string> note;
  std::vector<LegendPlace> legend;
  std::vector<std::string> categories;
  bool has_x_title = true;
  bool has_y_title = true;
  double plot_height = 0;
  double bottom = 0;  ///< [px] tick labels and axis title below the plot

  double plotWidth() const { return width - kAxisLeft - kRight; }
  double top() const {
    return kLine * toDouble(title.size()) + (kLine - 2) * toDouble(note.size()) +
           findHeight(legend) + 6;
  }
  double height() const { return top() + plot_height + bottom; }
  double categoryWidth() const { return plotWidth() / std::max(1.0, toDouble(categories.size())); }
  bool turnsCategories() const {
    return std::any_of(categories.begin(), categories.end(), [&](const std::string& category) {
      return estimateTextWidth(category, kSmallSize) > categoryWidth() - 2;
    });
  }
};

double findCategoryHeight(const PanelPlan& plan) {
  double longest = 0;
  for (const std::string& category : plan.categories) {
    longest = std::max(longest, estimateTextWidth(category, kSmallSize));
  }
  return plan.turnsCategories() ? kTurnedHeight * longest + 12 : 16;
}

PanelPlan planPanel(const Panel& panel, double width, bool has_own_legend) {
  PanelPlan plan;
  plan.panel = &panel;
  plan.width = width;
  plan.title = wrapText(panel.title, kBoldSize, width - 4);
  plan.note = wrapText(panel.note, kSmallSize, width - 4);
  plan.categories = findCategories(panel);
  if (has_own_legend) {
    plan.legend = placeLegend(makeLegend(panel), width - kAxisLeft);
  }
  plan.plot_height = std::clamp(0.58 * plan.plotWidth(), 84.0, 230.0);
  plan.bottom = plan.categories.empty() ? 16 : findCategoryHeight(plan);
  return plan;
}

/// Draws one panel with its plot's upper left corner at `corner`.
class PanelPainter {
 public:
  PanelPainter(const PanelPlan& plan, const Point& corner, SvgCanvas& canvas)
      : plan_(plan),
        panel_(*plan.panel),
        corner_(corner),
        size_{plan.plotWidth(), plan.plot_height},
        canvas_(canvas) {
    const Range x = findDataX(panel_);
    const Range y = findDataY(panel_);
    // Curves over time or the cycle end where they end; only ordinates get air.
    x_ = {panel_.x.low.value_or(x.low), panel_.x.high.value_or(x.high)};
    if (!(x_.high > x_.low)) {
      x_.high = x_.low + 1;
    }
    y_ = findRange(panel_.y, y.low, y.high, yTickCount());
  }

  void paint() {
    paintGrid();
    paintXAxis();
    paintGuideLabels();
    canvas_.openWindow({corner_.x, corner_.y - 2}, {size_.x, size_.y + 4});
    paintGuides();
    const std::vector<SeriesStyle> styles = findStyles(panel_);
    for (const SeriesMark mark :
         {SeriesMark::kBand, SeriesMark::kBars, SeriesMark::kLine, SeriesMark::kPoints}) {
      for (std::size_t i = 0; i < panel_.series.size(); ++i) {
        if (panel_.series[i].mark == mark) {
          paintSeries(panel_.series[i], styles[i]);
        }
      }
    }
    canvas_.closeWindow();
  }

 private:
  int yTickCount() const { return size_.y > 140 ? 5 : 3; }
  int xTickCount() const { return size_.x > 240 ? 8 : 4; }

  // In the window: x from the plot's left edge, y from 2 px above its upper one.
  Point place(double x, double y) const {
    return {size_.x * (x - x_.low) / (x_.high - x_.low), 2 + placeY(y)};
  }
  double placeY(double y) const { return size_.y * (y_.high - y) / (y_.high - y_.low); }

  void paintGrid() {
    const std::vector<double> ticks = makeTicks(y_, yTickCount());
    const std::vector<std::string> labels = labelTicks(ticks);
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      const double y = corner_.y + placeY(ticks[i]);
      canvas_.addLine({corner_.x, y}, {corner_.x + size_.x, y}, ticks[i] == 0 ? kZero : kGrid, 1);
      canvas_.addText({corner_.x - 5, y + 3.5}, labels[i], {kSmallSize, "end"});
    }
    canvas_.addRectangle(corner_, size_, std::string("fill=\"none\" stroke=\"") + kFrame + "\"");
    if (plan_.has_y_title) {
      canvas_.addText(
          {corner_.x - kAxisLeft + 11, corner_.y + 0.5 * size_.y},
          makeAxisTitle(panel_.y),
          {fitSize(makeAxisTitle(panel_.y), size_.y + 4), "middle", kQuiet, false, -90});
    }
  }

  static double fitSize(const std::string& text, double length) {
    const double width = estimateTextWidth(text, kTextSize);
    return width <= length ? kTextSize : std::max(7.5, kTextSize * length / width);
  }

  void paintXAxis() {
    const double bottom = corner_.y + size_.y;
    if (plan_.categories.empty()) {
      const std::vector<double> ticks = makeTicks(x_, xTickCount());
      const std::vector<std::string> labels = labelTicks(ticks);
      for (std::size_t i = 0; i < ticks.size(); ++i) {
        const double x = corner_.x + place(ticks[i], 0).x;
        canvas_.addLine({x, bottom}, {x, bottom + 3}, kFrame, 1);
        canvas_.addText({x, bottom + 13}, labels[i], {kSmallSize, "middle"});
      }
    } else {
      paintCategories(bottom);
    }
    if (plan_.has_x_title) {
      canvas_.addText({corner_.x + 0.5 * size_.x, bottom + plan_.bottom - 4},
                      makeAxisTitle(panel_.x),
                      {kTextSize, "middle", kQuiet});
    }
  }

  void paintCategories(double bottom) {
    for (std::size_t i = 0; i < plan_.categories.size(); ++i) {
      const double x = corner_.x + (toDouble(i) + 0.5) * plan_.categoryWidth();
      if (plan_.turnsCategories()) {
        canvas_.addText({x + 3, bottom + 9},
                        plan_.categories[i],
                        {kSmallSize, "end", "#222222", false, -kTurn});
      } else {
        canvas_.addText({x, bottom + 12}, plan_.categories[i], {kSmallSize, "middle"});
      }
    }
  }

  void paintGuides() {
    for (const Guide& guide : panel_.guides) {
      if (guide.direction == Guide::Direction::kHorizontal) {
        const double y = place(0, guide.value).y;
        canvas_.addLine({0, y}, {size_.x, y}, kGuide, 1, {4, 3});
      } else {
        const double x = place(guide.value, 0).x;
        canvas_.addLine({x, 0}, {x, size_.y + 4}, kGuide, 1, {4, 3});
      }
    }
  }

  // Vertical guides are labelled above the plot's upper edge inside the plot, one line each, so
  // that close ones do not overlap.
  void paintGuideLabels() {
    if (size_.x < kNarrow) {
      return;
    }
    double line = 10;
    for (const Guide& guide : panel_.guides) {
      if (guide.direction == Guide::Direction::kHorizontal) {
        canvas_.addText({corner_.x + size_.x - 4, corner_.y + placeY(guide.value) - 3},
                        guide.label,
                        {kSmallSize - 0.5, "end", kGuide});
        continue;
      }
      const double x = place(guide.value, 0).x;
      const bool is_right = x > 0.65 * size_.x;
      canvas_.addText({corner_.x + x + (is_right ? -4 : 4), corner_.y + line},
                      guide.label,
                      {kSmallSize - 0.5, is_right ? "end" : "start", kGuide});
      line += 11;
    }
  }

  void paintSeries(const Series& series, const SeriesStyle& style) {
    switch (series.mark) {
      case SeriesMark::kLine:
        return canvas_.addCurve(placeAll(series.x, series.y), style, 1.6);
      case SeriesMark::kBand:
        return paintBand(series, style);
      case SeriesMark::kPoints:
        for (const Point& point : placeAll(series.x, series.y)) {
          if (std::isfinite(point.x) && std::isfinite(point.y)) {
            canvas_.addCircle(point, 2.2, style.color);
          }
        }
        return;
      case SeriesMark::kBars:
        return paintBars(series, style);
    }
  }

  std::vector<Point> placeAll(const std::vector<double>& x, const std::vector<double>& y) const {
    std::vector<Point> points;
    points.reserve(x.size());
    for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
      points.push_back(place(x[i], y[i]));
    }
    return points;
  }

  // A value that is not a number ends one area; the next begins another.
  void paintBand(const Series& series, const SeriesStyle& style) {
    const std::vector<Point> upper = placeAll(series.x, series.y);
    const std::vector<Point> lower = placeAll(series.x, series.low);
    const std::size_t count = std::min(upper.size(), lower.size());
    std::vector<Point> outline;
    for (std::size_t i = 0; i <= count; ++i) {
      if (i < count && std::isfinite(upper[i].y) && std::isfinite(lower[i].y)) {
        outline.insert(outline.begin() + static_cast<std::ptrdiff_t>(outline.size() / 2),
                       {upper[i], lower[i]});
        continue;
      }
      canvas_.addArea(outline, style.color);
      outline.clear();
    }
  }

  // Bars of one category stand side by side, one place for each name: two series of one name, say
  // positive and negative work, share theirs.
  void paintBars(const Series& series, const SeriesStyle& style) {
    const std::vector<LegendEntry> legend = makeLegend(panel_);
    const auto entry = std::find_if(legend.begin(), legend.end(), [&](const LegendEntry& one) {
      return one.name == series.name;
    });
    const double slot = toDouble(static_cast<std::size_t>(entry - legend.begin()));
    const double width = 0.8 * plan_.categoryWidth() / toDouble(legend.size());
    for (std::size_t i = 0; i < std::min(series.categories.size(), series.y.size()); ++i) {
      const auto category =
          std::find(plan_.categories.begin(), plan_.categories.end(), series.categories[i]);
      const double index = toDouble(static_cast<std::size_t>(category - plan_.categories.begin()));
      if (std::isfinite(series.y[i])) {
        const double x = (index + 0.1) * plan_.categoryWidth() + slot * width;
        const double zero = place(0, std::clamp(0.0, y_.low, y_.high)).y;
        const double end = place(0, series.y[i]).y;
        canvas_.addRectangle({x, std::min(zero, end)},
                             {std::max(1.0, width - 1), std::abs(end - zero)},
                             "fill=\"" + style.color + "\"");
      }
    }
  }

  const PanelPlan& plan_;
  const Panel& panel_;
  Point corner_;
  Point size_;
  SvgCanvas& canvas_;
  Range x_;
  Range y_;
};

void paintPanel(const PanelPlan& plan, double top, const Point& corner, SvgCanvas& canvas) {
  double y = corner.y + top - plan.top() + 10;
  for (const std::string& line : plan.title) {
    canvas.addText({corner.x + 4, y}, line, {kTextSize + 0.5, "start", "#222222", true});
    y += kLine;
  }
  for (const std::string& line : plan.note) {
    canvas.addText({corner.x + 4, y - 1}, line, {kSmallSize, "start", kQuiet});
    y += kLine - 2;
  }
  drawLegend(plan.legend, {corner.x + kAxisLeft, y - 6}, canvas);
  PanelPainter(plan, {corner.x + kAxisLeft, corner.y + top}, canvas).paint();
}

/// Panels of the figure in rows; an axis title that the neighbour has already said is left out.
std::vector<std::vector<PanelPlan>> planRows(const Figure& figure,
                                             const SvgOptions& options,
                                             bool has_own_legends) {
  const std::size_t columns = std::min(static_cast<std::size_t>(std::max(1, figure.columns)),
                                       std::max<std::size_t>(1, figure.panels.size()));
  const double width = (options.width - kGap * toDouble(columns - 1)) / toDouble(columns);
  std::vector<std::vector<PanelPlan>> rows;
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const Panel& panel = figure.panels[i];
    PanelPlan plan = planPanel(panel, width, has_own_legends);
    plan.has_y_title =
        i % columns == 0 || makeAxisTitle(figure.panels[i - 1].y) != makeAxisTitle(panel.y);
    plan.has_x_title = i + columns >= figure.panels.size() ||
                       makeAxisTitle(figure.panels[i + columns].x) != makeAxisTitle(panel.x);
    plan.bottom += plan.has_x_title ? 15 : 0;
    if (i % columns == 0) {
      rows.emplace_back();
    }
    rows.back().push_back(plan);
  }
  return rows;
}

double paintHeading(const Figure& figure, double width, SvgCanvas& canvas) {
  double y = 18;
  canvas.addText({4, y}, figure.title, {16, "start", "#222222", true});
  for (const std::string& line : wrapText(figure.caption, kTextSize, width - 8)) {
    y += kLine;
    canvas.addText({4, y}, line, {kTextSize, "start", kQuiet});
  }
  return y + 12;
}

}  // namespace

std::string renderSvg(const Figure& figure, const SvgOptions& options) {
  SvgCanvas canvas;
  const std::vector<LegendEntry> shared = makeSharedLegend(figure);
  double y = options.heading ? paintHeading(figure, options.width, canvas) : 4;
  const std::vector<LegendPlace> legend = placeLegend(shared, options.width);
  if (shared.size() > 1) {
    drawLegend(legend, {4, y}, canvas);
    y += findHeight(legend) + 4;
  }
  for (const std::vector<PanelPlan>& row : planRows(figure, options, shared.empty())) {
    double top = 0;
    double below = 0;
    for (const PanelPlan& plan : row) {
      top = std::max(top, plan.top());
      below = std::max(below, plan.plot_height + plan.bottom);
    }
    double x = 0;
    for (const PanelPlan& plan : row) {
      paintPanel(plan, top, {x, y}, canvas);
      x += plan.width + kGap;
    }
    y += top + below + kGap;
  }
  const std::string width = formatFixed(options.width, 0);
  const std::string height = formatFixed(std::ceil(y), 0);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + height +
         "\" viewBox=\"0 0 " + width + " " + height + "\" role=\"img\" aria-label=\"" +
         escapeXml(figure.title) +
         "\" font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\">" + canvas.content() +
         "</svg>\n";
}

}  // namespace gaitmill
