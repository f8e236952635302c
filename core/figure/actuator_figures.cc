// Figures of what the model needs beyond muscles and ground reactions.
#include <algorithm>
#include <cstddef>

#include "core/base/numbers.h"
#include "core/figure/coordinate_names.h"
#include "core/figure/job_builders.h"
#include "core/figure/quality_limit.h"

namespace gaitmill {

namespace {

struct ResidualPanel {
  const char* name;
  const char* title;
  const char* unit;
  const char* check;
  std::vector<std::pair<const char*, const char*>> columns;  ///< with their names in the legend
};

const std::vector<ResidualPanel>& residualPanels() {
  static const std::vector<ResidualPanel> panels = {
      {"forces",
       "Forces",
       "N",
       "residual_force_peak",
       {{"FX", "FX, forward"}, {"FY", "FY, upward"}, {"FZ", "FZ, to the right"}}},
      {"moments",
       "Moments",
       "N·m",
       "residual_moment_peak",
       {{"MX", "MX, about forward"}, {"MY", "MY, about upward"}, {"MZ", "MZ, about right"}}}};
  return panels;
}

double findPeak(const TimeSeries& table, const std::string& label) {
  const std::optional<int> column = table.findColumn(label);
  return column ? table.values.col(*column).cwiseAbs().maxCoeff() : 0.0;
}

/// "Peaks over the trial: FX 2.93, FY 5.06, FZ 2.17 N"
std::string describePeaks(const TimeSeries& residuals, const ResidualPanel& plan) {
  std::string peaks;
  for (const auto& [column, name] : plan.columns) {
    peaks += std::string(peaks.empty() ? "" : ", ") + column + " " +
             formatShort(findPeak(residuals, column));
  }
  return "Peaks over the trial: " + peaks + " " + plan.unit;
}

/// Name of the coordinate that a reserve acts on: "hip_flexion" of "hip_flexion_reserve".
std::string findCoordinate(const std::string& base) {
  const std::string suffix = "_reserve";
  const std::size_t place = base.rfind(suffix);
  return place == std::string::npos ? base : base.substr(0, place);
}

/// The largest moment of inverse dynamics at the joints that have a reserve [N.m]; 0 = not known.
double findLargestMoment(const JobData& data) {
  double largest = 0;
  if (data.has("moments")) {
    for (const std::string& label : data.table("reserves").labels) {
      largest =
          std::max(largest, findPeak(data.table("moments"), findCoordinate(label) + "_moment"));
    }
  }
  return largest;
}

Panel makePeakPanel(const JobData& data, const std::vector<SidedColumns>& pairs) {
  const TimeSeries& reserves = data.table("reserves");
  Panel panel;
  panel.name = "peaks";
  panel.title = "Largest reserve at each joint";
  panel.x.label = "Joint";
  panel.y = {"Moment", "N·m", 0.0};
  Series right;
  right.name = "right";
  right.role = SeriesRole::kRight;
  right.mark = SeriesMark::kBars;
  Series left = right;
  left.name = "left";
  left.role = SeriesRole::kLeft;
  for (const SidedColumns& pair : pairs) {
    const std::string name = findCoordinateName(findCoordinate(pair.base)).display;
    if (!pair.right.empty() || !pair.center.empty()) {
      right.categories.push_back(name);
      right.y.push_back(findPeak(reserves, pair.right.empty() ? pair.center : pair.right));
    }
    if (!pair.left.empty()) {
      left.categories.push_back(name);
      left.y.push_back(findPeak(reserves, pair.left));
    }
  }
  panel.series = {right, left};
  const double moment = findLargestMoment(data);
  const std::optional<QualityLimit> limit = findLimit(data, "reserve_peak");
  if (limit && moment > 0) {
    addLimit(data,
             "reserve_peak",
             formatShort(limit->value) + " % of the largest joint moment",
             moment / 100,
             panel);
  }
  return panel;
}

}  // namespace

void buildResiduals(const JobData& data, Figure& figure) {
  const TimeSeries& residuals = data.table("residuals");
  for (const ResidualPanel& plan : residualPanels()) {
    Panel panel = makePanel(data, plan.name, plan.title, {plan.title, plan.unit});
    panel.y.label.pop_back();
    for (const auto& [column, name] : plan.columns) {
      data.addCurve(residuals, column, Side::kNone, {name, SeriesRole::kPlain, 1}, panel);
    }
    if (panel.series.empty()) {
      continue;
    }
    addLimit(data, plan.check, "the peak", 1, panel);
    if (!panel.guides.empty()) {
      panel.guides.push_back({Guide::Direction::kHorizontal, -panel.guides.front().value, ""});
    }
    data.addToeOffs(true, false, panel);
    panel.note = describePeaks(residuals, plan);
    figure.panels.push_back(std::move(panel));
  }
  figure.caption += " " + data.describeAxis(false);
}

void buildReserves(const JobData& data, Figure& figure) {
  const TimeSeries& reserves = data.table("reserves");
  const std::vector<SidedColumns> pairs = pairSides(reserves.labels);
  figure.panels.push_back(makePeakPanel(data, pairs));
  for (const SidedColumns& pair : pairs) {
    Panel panel = makePanel(
        data, pair.base, findCoordinateName(findCoordinate(pair.base)).display, {"Moment", "N·m"});
    data.addSides(reserves, pair, 1, panel);
    data.addToeOffs(panel);
    figure.panels.push_back(std::move(panel));
  }
  figure.caption += " " + data.describeAxis();
}

}  // namespace gaitmill
