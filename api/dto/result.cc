#include "api/dto/result.h"

#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <utility>

#include <nlohmann/json.hpp>

#include "api/dto/object_reader.h"
#include "core/base/error.h"
#include "core/base/units.h"

namespace gaitmill::api {

namespace {

using nlohmann::json;

struct FormatName {
  ResultFormat format;
  const char* parameter;
  const char* media_type;
  const char* content_type;
};
constexpr std::array<FormatName, 3> kFormats{
    {{ResultFormat::kJson, "json", "application/json", "application/json"},
     {ResultFormat::kCsv, "csv", "text/csv", "text/csv; charset=utf-8"},
     {ResultFormat::kSto, "sto", "application/vnd.opensim.sto", "application/vnd.opensim.sto"}}};

// "text/csv;q=0.9" -> "text/csv"
std::string trimMediaType(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  const std::size_t last = text.find_last_not_of(" \t", text.find(';') - 1);
  return first == std::string::npos || last == std::string::npos || last < first
             ? ""
             : text.substr(first, last - first + 1);
}

bool matches(const std::string& range, const std::string& media_type) {
  return range == "*/*" || range == media_type ||
         range == media_type.substr(0, media_type.find('/')) + "/*";
}

void appendNumber(std::string& out, double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  out.append(digits.data(), end.ptr);
}

template <class Values>
void appendValues(std::string& out, const Values& values) {
  out += '[';
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (i > 0) {
      out += ',';
    }
    if (std::isfinite(values(i))) {
      appendNumber(out, values(i));
    } else {
      out += "null";
    }
  }
  out += ']';
}

template <class Values>
void appendColumn(std::string& out,
                  const std::string& name,
                  const std::string& unit,
                  const Values& values) {
  out += "{\"name\":" + dumpJson(name) + ",\"unit\":" + dumpJson(unit) + ",\"values\":";
  appendValues(out, values);
  out += '}';
}

std::string unitOf(const TimeSeries& table, int column) {
  const std::string unit = table.units.empty() ? "" : table.units[static_cast<std::size_t>(column)];
  return unit.empty() ? "1" : unit;
}

const char* axisName(TableAxis axis) {
  return axis == TableAxis::kTime ? "time" : "gait_cycle";
}
const char* axisUnit(TableAxis axis) {
  return axis == TableAxis::kTime ? "s" : "percent";
}

// Labels come from uploaded files, so they may hold anything.
std::string quoteCsv(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char letter : text) {
    quoted += letter;
    if (letter == '"') {
      quoted += '"';
    }
  }
  return quoted + "\"";
}

using Quantities = std::vector<std::pair<std::string, double>>;

void collectNumbers(const json& value, const std::string& path, Quantities& found) {
  if (value.is_number()) {
    found.emplace_back(path, value.get<double>());
    return;
  }
  if (!value.is_structured()) {
    return;
  }
  for (const auto& [key, child] : value.items()) {
    std::string child_path = path;
    child_path.append(path.empty() ? "" : ".").append(key);
    collectNumbers(child, child_path, found);
  }
}

}  // namespace

const std::vector<std::string>& tableNames() {
  static const std::vector<std::string> names = {
      "moments", "activations", "forces", "kinematics", "residuals"};
  return names;
}

ResultFormat findResultFormat(const std::string& format, const std::string& accept) {
  for (const FormatName& known : kFormats) {
    if (format == known.parameter) {
      return known.format;
    }
  }
  require(format.empty(),
          ErrorCode::kRequestNotAcceptable,
          "results come as json, csv or sto",
          {"", 0, 0, "format"});
  if (accept.empty()) {
    return ResultFormat::kJson;
  }
  std::istringstream ranges(accept);
  std::string range;
  while (std::getline(ranges, range, ',')) {
    for (const FormatName& known : kFormats) {
      if (matches(trimMediaType(range), known.media_type)) {
        return known.format;
      }
    }
  }
  throw Error(ErrorCode::kRequestNotAcceptable,
              "results come as application/json, text/csv or application/vnd.opensim.sto",
              {"", 0, 0, "Accept"});
}

TableAxis parseTableAxis(const std::string& text) {
  require(text.empty() || text == "time" || text == "cycle",
          ErrorCode::kRequestField,
          "parameter 'axis' is time or cycle",
          {"", 0, 0, "axis"});
  return text == "cycle" ? TableAxis::kCycle : TableAxis::kTime;
}

AngleUnit parseAngleUnit(const std::string& text) {
  require(text.empty() || text == "rad" || text == "deg",
          ErrorCode::kRequestField,
          "parameter 'angles' is rad or deg",
          {"", 0, 0, "angles"});
  return text == "deg" ? AngleUnit::kDegrees : AngleUnit::kRadians;
}

const char* contentType(ResultFormat format) {
  for (const FormatName& known : kFormats) {
    if (known.format == format) {
      return known.content_type;
    }
  }
  throw Error(ErrorCode::kInternal, "result format without a content type");
}

TimeSeries convertToDegrees(TimeSeries table) {
  for (std::size_t i = 0; i < table.units.size(); ++i) {
    if (table.units[i] == "rad" || table.units[i] == "rad/s") {
      table.units[i].replace(0, 3, "deg");
      table.values.col(static_cast<Eigen::Index>(i)) *= kDegreesPerRadian;
    }
  }
  return table;
}

std::string renderTableJson(const TimeSeries& table, TableAxis axis) {
  std::string out = "{\"name\":" + dumpJson(table.name) + ",\"axis\":";
  const Eigen::Map<const Eigen::VectorXd> time(table.time.data(), table.rowCount());
  appendColumn(out, axisName(axis), axisUnit(axis), time);
  out += ",\"columns\":[";
  for (int column = 0; column < table.columnCount(); ++column) {
    if (column > 0) {
      out += ',';
    }
    appendColumn(out,
                 table.labels[static_cast<std::size_t>(column)],
                 unitOf(table, column),
                 table.values.col(column));
  }
  return out + "]}";
}

std::string renderTableCsv(const TimeSeries& table, TableAxis axis) {
  std::string out = std::string(axisName(axis)) + " [" + axisUnit(axis) + "]";
  for (int column = 0; column < table.columnCount(); ++column) {
    const std::string& label = table.labels[static_cast<std::size_t>(column)];
    out += "," + quoteCsv(label + " [" + unitOf(table, column) + "]");
  }
  for (int row = 0; row < table.rowCount(); ++row) {
    out += '\n';
    appendNumber(out, table.time[static_cast<std::size_t>(row)]);
    for (int column = 0; column < table.columnCount(); ++column) {
      out += ',';
      if (std::isfinite(table.values(row, column))) {
        appendNumber(out, table.values(row, column));
      }
    }
  }
  return out + "\n";
}

std::string renderQualityCsv(const std::string& quality_json) {
  Quantities quantities;
  collectNumbers(json::parse(quality_json), "", quantities);
  std::string out = "quantity,value\n";
  for (const auto& [name, value] : quantities) {
    out += quoteCsv(name) + ",";
    appendNumber(out, value);
    out += '\n';
  }
  return out;
}

TimeSeries makeQualityTable(const std::string& quality_json) {
  Quantities quantities;
  collectNumbers(json::parse(quality_json), "", quantities);
  std::vector<std::string> labels;
  for (const auto& [name, value] : quantities) {
    labels.push_back(name);
  }
  TimeSeries table = makeTimeSeries("quality", labels, {0.0});
  for (int column = 0; column < table.columnCount(); ++column) {
    table.values(0, column) = quantities[static_cast<std::size_t>(column)].second;
  }
  return table;
}

std::string renderFiles(const std::vector<FileView>& files) {
  json list = json::array();
  for (const FileView& file : files) {
    list.push_back({{"name", file.name}, {"size_bytes", file.size}, {"sha256", file.sha256}});
  }
  return dumpJson({{"files", list}});
}

}  // namespace gaitmill::api
