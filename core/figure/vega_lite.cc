#include "core/figure/vega_lite.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/numbers.h"
#include "core/figure/palette.h"
#include "core/figure/text_layout.h"
#include "core/figure/ticks.h"

namespace gaitmill {

namespace {

using nlohmann::json;

/// Names come from outside: what is no UTF-8 is replaced.
std::string dumpJson(const json& document) {
  return document.dump(-1, ' ', false, json::error_handler_t::replace);
}

constexpr const char* kSchema = "https://vega.github.io/schema/vega-lite/v5.json";
constexpr double kWidth = 960;          // of all panels side by side [px]
constexpr double kAround = 62;          // of a panel beside its plot: axis and gap [px]
constexpr double kCaptionWidth = 720;   // programs without fonts take texts for wider [px]
constexpr double kBelow = 52;           // of a panel below its plot: axis and gap [px]
constexpr double kNarrow = 230;         // below this a plot has no room for labels of guides [px]
constexpr double kTitleSize = 12;       // of panels [px]
constexpr double kNoteSize = 10;        // [px]
constexpr double kTurn = 65;            // of categories [deg]
constexpr double kTurnedHeight = 0.91;  // sine of it
constexpr double kTitleLine = 14;       // from one line of a title to the next [px]
constexpr const char* kGuide = "#555555";
constexpr const char* kQuiet = "#555555";

// More digits are not seen, and specifications stay small.
json toJson(double value, int digits) {
  return std::isfinite(value) ? json(roundSignificant(value, digits)) : json(nullptr);
}
json toOrdinate(double value) {
  return toJson(value, 4);
}
json toAbscissa(double value) {
  return toJson(value, 6);
}

/// Names, colours and dashes of a legend as the scales that all layers of its panels share.
struct StyleScales {
  json color;
  json dash;
};

StyleScales makeScales(const std::vector<LegendEntry>& legend) {
  json names = json::array();
  json colors = json::array();
  json dashes = json::array();
  for (const LegendEntry& entry : legend) {
    names.push_back(entry.name);
    colors.push_back(entry.style.color);
    dashes.push_back(entry.style.dash.empty() ? json{1, 0} : json(entry.style.dash));
  }
  return {{{"domain", names}, {"range", colors}}, {{"domain", names}, {"range", dashes}}};
}

/// How far turned categories reach below their axis [px]; 0 without any.
double findCategoryHeight(const Panel& panel) {
  double longest = 0;
  for (const Series& series : panel.series) {
    for (const std::string& category : series.categories) {
      longest = std::max(longest, estimateTextWidth(category, kNoteSize));
    }
  }
  return kTurnedHeight * longest;
}

/// One panel as a layered view.
class PanelView {
 public:
  PanelView(const Panel& panel, const std::vector<LegendEntry>& legend, double width)
      : panel_(panel),
        scales_(makeScales(legend)),
        has_legend_(legend.size() > 1),
        width_(std::round(width)),
        height_(std::round(std::clamp(0.58 * width, 84.0, 230.0))) {}

  json render() const {
    json layers = json::array();
    if (hasBars()) {
      layers.push_back(renderBars());
    }
    for (const std::vector<std::size_t>& group : groupByAbscissa()) {
      layers.push_back(renderGroup(group));
    }
    renderGuides(layers);
    return {{"description", panel_.name},
            {"title", renderTitle()},
            {"width", width_},
            {"height", height_},
            {"layer", layers}};
  }

 private:
  bool hasBars() const {
    return std::any_of(panel_.series.begin(), panel_.series.end(), [](const Series& series) {
      return series.mark == SeriesMark::kBars;
    });
  }

  json renderTitle() const {
    json title = {{"text", wrapText(panel_.title, kTitleSize, width_ + 30)},
                  {"anchor", "start"},
                  {"frame", "group"},
                  {"offset", 6},
                  {"fontSize", kTitleSize}};
    if (!panel_.note.empty()) {
      title["subtitle"] = wrapText(panel_.note, kNoteSize, width_ + 40);
      title["subtitleFontSize"] = kNoteSize;
      title["subtitleColor"] = kQuiet;
    }
    return title;
  }

  // The ticks of our own pictures, with the digits that tell them apart.
  static json renderTicks(const std::vector<double>& ticks) {
    return {{"values", ticks}, {"format", "." + std::to_string(countDecimals(ticks)) + "f"}};
  }

  json xEncoding(const std::string& field) const {
    const Range data = findDataX(panel_);
    const double low = panel_.x.low.value_or(data.low);
    const double high = panel_.x.high.value_or(data.high);
    json axis = renderTicks(makeTicks({low, high}, width_ > 240 ? 8 : 4));
    axis["grid"] = false;
    return {{"field", field},
            {"type", "quantitative"},
            {"title", makeAxisTitle(panel_.x)},
            {"scale",
             {{"domain", {toAbscissa(low), toAbscissa(high)}}, {"nice", false}, {"zero", false}}},
            {"axis", axis}};
  }

  json yEncoding(const std::string& field) const {
    const int ticks = height_ > 140 ? 5 : 3;
    const Range data = findDataY(panel_);
    const Range range = findRange(panel_.y, data.low, data.high, ticks);
    return {{"field", field},
            {"type", "quantitative"},
            {"title", makeAxisTitle(panel_.y)},
            {"scale",
             {{"domain", {toOrdinate(range.low), toOrdinate(range.high)}},
              {"nice", false},
              {"zero", false}}},
            {"axis", renderTicks(makeTicks(range, ticks))}};
  }

  // Colour and dash of the field "series", whose legends become one.
  json colorEncoding() const {
    json color = {
        {"field", "series"}, {"type", "nominal"}, {"scale", scales_.color}, {"title", nullptr}};
    if (!has_legend_) {
      color["legend"] = nullptr;
    } else if (hasBars()) {
      color["legend"] = {{"symbolType", "square"}, {"symbolSize", 100}, {"symbolStrokeWidth", 0}};
    }
    return color;
  }

  json dashEncoding() const {
    json dash = {
        {"field", "series"}, {"type", "nominal"}, {"scale", scales_.dash}, {"title", nullptr}};
    if (!has_legend_) {
      dash["legend"] = nullptr;
    }
    return dash;
  }

  // Series over the same abscissae share their rows, so that these are not said again.
  std::vector<std::vector<std::size_t>> groupByAbscissa() const {
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < panel_.series.size(); ++i) {
      if (panel_.series[i].mark == SeriesMark::kBars) {
        continue;
      }
      const auto known = std::find_if(groups.begin(), groups.end(), [&](const auto& group) {
        return panel_.series[group.front()].x == panel_.series[i].x;
      });
      if (known == groups.end()) {
        groups.push_back({i});
      } else {
        known->push_back(i);
      }
    }
    return groups;
  }

  static std::string yField(std::size_t series) { return "y" + std::to_string(series); }
  static std::string lowField(std::size_t series) { return "low" + std::to_string(series); }

  json renderRows(const std::vector<std::size_t>& group) const {
    json rows = json::array();
    const std::vector<double>& x = panel_.series[group.front()].x;
    for (std::size_t row = 0; row < x.size(); ++row) {
      json entry = {{"x", toAbscissa(x[row])}};
      for (const std::size_t i : group) {
        const Series& series = panel_.series[i];
        if (row < series.y.size()) {
          entry[yField(i)] = toOrdinate(series.y[row]);
        }
        if (row < series.low.size()) {
          entry[lowField(i)] = toOrdinate(series.low[row]);
        }
      }
      rows.push_back(std::move(entry));
    }
    return rows;
  }

  json renderGroup(const std::vector<std::size_t>& group) const {
    json layers = json::array();
    for (const SeriesMark mark : {SeriesMark::kBand, SeriesMark::kLine, SeriesMark::kPoints}) {
      for (const std::size_t i : group) {
        if (panel_.series[i].mark == mark) {
          layers.push_back(renderSeries(i));
        }
      }
    }
    return {{"data", {{"values", renderRows(group)}}},
            {"encoding", {{"x", xEncoding("x")}, {"color", colorEncoding()}}},
            {"layer", layers}};
  }

  json renderSeries(std::size_t i) const {
    const Series& series = panel_.series[i];
    json encoding = {{"y", yEncoding(yField(i))}};
    json mark = {{"clip", true}};
    if (series.mark == SeriesMark::kBand) {
      mark.update({{"type", "area"}, {"opacity", 0.2}});
      encoding["y2"] = {{"field", lowField(i)}};
    } else if (series.mark == SeriesMark::kPoints) {
      mark.update({{"type", "point"}, {"filled", true}, {"size", 16}});
    } else {
      mark.update({{"type", "line"}, {"strokeWidth", 1.6}});
      encoding["strokeDash"] = dashEncoding();
    }
    // The expression is a constant: the name as a string literal.
    const json name = {{"calculate", dumpJson(series.name)}, {"as", "series"}};
    return {{"transform", {name}}, {"mark", mark}, {"encoding", encoding}};
  }

  json renderBars() const {
    json rows = json::array();
    json order = json::array();
    for (const Series& series : panel_.series) {
      const std::size_t count = series.mark == SeriesMark::kBars
                                    ? std::min(series.categories.size(), series.y.size())
                                    : 0;
      for (std::size_t i = 0; i < count; ++i) {
        rows.push_back({{"category", series.categories[i]},
                        {"series", series.name},
                        {"y", toOrdinate(series.y[i])}});
      }
    }
    for (const LegendEntry& entry : makeLegend(panel_)) {
      order.push_back(entry.name);
    }
    const json encoding = {{"x",
                            {{"field", "category"},
                             {"type", "nominal"},
                             {"sort", nullptr},
                             {"title", makeAxisTitle(panel_.x)},
                             {"axis",
                              {{"labelAngle", -kTurn},
                               {"labelLimit", 220},
                               {"labelOverlap", false},
                               {"titleY", findCategoryHeight(panel_) + 14}}}}},
                           {"xOffset", {{"field", "series"}, {"type", "nominal"}, {"sort", order}}},
                           {"y", yEncoding("y")},
                           {"color", colorEncoding()}};
    return {{"data", {{"values", rows}}},
            {"mark", {{"type", "bar"}, {"clip", true}}},
            {"encoding", encoding}};
  }

  void renderGuides(json& layers) const {
    double line = 3;
    for (const Guide& guide : panel_.guides) {
      const bool is_vertical = guide.direction == Guide::Direction::kVertical;
      json encoding =
          is_vertical ? json{{"x", xEncoding("value")}} : json{{"y", yEncoding("value")}};
      const json mark = {{"type", "rule"}, {"color", kGuide}, {"strokeDash", {4, 3}}};
      json parts = json::array({{{"mark", mark}, {"encoding", encoding}}});
      if (width_ >= kNarrow && !guide.label.empty()) {
        encoding[is_vertical ? "y" : "x"] = {{"value", is_vertical ? line : width_ - 4}};
        encoding["text"] = {{"field", "label"}};
        parts.push_back({{"mark", renderLabelMark(guide)}, {"encoding", encoding}});
        line += is_vertical ? 11 : 0;
      }
      const json row = {{"value", toOrdinate(guide.value)}, {"label", guide.label}};
      layers.push_back({{"data", {{"values", {row}}}}, {"layer", parts}});
    }
  }

  json renderLabelMark(const Guide& guide) const {
    json mark = {{"type", "text"}, {"fontSize", 9}, {"color", kGuide}};
    if (guide.direction == Guide::Direction::kHorizontal) {
      mark.update({{"align", "right"}, {"baseline", "bottom"}, {"dy", -2}});
      return mark;
    }
    const Range data = findDataX(panel_);
    const double low = panel_.x.low.value_or(data.low);
    const double high = panel_.x.high.value_or(data.high);
    const bool is_right = guide.value > low + 0.65 * (high - low);
    mark.update(
        {{"align", is_right ? "right" : "left"}, {"baseline", "top"}, {"dx", is_right ? -4 : 4}});
    return mark;
  }

  const Panel& panel_;
  StyleScales scales_;
  bool has_legend_;
  double width_;
  double height_;
};

/// Room for the axis of a row and for the titles of the next. It is stated, because programs
/// without fonts would guess it from the length of texts.
double findRowSpacing(const Figure& figure, const std::vector<LegendEntry>& shared, double width) {
  double lines = 0;
  double categories = 0;
  for (const Panel& panel : figure.panels) {
    const double own =
        kTitleLine * static_cast<double>(wrapText(panel.title, kTitleSize, width + 30).size() +
                                         wrapText(panel.note, kNoteSize, width + 40).size());
    lines = std::max(lines, own + (shared.empty() && panel.series.size() > 1 ? 40 : 0));
    categories = std::max(categories, findCategoryHeight(panel));
  }
  return kBelow + lines + categories;
}

json renderConfig() {
  return {{"font", "Helvetica, Arial, sans-serif"},
          {"background", "white"},
          {"view", {{"stroke", "#8c8c8c"}}},
          {"axis",
           {{"labelFontSize", 10},
            {"titleFontSize", 11},
            {"titleFontWeight", "normal"},
            {"titleColor", kQuiet},
            {"gridColor", "#e4e4e4"},
            {"domainColor", "#8c8c8c"},
            {"tickColor", "#8c8c8c"},
            {"labelOverlap", true}}},
          {"legend",
           {{"orient", "top"},
            {"symbolType", "stroke"},
            {"symbolOpacity", 1},
            {"symbolSize", 400},
            {"symbolStrokeWidth", 2},
            {"labelFontSize", 11},
            {"labelLimit", 320},
            {"columns", 5}}}};
}

const char* markName(SeriesMark mark) {
  switch (mark) {
    case SeriesMark::kLine:
      return "line";
    case SeriesMark::kBand:
      return "band";
    case SeriesMark::kPoints:
      return "points";
    case SeriesMark::kBars:
      return "bars";
  }
  return "line";
}

json renderNumbers(const std::vector<double>& values) {
  json numbers = json::array();
  for (const double value : values) {
    numbers.push_back(std::isfinite(value) ? json(value) : json(nullptr));
  }
  return numbers;
}

json renderAxis(const Axis& axis) {
  return {{"label", axis.label}, {"unit", axis.unit}};
}

json renderSeriesData(const Series& series) {
  json data = {
      {"name", series.name}, {"mark", markName(series.mark)}, {"y", renderNumbers(series.y)}};
  if (series.mark == SeriesMark::kBars) {
    data["categories"] = series.categories;
  } else {
    data["x"] = renderNumbers(series.x);
  }
  if (series.mark == SeriesMark::kBand) {
    data["low"] = renderNumbers(series.low);
  }
  return data;
}

json renderPanelData(const Panel& panel) {
  json data = {{"name", panel.name},
               {"title", panel.title},
               {"x", renderAxis(panel.x)},
               {"y", renderAxis(panel.y)},
               {"series", json::array()},
               {"guides", json::array()},
               {"note", panel.note}};
  for (const Series& series : panel.series) {
    data["series"].push_back(renderSeriesData(series));
  }
  for (const Guide& guide : panel.guides) {
    const bool is_vertical = guide.direction == Guide::Direction::kVertical;
    data["guides"].push_back({{"direction", is_vertical ? "vertical" : "horizontal"},
                              {"value", guide.value},
                              {"label", guide.label}});
  }
  return data;
}

}  // namespace

std::string renderVegaLite(const Figure& figure) {
  const std::vector<LegendEntry> shared = makeSharedLegend(figure);
  const int columns =
      std::clamp(figure.columns, 1, std::max(1, static_cast<int>(figure.panels.size())));
  const double width = kWidth / columns - kAround;
  json panels = json::array();
  for (const Panel& panel : figure.panels) {
    panels.push_back(PanelView(panel, shared.empty() ? makeLegend(panel) : shared, width).render());
  }
  const char* legends = shared.empty() ? "independent" : "shared";
  return dumpJson(
      {{"$schema", kSchema},
       {"title",
        {{"text", figure.title},
         {"subtitle", wrapText(figure.caption, 11, kCaptionWidth)},
         {"anchor", "start"},
         {"fontSize", 16},
         {"subtitleFontSize", 11},
         {"subtitleColor", kQuiet},
         {"offset", 14}}},
       {"description", figure.caption},
       {"columns", columns},
       {"bounds", "flush"},
       {"spacing", {{"column", kAround}, {"row", findRowSpacing(figure, shared, width)}}},
       {"concat", panels},
       {"resolve",
        {{"scale", {{"color", legends}, {"strokeDash", legends}}},
         {"legend", {{"color", legends}, {"strokeDash", legends}}}}},
       {"config", renderConfig()}});
}

std::string renderFigureData(const Figure& figure) {
  json panels = json::array();
  for (const Panel& panel : figure.panels) {
    panels.push_back(renderPanelData(panel));
  }
  return dumpJson({{"name", figure.name},
                   {"title", figure.title},
                   {"caption", figure.caption},
                   {"panels", panels}});
}

}  // namespace gaitmill
