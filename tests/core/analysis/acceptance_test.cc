#include "core/analysis/acceptance.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

namespace gaitmill {
namespace {

AcceptanceInput makeInput() {
  AcceptanceInput input;
  input.rra = {1.5, 0.9, 0.6, 1.05, 0.4, "hip_flexion_r", "pelvis_ty"};
  input.cmc = {0.8, 0.1, 1.2, 2.1, 0.04, "knee_angle_r", "pelvis_tx"};
  for (const ComparedMoment& moment : paperMoments()) {
    input.moments.push_back({moment.coordinate, 102, 0.5, 50, 1.0, 2.5, 5.0, 0.98, 0.2, 40});
  }
  input.residuals = {
      {"FX", 8, 2}, {"FY", 9, 2}, {"FZ", 5, 1}, {"MX", 20, 5}, {"MY", 9, 2}, {"MZ", 21, 6}};
  input.reserves = {{"knee_r", 0.5, 0.1}, {"hip_rotation_r", 1.2, 0.3}};
  return input;
}

const AcceptanceRow& findRow(const std::vector<AcceptanceRow>& rows,
                             const std::string& quantity,
                             const std::string& unit) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const AcceptanceRow& r) {
    return r.quantity == quantity && r.unit == unit;
  });
  EXPECT_NE(row, rows.end()) << quantity;
  return *row;
}

TEST(AcceptanceTable, PutsPaperAndOpenSimBesideOurs) {
  const auto rows = makeAcceptanceTable(PaperTrial::kWalk, makeInput());
  const auto& rmse = findRow(rows, "knee moment, RMS difference", "N m");
  EXPECT_EQ(rmse.ours, 0.5);
  EXPECT_EQ(rmse.paper, 1.0);
  EXPECT_EQ(rmse.opensim, 0.52);
  EXPECT_EQ(findRow(rows, "largest reserve (hip_rotation_r)", "N m").ours, 1.2);
  EXPECT_EQ(findRow(rows, "residual MZ, peak", "N m").opensim, 25);
}

TEST(AcceptanceTable, BoundsAreStrictAndDifferByTrial) {
  // 1.2 deg of CMC tracking: too much for walking (1), fine for running (4).
  const auto walk = makeAcceptanceTable(PaperTrial::kWalk, makeInput());
  const auto run = makeAcceptanceTable(PaperTrial::kRun, makeInput());
  EXPECT_FALSE(findRow(walk, "CMC, largest RMS rotation", "deg").isMet());
  EXPECT_TRUE(findRow(run, "CMC, largest RMS rotation", "deg").isMet());
}

TEST(AcceptanceTable, AnUnfilledFigureIsNeverMet) {
  AcceptanceInput input = makeInput();
  input.rra.max_deg = std::numeric_limits<double>::quiet_NaN();
  const auto rows = makeAcceptanceTable(PaperTrial::kWalk, input);
  EXPECT_FALSE(findRow(rows, "RRA, largest rotation", "deg").isMet());
}

TEST(AcceptanceTable, TextHasOneLinePerRowAndTheVerdict) {
  const auto rows = makeAcceptanceTable(PaperTrial::kWalk, makeInput());
  const std::string text = renderAcceptanceTable(rows);
  EXPECT_EQ(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')), rows.size() + 1);
  EXPECT_NE(text.find("CMC, largest RMS rotation                     deg            1.20   < "
                      "1.00     0.26  MISSED"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("MISSED"), std::string::npos);
}

}  // namespace
}  // namespace gaitmill
