#include "core/figure/vega_lite.h"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gaitmill {
namespace {

using nlohmann::json;

Figure makeSmallFigure() {
  Series right;
  right.name = "right";
  right.role = SeriesRole::kRight;
  right.x = {0, 50, 100};
  right.y = {1.23456789, std::numeric_limits<double>::quiet_NaN(), -2};
  Series left = right;
  left.name = "left";
  left.role = SeriesRole::kLeft;
  Panel panel;
  panel.name = "knee_angle";
  panel.title = "Knee flexion";
  panel.x = {"Gait cycle", "%", 0.0, 100.0};
  panel.y = {"Angle", "deg"};
  panel.series = {right, left};
  panel.guides = {{Guide::Direction::kVertical, 62.5, "toe-off"}};
  panel.note = "a note";
  return {"joint_angles", "Joint angles", "Angles of joints.", 2, {panel, panel}};
}

TEST(VegaLite, HoldsEveryPanelWithTitlesAndUnits) {
  const json spec = json::parse(renderVegaLite(makeSmallFigure()));
  EXPECT_EQ(spec.at("$schema"), "https://vega.github.io/schema/vega-lite/v5.json");
  EXPECT_EQ(spec.at("title").at("text"), "Joint angles");
  ASSERT_EQ(spec.at("concat").size(), 2U);
  const json& panel = spec.at("concat").at(0);
  EXPECT_EQ(panel.at("title").at("text"), json::array({"Knee flexion"}));
  EXPECT_EQ(panel.at("title").at("subtitle"), json::array({"a note"}));
  const json& curves = panel.at("layer").at(0);
  EXPECT_EQ(curves.at("encoding").at("x").at("title"), "Gait cycle [%]");
  EXPECT_EQ(curves.at("layer").at(0).at("encoding").at("y").at("title"), "Angle [deg]");
}

TEST(VegaLite, SharesAbscissaeRoundsAndWritesNullForWhatIsNotANumber) {
  const json spec = json::parse(renderVegaLite(makeSmallFigure()));
  const json& rows = spec.at("concat").at(0).at("layer").at(0).at("data").at("values");
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows.at(0), (json{{"x", 0.0}, {"y0", 1.235}, {"y1", 1.235}}));
  EXPECT_TRUE(rows.at(1).at("y0").is_null());
}

TEST(VegaLite, ColoursFollowTheRole) {
  const json spec = json::parse(renderVegaLite(makeSmallFigure()));
  const json& curves = spec.at("concat").at(0).at("layer").at(0);
  const json& lines = curves.at("layer");
  const json& color = curves.at("encoding").at("color");
  EXPECT_EQ(lines.at(1).at("transform").at(0).at("calculate"), "\"left\"");
  EXPECT_EQ(color.at("scale").at("domain"), (json{"right", "left"}));
  EXPECT_EQ(color.at("scale").at("range"), (json{"#0072B2", "#D55E00"}));
}

TEST(VegaLite, DrawsGuidesWithTheirLabels) {
  const json spec = json::parse(renderVegaLite(makeSmallFigure()));
  const json& guide = spec.at("concat").at(0).at("layer").at(1);
  EXPECT_EQ(guide.at("data").at("values").at(0), (json{{"value", 62.5}, {"label", "toe-off"}}));
  EXPECT_EQ(guide.at("layer").at(0).at("mark").at("type"), "rule");
  EXPECT_EQ(guide.at("layer").at(1).at("mark").at("type"), "text");
}

TEST(FigureData, HasTheNumbersAsTheyAre) {
  const json data = json::parse(renderFigureData(makeSmallFigure()));
  const json& panel = data.at("panels").at(0);
  EXPECT_EQ(panel.at("y"), (json{{"label", "Angle"}, {"unit", "deg"}}));
  EXPECT_EQ(panel.at("series").at(0).at("y"), (json{1.23456789, nullptr, -2.0}));
  EXPECT_EQ(panel.at("guides").at(0).at("label"), "toe-off");
}

}  // namespace
}  // namespace gaitmill
