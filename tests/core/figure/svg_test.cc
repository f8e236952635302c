#include "core/figure/svg.h"

#include <limits>
#include <regex>

#include <gtest/gtest.h>

#include "core/figure/palette.h"
#include "core/figure/svg_canvas.h"

namespace gaitmill {
namespace {

Figure makeFigureOf(const Series& series) {
  Panel panel;
  panel.name = "one";
  panel.title = "One & only <panel>";
  panel.x = {"Gait cycle", "%", 0.0, 100.0};
  panel.y = {"Moment", "N·m"};
  panel.series = {series};
  return {"test", "Title \"quoted\"", "Caption.", 1, {panel}};
}

Series makeLine(std::vector<double> y) {
  Series series;
  series.name = "right";
  series.role = SeriesRole::kRight;
  for (std::size_t i = 0; i < y.size(); ++i) {
    series.x.push_back(100.0 * static_cast<double>(i) / static_cast<double>(y.size() - 1));
  }
  series.y = std::move(y);
  return series;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t place = text.find(part); place != std::string::npos;
       place = text.find(part, place + 1)) {
    ++found;
  }
  return found;
}

// The curve of the series: the only path without fill.
std::string findPath(const std::string& svg) {
  static const std::regex path("<path d=\"([^\"]*)\" fill=\"none\"");
  std::smatch match;
  return std::regex_search(svg, match, path) ? match[1].str() : "";
}

TEST(Svg, EscapesNames) {
  const std::string svg = renderSvg(makeFigureOf(makeLine({0, 1})));
  EXPECT_NE(svg.find("One &amp; only &lt;panel&gt;"), std::string::npos);
  EXPECT_NE(svg.find("aria-label=\"Title &quot;quoted&quot;\""), std::string::npos);
  EXPECT_EQ(svg.find("<panel>"), std::string::npos);
}

TEST(Svg, NamesAxesWithUnits) {
  const std::string svg = renderSvg(makeFigureOf(makeLine({0, 1})));
  EXPECT_NE(svg.find("Gait cycle [%]"), std::string::npos);
  EXPECT_NE(svg.find("Moment [N·m]"), std::string::npos);
}

// Of one column of 960 px, the plot is 900 px wide and 230 px high; the window adds 2 px above.
TEST(Svg, PutsPointsWhereTheyBelong) {
  EXPECT_EQ(findPath(renderSvg(makeFigureOf(makeLine({0, 10, 5})))), "M0 232L450 2L900 117");
}

TEST(Svg, ANumberThatIsNoneInterruptsTheCurve) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string path = findPath(renderSvg(makeFigureOf(makeLine({0, 10, nan, 5, 0}))));
  EXPECT_EQ(count(path, "M"), 2U);
  EXPECT_EQ(path.find("nan"), std::string::npos);
}

TEST(Svg, ANumberThatIsNoneSplitsABand) {
  Series band = makeLine({2, 3, std::numeric_limits<double>::quiet_NaN(), 3, 2});
  band.mark = SeriesMark::kBand;
  band.low = {1, 2, 2, 2, 1};
  EXPECT_EQ(count(renderSvg(makeFigureOf(band)), "fill-opacity=\"0.2\""), 2U);
}

TEST(Svg, BandsBarsAndGuidesAreDrawn) {
  Series band = makeLine({2, 3});
  band.mark = SeriesMark::kBand;
  band.low = {1, 2};
  Figure figure = makeFigureOf(band);
  figure.panels[0].guides = {{Guide::Direction::kVertical, 60, "toe-off"}};
  const std::string svg = renderSvg(figure);
  EXPECT_EQ(count(svg, "fill-opacity=\"0.2\""), 1U);
  EXPECT_EQ(count(svg, ">toe-off<"), 1U);

  Series bars;
  bars.mark = SeriesMark::kBars;
  bars.categories = {"soleus", "psoas"};
  bars.y = {3, -1};
  const std::string drawn = renderSvg(makeFigureOf(bars));
  EXPECT_EQ(count(drawn, "fill=\"#0072B2\""), 2U);
  EXPECT_EQ(count(drawn, ">psoas<"), 1U);
}

TEST(Svg, OneLegendServesAllPanelsThatAgree) {
  Figure figure = makeFigureOf(makeLine({0, 1}));
  Series left = makeLine({1, 0});
  left.name = "left";
  left.role = SeriesRole::kLeft;
  figure.panels[0].series.push_back(left);
  figure.panels.push_back(figure.panels[0]);
  EXPECT_EQ(count(renderSvg(figure), ">left<"), 1U);
}

// The first curve of either panel is blue: one legend would call two muscles the same.
TEST(Palette, TwoNamesOfOneLookNeedALegendPerPanel) {
  Figure figure = makeFigureOf(makeLine({0, 1}));
  figure.panels[0].series[0].name = "soleus";
  figure.panels.push_back(figure.panels[0]);
  EXPECT_EQ(makeSharedLegend(figure).size(), 1U);
  figure.panels[1].series[0].name = "psoas";
  EXPECT_TRUE(makeSharedLegend(figure).empty());
}

TEST(Svg, ControlCharactersBecomeSpaces) {
  EXPECT_EQ(escapeXml("a\x01"
                      "b\nc"),
            "a b c");
  EXPECT_EQ(escapeXml("5 µm's"), "5 µm&#39;s");
}

TEST(Palette, SeriesOfOneNameShareAStyleAndSevenDiffer) {
  Panel panel;
  for (int i = 0; i < 7; ++i) {
    Series series;
    series.name = std::to_string(i);
    panel.series.push_back(series);
    panel.series.push_back(series);
  }
  const std::vector<SeriesStyle> styles = findStyles(panel);
  for (std::size_t i = 0; i < styles.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_EQ(styles[i].color == styles[j].color, i / 2 == j / 2) << i << " " << j;
    }
  }
  EXPECT_EQ(makeLegend(panel).size(), 7U);
}

}  // namespace
}  // namespace gaitmill
