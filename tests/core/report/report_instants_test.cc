#include <vector>

#include <gtest/gtest.h>

#include "core/report/report.h"
#include "tests/core/report/memory_results.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

MemoryResults makeResults(const std::string& summary, double start, double end) {
  MemoryResults results(summary);
  results.tables["kinematics"] = makeTimeSeries("kinematics", {"knee_angle_r"}, {start, end});
  return results;
}

void expectInstants(const std::vector<ReportInstant>& instants,
                    const std::vector<ReportInstant>& expected) {
  ASSERT_EQ(instants.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(instants[i].name, expected[i].name);
    EXPECT_NEAR(instants[i].time, expected[i].time, tol(1e-12)) << expected[i].name;
  }
}

TEST(ReportInstants, AreTheEventsOfTheRightFootsCycle) {
  const MemoryResults results = makeResults(
      R"({"gait_cycle_s": [1, 2], "events": [
        {"kind": "toe_off", "foot": "left", "time_s": 1.1},
        {"kind": "toe_off", "foot": "right", "time_s": 0.6},
        {"kind": "foot_strike", "foot": "right", "time_s": 1},
        {"kind": "toe_off", "foot": "right", "time_s": 1.6}]})",
      0.5,
      2.5);
  expectInstants(findReportInstants(results),
                 {{"Right heel strike", 1},
                  {"Right mid-stance", 1.3},
                  {"Right toe-off", 1.6},
                  {"Right mid-swing", 1.8}});
}

// As in the published walking trial, which was analysed from 25 to 125 % of the cycle.
TEST(ReportInstants, MoveByACycleWhereTheMotionWasNotAnalysed) {
  const MemoryResults results = makeResults(
      R"({"cycles": {"right": [[0.25, 1.4]], "left": []},
          "events": [{"kind": "toe_off", "foot": "right", "time_s": 1.05}]})",
      0.45,
      1.8);
  expectInstants(findReportInstants(results),
                 {{"Right heel strike", 1.4},
                  {"Right mid-stance", 0.65},
                  {"Right toe-off", 1.05},
                  {"Right mid-swing", 1.225}});
}

TEST(ReportInstants, WithoutEventsAreQuarters) {
  expectInstants(findReportInstants(makeResults(R"({"gait_cycle_s": [1, 2]})", 0, 3)),
                 {{"0 % of the gait cycle", 1},
                  {"25 % of the gait cycle", 1.25},
                  {"50 % of the gait cycle", 1.5},
                  {"75 % of the gait cycle", 1.75}});
  expectInstants(findReportInstants(makeResults("{}", 1, 3)),
                 {{"0 % of the motion", 1},
                  {"25 % of the motion", 1.5},
                  {"50 % of the motion", 2},
                  {"75 % of the motion", 2.5}});
}

TEST(ReportInstants, WithoutMotionThereAreNone) {
  EXPECT_TRUE(findReportInstants(MemoryResults("{}")).empty());
}

}  // namespace
}  // namespace gaitmill
