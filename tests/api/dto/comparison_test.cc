#include "api/dto/comparison.h"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gaitmill::api {
namespace {

TEST(RenderComparison, HasDifferencesAndQualitySideBySide) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Comparison comparison;
  comparison.labels = {"walk", "run"};
  comparison.tables = {{"moments", {{"knee", "N.m", 50, {{1.23456, -3, 62, 47}}}}}};
  comparison.quality = {{"rmse", {1, nan}}};
  EXPECT_EQ(nlohmann::json::parse(renderComparison(comparison)), nlohmann::json::parse(R"({
    "jobs": ["walk", "run"], "axis": "gait_cycle",
    "tables": [{"name": "moments", "columns": [{"name": "knee", "unit": "N.m", "first_peak": 50.0,
      "differences": [{"rms": 1.235, "largest": -3.0, "largest_percent": 62.0, "peak": 47.0}]}]}],
    "quality": [{"quantity": "rmse", "values": [1.0, null]}]})"));
}

}  // namespace
}  // namespace gaitmill::api
