// Figures of what was measured and of how closely the model follows it.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/units.h"
#include "core/figure/coordinate_names.h"
#include "core/figure/job_builders.h"
#include "core/figure/quality_limit.h"

namespace gaitmill {

namespace {

constexpr double kCentimetersPerMeter = 100;

std::string unitOf(const TimeSeries& table, const std::string& label) {
  const std::optional<int> column = table.findColumn(label);
  return column && !table.units.empty() ? table.units[static_cast<std::size_t>(*column)] : "";
}

// Locked and dependent coordinates say nothing that is worth a panel.
bool moves(const TimeSeries& table, const std::string& label) {
  const std::optional<int> column = table.findColumn(label);
  return column &&
         table.values.col(*column).maxCoeff() - table.values.col(*column).minCoeff() > 1e-6;
}

bool isDependent(const SidedColumns& columns) {
  const std::string suffix = "_beta";
  return columns.base.size() > suffix.size() &&
         columns.base.compare(columns.base.size() - suffix.size(), suffix.size(), suffix) == 0;
}

struct CoordinateUnit {
  const char* name;
  double factor;
};

/// One panel per coordinate that moves, rotations in degrees.
void buildCoordinates(const JobData& data,
                      const TimeSeries& table,
                      const CoordinateUnit& rotation,
                      const CoordinateUnit& translation,
                      Figure& figure) {
  for (const SidedColumns& columns : pairSides(table.labels)) {
    const std::string& any = !columns.right.empty()  ? columns.right
                             : !columns.left.empty() ? columns.left
                                                     : columns.center;
    if (isDependent(columns) || !moves(table, any)) {
      continue;
    }
    const CoordinateUnit& unit = unitOf(table, any) == "m" ? translation : rotation;
    const CoordinateName name = findCoordinateName(columns.base);
    Panel panel = makePanel(data, columns.base, name.display, {"", unit.name});
    panel.y.label = unitOf(table, any) == "m" ? "Position" : "Angle";
    data.addSides(table, columns, unit.factor, panel);
    data.addToeOffs(panel);
    figure.panels.push_back(std::move(panel));
  }
  figure.caption += " " + data.describeAxis();
}

/// Component of the ground reactions, in the lab's frame.
struct ReactionAxis {
  const char* suffix;
  const char* title;
};
constexpr ReactionAxis kReactionAxes[] = {
    {"fx", "Forward"}, {"fy", "Upward"}, {"fz", "To the right"}};

void addReactions(
    const JobData& data, const Axis& y, double factor, const std::string& suffix, Figure& figure) {
  const TimeSeries& table = data.table("ground_reactions");
  for (const ReactionAxis& axis : kReactionAxes) {
    Panel panel = makePanel(data, axis.suffix + suffix, axis.title, y);
    const std::string component = axis.suffix;
    data.addSides(table, {component, "right_" + component, "left_" + component, ""}, factor, panel);
    data.addToeOffs(panel);
    figure.panels.push_back(std::move(panel));
  }
}

struct MarkerError {
  std::string marker;
  double rms = 0;
  double peak = 0;
};

std::vector<MarkerError> findMarkerErrors(const TimeSeries& table) {
  std::vector<MarkerError> errors;
  for (int column = 0; column < table.columnCount(); ++column) {
    MarkerError error{table.labels[static_cast<std::size_t>(column)], 0, 0};
    double squares = 0;
    int count = 0;
    for (int row = 0; row < table.rowCount(); ++row) {
      const double value = kCentimetersPerMeter * table.values(row, column);
      if (std::isfinite(value)) {
        squares += value * value;
        error.peak = std::max(error.peak, std::abs(value));
        ++count;
      }
    }
    if (count > 0) {
      error.rms = std::sqrt(squares / count);
      errors.push_back(error);
    }
  }
  std::stable_sort(errors.begin(), errors.end(), [](const MarkerError& a, const MarkerError& b) {
    return a.rms > b.rms;
  });
  return errors;
}

Panel makeMarkerBars(const TimeSeries& table) {
  Panel panel;
  panel.name = "markers";
  panel.title = "Error of each marker over the trial";
  panel.x.label = "Marker";
  panel.y = {"Distance", "cm", 0.0, std::nullopt};
  Series rms;
  rms.name = "RMS";
  rms.mark = SeriesMark::kBars;
  Series peak = rms;
  peak.name = "largest";
  for (const MarkerError& error : findMarkerErrors(table)) {
    rms.categories.push_back(error.marker);
    rms.y.push_back(error.rms);
    peak.y.push_back(error.peak);
  }
  peak.categories = rms.categories;
  panel.series = {rms, peak};
  return panel;
}

/// Root mean square over the markers of a frame.
TimeSeries calcFrameRms(const TimeSeries& errors) {
  Eigen::VectorXd rms(errors.rowCount());
  for (int row = 0; row < errors.rowCount(); ++row) {
    double squares = 0;
    int count = 0;
    for (int column = 0; column < errors.columnCount(); ++column) {
      const double value = errors.values(row, column);
      squares += std::isfinite(value) ? value * value : 0;
      count += std::isfinite(value) ? 1 : 0;
    }
    rms[row] = std::sqrt(squares / count);
  }
  TimeSeries table = makeEmptyTable(errors);
  addColumn("rms", rms, table);
  return table;
}

}  // namespace

void buildJointAngles(const JobData& data, Figure& figure) {
  buildCoordinates(data, data.table("kinematics"), {"deg", kDegreesPerRadian}, {"m", 1}, figure);
}

void buildTrackingErrors(const JobData& data, Figure& figure) {
  buildCoordinates(data,
                   data.table("tracking_errors"),
                   {"deg", kDegreesPerRadian},
                   {"cm", kCentimetersPerMeter},
                   figure);
  for (Panel& panel : figure.panels) {
    panel.y.label = "Error";
  }
}

void buildGroundReactions(const JobData& data, Figure& figure) {
  addReactions(data, {"Force", "N"}, 1, "", figure);
  if (const std::optional<double> weight = data.findBodyWeight()) {
    addReactions(data, {"Force", "BW"}, 1 / *weight, "_body_weights", figure);
  }
  figure.caption += " " + data.describeAxis();
}

void buildMarkerErrors(const JobData& data, Figure& figure) {
  const TimeSeries& table = data.table("marker_errors");
  figure.panels.push_back(makeMarkerBars(table));
  addLimit(data, "marker_error_peak", "any marker", 1, figure.panels.back());
  Panel frames = makePanel(data, "frames", "RMS over the markers", {"Distance", "cm", 0.0});
  data.addCurve(calcFrameRms(table),
                "rms",
                Side::kNone,
                {"RMS of a frame", SeriesRole::kPlain, kCentimetersPerMeter},
                frames);
  addLimit(data, "marker_error_rms", "RMS of a frame", 1, frames);
  figure.panels.push_back(std::move(frames));
  figure.caption += " " + data.describeAxis(false);
}

}  // namespace gaitmill
