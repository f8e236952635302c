#include "service/draw_task.h"

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace gaitmill {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Figure makeFigureOfEverything() {
  Series band;
  band.name = "mean \xc2\xb1 SD";
  band.role = SeriesRole::kEmg;
  band.mark = SeriesMark::kBand;
  band.x = {0.1, 1.0 / 3.0};
  band.y = {kNaN, -1e-300};
  band.low = {std::numeric_limits<double>::infinity(), 5e-324};
  band.group = 2;
  Series bars;
  bars.mark = SeriesMark::kBars;
  bars.categories = {"soleus", "vasti"};
  bars.y = {1, 2};
  Panel panel;
  panel.name = "knee";
  panel.title = "Knee";
  panel.x = {"Gait cycle", "%", 0.0, 100.0};
  panel.y = {"Moment", "N·m", std::nullopt, 3.5};
  panel.series = {band, bars};
  panel.guides = {{Guide::Direction::kHorizontal, 0.05, "limit"}};
  panel.note = "RMS 0.35";
  return {"moments", "Moments", "What is shown.", 3, {panel, Panel{}}};
}

TEST(DrawTask, FiguresComeBackBitByBit) {
  const std::vector<Figure> sent = {makeFigureOfEverything(), Figure{}};
  const std::vector<Figure> back = decodeFigures(encodeFigures(sent));
  ASSERT_EQ(back.size(), 2U);
  const Figure& figure = back.front();
  EXPECT_EQ(figure.name, "moments");
  EXPECT_EQ(figure.caption, "What is shown.");
  EXPECT_EQ(figure.columns, 3);
  ASSERT_EQ(figure.panels.size(), 2U);
  const Panel& panel = figure.panels.front();
  EXPECT_EQ(panel.x.low, 0.0);
  EXPECT_EQ(panel.y.low, std::nullopt);
  EXPECT_EQ(panel.y.high, 3.5);
  EXPECT_EQ(panel.note, "RMS 0.35");
  ASSERT_EQ(panel.guides.size(), 1U);
  EXPECT_EQ(panel.guides[0].direction, Guide::Direction::kHorizontal);
  EXPECT_EQ(panel.guides[0].value, 0.05);
  ASSERT_EQ(panel.series.size(), 2U);
  const Series& band = panel.series.front();
  EXPECT_EQ(band.role, SeriesRole::kEmg);
  EXPECT_EQ(band.mark, SeriesMark::kBand);
  EXPECT_EQ(band.x, (std::vector<double>{0.1, 1.0 / 3.0}));
  EXPECT_TRUE(std::isnan(band.y[0]));
  EXPECT_EQ(band.y[1], -1e-300);
  EXPECT_TRUE(std::isnan(band.low[0])) << "infinite";
  EXPECT_EQ(band.low[1], 5e-324);
  EXPECT_EQ(band.group, 2);
  EXPECT_EQ(panel.series[1].categories, (std::vector<std::string>{"soleus", "vasti"}));
}

// A child that has gone mad may send anything.
TEST(DrawTask, DamagedFiguresAreRefusedWithOneError) {
  const std::string good = encodeFigures({makeFigureOfEverything()});
  std::mt19937 random(11);
  int refused = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string bytes = good;
    for (int i = 0; i < 3; ++i) {
      bytes[random() % bytes.size()] = static_cast<char>(random());
    }
    bytes.resize(round % 3 == 0 ? random() % bytes.size() : bytes.size());
    try {
      decodeFigures(bytes);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kJobCrashed);
      ++refused;
    }
  }
  EXPECT_GT(refused, 500);
}

TEST(DrawTask, DeepFiguresDoNotExhaustTheStack) {
  EXPECT_THROW(decodeFigures(std::string(1U << 20U, '[')), Error);
}

TEST(DrawTask, TaskComesBack) {
  DrawTask task;
  task.kind = DrawTask::Kind::kAnimation;
  task.start = 0.1;
  task.end = 1.0 / 3.0;
  task.poses = 7;
  task.rate = 12.5;
  task.slow_down = 4;
  task.options.width = 400;
  task.options.view = {0.5, -0.25};
  task.options.color = MuscleColor::kFiberLength;
  task.options.markers = false;
  task.figure = "curves";
  task.seed = std::numeric_limits<std::uint64_t>::max();
  const DrawTask back = decodeDrawTask(encodeDrawTask(task));
  EXPECT_EQ(back.kind, task.kind);
  EXPECT_EQ(back.end, task.end);
  EXPECT_EQ(back.poses, 7);
  EXPECT_EQ(back.rate, 12.5);
  EXPECT_EQ(back.slow_down, 4);
  EXPECT_EQ(back.options.width, 400);
  EXPECT_EQ(back.options.height, 720);
  EXPECT_EQ(back.options.view.elevation, -0.25);
  EXPECT_EQ(back.options.color, MuscleColor::kFiberLength);
  EXPECT_FALSE(back.options.markers);
  EXPECT_TRUE(back.options.legend);
  EXPECT_EQ(back.figure, "curves");
  EXPECT_EQ(back.seed, task.seed);
  EXPECT_EQ(encodeDrawTask(back), encodeDrawTask(task));
}

TEST(DrawTask, DataComesBackWithAndWithoutACycle) {
  DrawData data;
  data.model_name = "a.osim";
  data.picture.model_osim = "<xml/>";
  data.picture.kinematics = makeTimeSeries("kinematics", {"knee"}, {0.0, 0.5});
  data.picture.kinematics.values << 0.25, kNaN;
  DrawData back = decodeDrawData(encodeDrawData(data));
  EXPECT_EQ(back.model_name, "a.osim");
  EXPECT_EQ(back.picture.model_osim, "<xml/>");
  EXPECT_EQ(back.picture.kinematics.values(0, 0), 0.25);
  EXPECT_TRUE(std::isnan(back.picture.kinematics.values(1, 0)));
  EXPECT_EQ(back.picture.markers.columnCount(), 0);
  EXPECT_FALSE(back.picture.cycle);
  data.picture.cycle = GaitCycle{0.5, 1.75};
  back = decodeDrawData(encodeDrawData(data));
  ASSERT_TRUE(back.picture.cycle);
  EXPECT_EQ(back.picture.cycle->end, 1.75);
}

}  // namespace
}  // namespace gaitmill
