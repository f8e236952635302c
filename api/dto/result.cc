#include "api/dto/result.h"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "api/dto/csv.h"
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
constexpr const char* kVegaLiteType = "application/vnd.vegalite.v5+json";
constexpr std::array<FormatName, 5> kFormats{
    {{ResultFormat::kJson, "json", "application/json", "application/json"},
     {ResultFormat::kCsv, "csv", "text/csv", "text/csv; charset=utf-8"},
     {ResultFormat::kSto, "sto", "application/vnd.opensim.sto", "application/vnd.opensim.sto"},
     {ResultFormat::kVegaLite, "vega-lite", kVegaLiteType, kVegaLiteType},
     {ResultFormat::kSvg, "svg", "image/svg+xml", "image/svg+xml"}}};

std::string trim(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  const std::size_t last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// One entry of an Accept header: "text/csv; q=0.9".
struct MediaRange {
  std::string type;
  double quality = 1.0;
};

MediaRange parseMediaRange(const std::string& text) {
  MediaRange range;
  std::istringstream pieces(text);
  std::string piece;
  std::getline(pieces, piece, ';');
  range.type = trim(piece);
  while (std::getline(pieces, piece, ';')) {
    const std::string parameter = trim(piece);
    if (parameter.rfind("q=", 0) == 0) {
      const char* const end = parameter.data() + parameter.size();
      if (std::from_chars(parameter.data() + 2, end, range.quality).ec != std::errc()) {
        range.quality = 0.0;
      }
    }
  }
  return range;
}

bool matches(const std::string& range, const std::string& media_type) {
  return range == "*/*" || range == media_type ||
         range == media_type.substr(0, media_type.find('/')) + "/*";
}

const FormatName& findFormatName(ResultFormat format) {
  for (const FormatName& known : kFormats) {
    if (known.format == format) {
      return known;
    }
  }
  throw Error(ErrorCode::kInternal, "result format without a name");
}

// The offer that the header likes best; of equals the one that it names first.
std::optional<ResultFormat> negotiate(const std::string& accept, const Formats& offers) {
  std::optional<ResultFormat> best;
  double best_quality = 0.0;
  std::istringstream ranges(accept);
  std::string text;
  while (std::getline(ranges, text, ',')) {
    const MediaRange range = parseMediaRange(text);
    for (const ResultFormat offer : offers) {
      if (range.quality > best_quality && matches(range.type, findFormatName(offer).media_type)) {
        best = offer;
        best_quality = range.quality;
      }
    }
  }
  return best;
}

std::string listOffers(const Formats& offers, const char* FormatName::*member) {
  std::string list;
  for (const ResultFormat offer : offers) {
    list.append(list.empty() ? "" : ", ").append(findFormatName(offer).*member);
  }
  return list;
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

std::string unitOf(const TimeSeries& table, int column) {
  const std::string unit = table.units.empty() ? "" : table.units[static_cast<std::size_t>(column)];
  return unit.empty() ? "1" : unit;
}

// A column: its opening up to the values.
std::string dumpHead(const json& column) {
  std::string head = dumpJson(column);
  head.pop_back();
  return head + ",\"values\":";
}

// The side of "soleus_r", "hip_flexion_l_moment": the first part between underscores that is one
// of the letters. Null for what has none, such as the pelvis.
json findSide(const std::string& label) {
  std::istringstream parts(label);
  std::string part;
  while (std::getline(parts, part, '_')) {
    if (part == "r") {
      return "right";
    }
    if (part == "l") {
      return "left";
    }
  }
  return nullptr;
}

const char* axisName(TableAxis axis) {
  return axis == TableAxis::kTime ? "time" : "gait_cycle";
}
const char* axisUnit(TableAxis axis) {
  return axis == TableAxis::kTime ? "s" : "percent";
}

// "N.m" as names wear it: "_nm"; empty for what has no unit.
std::string makeUnitSuffix(const json& figure) {
  std::string suffix;
  for (const char letter : figure.value("unit", "")) {
    if (std::isalnum(static_cast<unsigned char>(letter)) != 0) {
      suffix += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    }
    suffix += letter == '%' ? "percent" : "";
  }
  return suffix.empty() ? "" : "_" + suffix;
}

bool isFigure(const json& value) {
  return value.is_object() && value.contains("figure") && value["figure"].is_string();
}

// Entries of a list that say which figure they are go by its name, because another job may have
// another list.
void collectNumbers(const json& value, const std::string& path, Quantities& found) {
  if (value.is_number()) {
    found.emplace_back(path, value.get<double>());
    return;
  }
  if (!value.is_structured()) {
    return;
  }
  const std::string suffix = isFigure(value) ? makeUnitSuffix(value) : "";
  for (const auto& [key, child] : value.items()) {
    const std::string name = isFigure(child) ? child["figure"].get<std::string>() : key;
    std::string child_path = path;
    child_path.append(path.empty() ? "" : ".").append(name).append(suffix);
    collectNumbers(child, child_path, found);
  }
}

}  // namespace

const std::vector<std::string>& tableNames() {
  static const std::vector<std::string> names = {"moments",
                                                 "activations",
                                                 "excitations",
                                                 "forces",
                                                 "fiber_lengths",
                                                 "fiber_velocities",
                                                 "kinematics",
                                                 "residuals",
                                                 "reserves",
                                                 "tracking_errors",
                                                 "marker_errors",
                                                 "measured_markers",
                                                 "ground_reactions",
                                                 "muscle_moments",
                                                 "active_fiber_forces",
                                                 "passive_fiber_forces",
                                                 "norm_fiber_lengths",
                                                 "norm_fiber_velocities",
                                                 "pennation_angles",
                                                 "fiber_active_powers",
                                                 "fiber_passive_powers",
                                                 "tendon_powers",
                                                 "muscle_powers",
                                                 "muscle_work",
                                                 "joint_powers",
                                                 "joint_reactions",
                                                 "emg"};
  return names;
}

ResultFormat findResultFormat(const std::string& format,
                              const std::string& accept,
                              const Formats& offers) {
  for (const ResultFormat offer : offers) {
    if (format == findFormatName(offer).parameter) {
      return offer;
    }
  }
  require(format.empty(),
          ErrorCode::kRequestNotAcceptable,
          "this comes as " + listOffers(offers, &FormatName::parameter),
          {"", 0, 0, "format"});
  if (accept.empty()) {
    return offers.front();
  }
  const std::optional<ResultFormat> best = negotiate(accept, offers);
  require(best.has_value(),
          ErrorCode::kRequestNotAcceptable,
          "this comes as " + listOffers(offers, &FormatName::media_type),
          {"", 0, 0, "Accept"});
  return *best;
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
  return findFormatName(format).content_type;
}

const char* formatName(ResultFormat format) {
  return findFormatName(format).parameter;
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

std::string renderTableJson(const ResultTable& result, TableAxis axis) {
  const TimeSeries& table = result.table;
  std::string out = "{\"name\":" + dumpJson(table.name) + ",\"stage\":" + dumpJson(result.stage) +
                    ",\"final\":" + (result.is_final ? "true" : "false") +
                    ",\"provenance\":" + dumpJson(result.provenance) +
                    ",\"axis\":" + dumpHead({{"name", axisName(axis)}, {"unit", axisUnit(axis)}});
  appendValues(out, Eigen::Map<const Eigen::VectorXd>(table.time.data(), table.rowCount()));
  out += "},\"columns\":[";
  for (int column = 0; column < table.columnCount(); ++column) {
    const std::string& name = table.labels[static_cast<std::size_t>(column)];
    out += column > 0 ? "," : "";
    out += dumpHead({{"name", name}, {"unit", unitOf(table, column)}, {"side", findSide(name)}});
    appendValues(out, table.values.col(column));
    out += '}';
  }
  return out + "],\"settings\":" + (result.settings_json.empty() ? "null" : result.settings_json) +
         "}";
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

Quantities listQuantities(const std::string& quality_json) {
  Quantities quantities;
  collectNumbers(json::parse(quality_json), "", quantities);
  return quantities;
}

std::string renderQualityCsv(const std::string& quality_json) {
  const Quantities quantities = listQuantities(quality_json);
  std::string out = "quantity,value\n";
  for (const auto& [name, value] : quantities) {
    out += quoteCsv(name) + ",";
    appendNumber(out, value);
    out += '\n';
  }
  return out;
}

TimeSeries makeQualityTable(const std::string& quality_json) {
  const Quantities quantities = listQuantities(quality_json);
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

std::string renderFile(const FileView& file) {
  return dumpJson({{"name", file.name}, {"size_bytes", file.size}, {"sha256", file.sha256}});
}

std::string renderResult(const ResultView& result) {
  const json axes = result.has_cycle ? json{"time", "cycle"} : json::array({"time"});
  return dumpJson({{"name", result.name},
                   {"stage", result.stage.empty() ? json(nullptr) : json(result.stage)},
                   {"axes", result.name == "quality" ? json::array() : axes},
                   {"formats", {"json", "csv", "sto"}}});
}

}  // namespace gaitmill::api
