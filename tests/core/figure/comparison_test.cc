#include "core/figure/comparison.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/memory_results.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

// Activations over the cycle that rise to `peak` at 100 %, and what the quality says of them.
MemoryResults makeJob(double peak, const std::string& quality) {
  TimeSeries table;
  table.labels = {"soleus_r", "only_" + quality};
  table.units = {"", ""};
  for (int i = 0; i <= 100; ++i) {
    table.time.push_back(i);
  }
  table.values = RowMatrix::Zero(101, 2);
  for (int i = 0; i <= 100; ++i) {
    table.values(i, 0) = peak * i / 100;
  }
  return MemoryResults({{"activations", table}},
                       {{"activations", table}},
                       "{\"gait_cycle_s\": [0, 100], \"quality\": " + quality + "}");
}

// 0.1 x over 0..1 has the RMS 0.1 sqrt(mean x^2), mean x^2 = 1/3 + 1/600 on 101 points.
TEST(Comparison, StatesTheDifferenceOfCommonColumns) {
  const MemoryResults first = makeJob(0.5, R"({"rmse": 1, "checks": [{"value": 9}]})");
  const MemoryResults second = makeJob(0.4, R"({"rmse": 2, "deep": {"er": 3}})");
  const Comparison comparison = compareResults({{"a", &first}, {"b", &second}});
  ASSERT_EQ(comparison.tables.size(), 1U);
  ASSERT_EQ(comparison.tables[0].columns.size(), 1U);
  const ColumnComparison& column = comparison.tables[0].columns[0];
  EXPECT_EQ(column.column, "soleus_r");
  EXPECT_NEAR(column.first_peak, 0.5, tol(1e-12));
  ASSERT_EQ(column.differences.size(), 1U);
  EXPECT_NEAR(column.differences[0].rms, 0.1 * std::sqrt(1.0 / 3 + 1.0 / 600), tol(1e-12));
  EXPECT_NEAR(column.differences[0].largest, -0.1, tol(1e-12));
  EXPECT_EQ(column.differences[0].largest_percent, 100);
  EXPECT_NEAR(column.differences[0].peak, 0.4, tol(1e-12));
}

TEST(Comparison, PutsQualityFiguresSideBySide) {
  const MemoryResults first = makeJob(0.5, R"({"rmse": 1, "checks": [{"value": 9}]})");
  const MemoryResults second = makeJob(0.4, R"({"rmse": 2, "deep": {"er": 3}})");
  const Comparison comparison = compareResults({{"a", &first}, {"b", &second}});
  ASSERT_EQ(comparison.quality.size(), 2U);
  EXPECT_EQ(comparison.quality[0].quantity, "deep.er");
  EXPECT_TRUE(std::isnan(comparison.quality[0].values[0]));
  EXPECT_EQ(comparison.quality[1].values, (std::vector<double>{1, 2}));
}

TEST(Comparison, OfOneJobIsRefused) {
  const MemoryResults job = makeJob(0.5, "{}");
  EXPECT_THROW(compareResults({{"a", &job}}), Error);
}

TEST(Overlay, HasTheCurvesOfAllJobsUnderTheirLabels) {
  const MemoryResults first = makeJob(0.5, "{}");
  const MemoryResults second = makeJob(0.4, "{}");
  const std::vector<NamedResult> jobs = {{"walk", &first}, {"run", &second}};
  ASSERT_EQ(listCommonFigures(jobs).size(), 1U);
  const Figure figure = overlayFigures(jobs, "activations");
  const Panel& panel = figure.panels.front();
  ASSERT_EQ(panel.series.size(), 2U);
  EXPECT_EQ(panel.series[0].name, "walk");
  EXPECT_EQ(panel.series[1].name, "run");
  EXPECT_EQ(panel.series[1].group, 1);
}

TEST(Overlay, NamesTheJobThatLacksTheFigure) {
  const MemoryResults first = makeJob(0.5, "{}");
  try {
    overlayFigures({{"walk", &first}}, "moments");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kFigureNotFound);
    EXPECT_EQ(error.context(), (std::vector<std::string>{"job walk"}));
  }
}

}  // namespace
}  // namespace gaitmill
