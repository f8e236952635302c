// Figures with one panel per muscle, both legs in it.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/figure/job_builders.h"
#include "core/figure/muscle_names.h"

namespace gaitmill {

namespace {

struct MusclePair {
  MuscleName name;
  SidedColumns columns;
};

std::size_t findPlace(const MuscleName& name) {
  const std::vector<MuscleName>& known = knownMuscles();
  const auto found = std::find_if(
      known.begin(), known.end(), [&](const MuscleName& other) { return other.base == name.base; });
  return static_cast<std::size_t>(found - known.begin());
}

/// Muscles in the order of their groups, unknown ones at the end in the order of the table.
std::vector<MusclePair> sortMuscles(const std::vector<std::string>& labels) {
  std::vector<MusclePair> muscles;
  for (const SidedColumns& pair : pairSides(labels)) {
    muscles.push_back({findMuscleName(pair.base), pair});
  }
  std::stable_sort(muscles.begin(), muscles.end(), [](const MusclePair& a, const MusclePair& b) {
    return findPlace(a.name) < findPlace(b.name);
  });
  return muscles;
}

void buildPerMuscle(const JobData& data,
                    const TimeSeries& table,
                    const std::vector<std::string>& labels,
                    const Axis& y,
                    Figure& figure) {
  for (const MusclePair& muscle : sortMuscles(labels)) {
    Panel panel = makePanel(data, muscle.name.base, muscle.name.display, y);
    panel.note = groupName(muscle.name.group);
    data.addSides(table, muscle.columns, 1, panel);
    data.addToeOffs(panel);
    figure.panels.push_back(std::move(panel));
  }
  figure.caption += " " + data.describeAxis();
}

/// Tables of forces hold actuators behind the muscles; those of activations only muscles.
std::vector<std::string> findMuscleColumns(const JobData& data, const TimeSeries& table) {
  std::vector<std::string> labels;
  for (const std::string& label : table.labels) {
    if (data.has("activations", label)) {
      labels.push_back(label);
    }
  }
  return labels;
}

/// Mean over the rows, which are gait cycles; NaN if the muscle has no such column.
double calcMeanWork(const TimeSeries& work, const std::string& column) {
  const std::optional<int> index = work.findColumn(column);
  return index && work.rowCount() > 0 ? work.values.col(*index).mean() : std::nan("");
}

/// Work that is drawn together: one panel.
struct WorkPanel {
  const char* name;
  const char* title;
  std::vector<const char*> parts;
};

Series makeWorkBars(const TimeSeries& work,
                    const std::vector<MusclePair>& muscles,
                    const std::string& part,
                    Side side) {
  Series bars;
  bars.name = sideWord(side);
  bars.role = side == Side::kRight ? SeriesRole::kRight : SeriesRole::kLeft;
  bars.mark = SeriesMark::kBars;
  for (const MusclePair& muscle : muscles) {
    const std::string column = muscle.name.base + "_" + sideLetter(side) + "_" + part;
    if (work.findColumn(column)) {
      bars.categories.push_back(muscle.name.display);
      bars.y.push_back(calcMeanWork(work, column));
    }
  }
  return bars;
}

}  // namespace

void buildActivations(const JobData& data, Figure& figure) {
  const TimeSeries& table = data.table("activations");
  buildPerMuscle(data, table, table.labels, {"Activation", "", 0.0, 1.0}, figure);
}

void buildMuscleForces(const JobData& data, Figure& figure) {
  const TimeSeries& table = data.table("forces");
  buildPerMuscle(
      data, table, findMuscleColumns(data, table), {"Force", "N", 0.0, std::nullopt}, figure);
}

void buildFiberLengths(const JobData& data, Figure& figure) {
  const TimeSeries& table = data.table("norm_fiber_lengths");
  buildPerMuscle(data, table, table.labels, {"Length", "l₀"}, figure);
}

void buildFiberVelocities(const JobData& data, Figure& figure) {
  const TimeSeries& table = data.table("norm_fiber_velocities");
  buildPerMuscle(data, table, table.labels, {"Velocity", "v max"}, figure);
}

void buildMusclePowers(const JobData& data, Figure& figure) {
  const TimeSeries& table = data.table("muscle_powers");
  buildPerMuscle(data, table, table.labels, {"Power", "W"}, figure);
}

void buildMuscleWork(const JobData& data, Figure& figure) {
  static const std::vector<WorkPanel> panels = {
      {"fiber",
       "Fibers: positive and negative work",
       {"fiber_positive_work", "fiber_negative_work"}},
      {"tendon",
       "Tendons: positive and negative work",
       {"tendon_positive_work", "tendon_negative_work"}},
      {"net", "Fiber and tendon together: net work", {"net_work"}}};
  const TimeSeries& work = data.table("muscle_work");
  std::vector<std::string> labels;
  const std::string suffix = "_net_work";
  for (const std::string& label : work.labels) {
    if (label.size() > suffix.size() && label.rfind(suffix) == label.size() - suffix.size()) {
      labels.push_back(label.substr(0, label.size() - suffix.size()));
    }
  }
  const std::vector<MusclePair> muscles = sortMuscles(labels);
  for (const WorkPanel& plan : panels) {
    Panel panel;
    panel.name = plan.name;
    panel.title = plan.title;
    panel.x.label = "Muscle";
    panel.y = {"Work", "J"};
    for (const char* part : plan.parts) {
      for (const Side side : {Side::kRight, Side::kLeft}) {
        panel.series.push_back(makeWorkBars(work, muscles, part, side));
      }
    }
    figure.panels.push_back(std::move(panel));
  }
  if (work.rowCount() > 1) {
    figure.caption += " Mean of " + std::to_string(work.rowCount()) + " cycles.";
  }
}

}  // namespace gaitmill
