#include "core/io/table_writer.h"

#include <cmath>
#include <cstddef>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/io/number_text.h"
#include "core/io/table_reader.h"

namespace gaitmill {

namespace {

void requireShape(const TimeSeries& table) {
  const bool fits = table.values.rows() == table.rowCount() &&
                    table.values.cols() == table.columnCount() &&
                    (table.units.empty() || table.units.size() == table.labels.size());
  require(fits,
          ErrorCode::kTableShape,
          "table '" + table.name + "' has " + std::to_string(table.rowCount()) + " times, " +
              std::to_string(table.columnCount()) + " labels and " +
              std::to_string(table.values.rows()) + " x " + std::to_string(table.values.cols()) +
              " values");
}

bool isRotational(const std::string& label, const ModelSpec& model) {
  const ColumnName column = parseColumnName(label);
  const std::string& name = model.findCoordinate(label) != nullptr ? label : column.name;
  return model.findCoordinate(name) != nullptr &&
         findMotionKind(model, name) == MotionKind::kRotational;
}

bool isAngleUnit(const std::string& unit) {
  return unit == "rad" || unit == "rad/s";
}

/// Factor per column: 180/pi for what is to be written in degrees, else 1.
std::vector<double> findFactors(const TimeSeries& table, const TableWriteOptions& options) {
  std::vector<double> factors(table.labels.size(), 1.0);
  if (options.angles == AngleUnit::kRadians) {
    return factors;
  }
  require(options.model != nullptr || !table.units.empty(),
          ErrorCode::kInputValue,
          "writing degrees needs the model or units, which tell angles from lengths");
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const bool is_angle = options.model != nullptr ? isRotational(table.labels[i], *options.model)
                                                   : isAngleUnit(table.units[i]);
    factors[i] = is_angle ? kDegreesPerRadian : 1.0;
  }
  return factors;
}

void appendRows(std::string& text,
                const TimeSeries& table,
                const std::vector<double>& factors,
                char separator) {
  for (int row = 0; row < table.rowCount(); ++row) {
    appendNumber(text, table.time[static_cast<std::size_t>(row)]);
    for (int column = 0; column < table.columnCount(); ++column) {
      const double value = table.values(row, column) * factors[static_cast<std::size_t>(column)];
      text += separator;
      if (separator != ',' || !std::isnan(value)) {
        appendNumber(text, value);
      }
    }
    text += '\n';
  }
}

std::string makeCsvLabel(const TimeSeries& table, std::size_t column, double factor) {
  if (table.units.empty()) {
    return table.labels[column];
  }
  std::string unit = table.units[column];
  if (factor != 1.0) {
    unit = unit == "rad" ? "deg" : "deg/s";
  }
  return table.labels[column] + " [" + (unit.empty() ? "1" : unit) + "]";
}

}  // namespace

std::string writeTable(const TimeSeries& table, const TableWriteOptions& options) {
  requireShape(table);
  const std::vector<double> factors = findFactors(table, options);
  std::string text = table.name.empty() ? "table" : table.name;
  text += "\nversion=1\nnRows=" + std::to_string(table.rowCount());
  text += "\nnColumns=" + std::to_string(table.columnCount() + 1);
  text += options.angles == AngleUnit::kDegrees ? "\ninDegrees=yes\n" : "\ninDegrees=no\n";
  for (const std::string& note : options.notes) {
    text += note + "\n";
  }
  text += "endheader\ntime";
  for (const std::string& label : table.labels) {
    text += "\t" + label;
  }
  text += '\n';
  appendRows(text, table, factors, '\t');
  return text;
}

std::string writeCsv(const TimeSeries& table, const TableWriteOptions& options) {
  requireShape(table);
  const std::vector<double> factors = findFactors(table, options);
  std::string text = table.units.empty() ? "time" : "time [s]";
  for (std::size_t i = 0; i < table.labels.size(); ++i) {
    text += "," + makeCsvLabel(table, i, factors[i]);
  }
  text += '\n';
  appendRows(text, table, factors, ',');
  return text;
}

std::string writeTrc(const MarkerTrajectories& markers, const std::string& file_name) {
  const std::string frames = std::to_string(markers.frameCount());
  const std::string rate = formatNumber(markers.rate);
  std::string text = "PathFileType\t4\t(X/Y/Z)\t" + file_name +
                     "\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\t"
                     "OrigDataStartFrame\tOrigNumFrames\n";
  text += rate + "\t" + rate + "\t" + frames + "\t" + std::to_string(markers.markerCount()) +
          "\tm\t" + rate + "\t1\t" + frames + "\nFrame#\tTime";
  std::string axes = "\t";
  for (int marker = 0; marker < markers.markerCount(); ++marker) {
    text += "\t" + markers.names[static_cast<std::size_t>(marker)] + "\t\t";
    const std::string number = std::to_string(marker + 1);
    for (const char* axis : {"\tX", "\tY", "\tZ"}) {
      axes.append(axis).append(number);
    }
  }
  text += "\n" + axes + "\n\n";
  for (int frame = 0; frame < markers.frameCount(); ++frame) {
    text += std::to_string(frame + 1) + "\t";
    appendNumber(text, markers.time[static_cast<std::size_t>(frame)]);
    for (Eigen::Index i = 0; i < markers.positions.cols(); ++i) {
      text += '\t';
      appendNumber(text, markers.positions(frame, i));
    }
    text += '\n';
  }
  return text;
}

}  // namespace gaitmill
