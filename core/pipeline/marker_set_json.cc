#include "core/pipeline/marker_set_json.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/pipeline/json_fields.h"

namespace gaitmill {

namespace {

TimeRange readTimeRange(JsonFields& fields) {
  if (!fields.has("time_range_s")) {
    return {};
  }
  const std::vector<double> range = fields.numbers("time_range_s");
  if (range.size() != 2 || range[0] > range[1]) {
    fields.refuse("time_range_s", "expected [start, end] with start <= end");
  }
  return {range[0], range[1]};
}

double readWeight(JsonFields& fields, const std::string& name) {
  const double weight = fields.number(name);
  if (!(weight >= 0) || !std::isfinite(weight)) {
    fields.refuse(name, "a weight must be a finite number >= 0");
  }
  return weight;
}

/// "min_deg" or "min_m": an angle in degrees or a length, whichever is present.
std::optional<double> readAngleOrLength(JsonFields& fields, const std::string& stem) {
  const std::string in_degrees = stem + "_deg";
  const std::string in_metres = stem + "_m";
  if (fields.has(in_degrees) && fields.has(in_metres)) {
    fields.refuse(in_degrees, "give either degrees or metres, not both");
  }
  if (fields.has(in_degrees)) {
    return toRadians(fields.number(in_degrees));
  }
  if (fields.has(in_metres)) {
    return fields.number(in_metres);
  }
  return std::nullopt;
}

void readMarkers(JsonFields& document, MarkerSetSpec& set) {
  for (JsonFields& fields : document.objects("markers")) {
    set.markers.push_back({fields.text("name"),
                           fields.text("body"),
                           fields.vector3("location_m"),
                           fields.flag("fixed", false)});
    if (fields.has("place_deviation_m")) {
      const double deviation = fields.number("place_deviation_m");
      if (deviation <= 0) {
        fields.refuse("place_deviation_m", "expected a positive number of metres");
      }
      set.place_deviations[set.markers.back().name] = deviation;
    }
    fields.finish();
  }
}

using Rule = VirtualMarkerSpec::Rule;
constexpr std::pair<const char*, Rule> kRules[] = {
    {"mean", Rule::kMean},
    {"harrington_2007_right", Rule::kRightHipCenter},
    {"harrington_2007_left", Rule::kLeftHipCenter},
};

std::vector<VirtualMarkerSpec> readVirtualMarkers(JsonFields& document) {
  std::vector<VirtualMarkerSpec> points;
  for (JsonFields& fields : document.objects("virtual_markers")) {
    VirtualMarkerSpec point{fields.text("name"), Rule::kMean, fields.texts("sources")};
    const std::string word = fields.text("rule", "mean");
    const auto* const found = std::find_if(
        std::begin(kRules), std::end(kRules), [&](const auto& rule) { return word == rule.first; });
    if (found == std::end(kRules)) {
      fields.refuse(
          "rule",
          "found '" + word + "', expected mean, harrington_2007_right or harrington_2007_left");
    }
    point.rule = found->second;
    if (point.sources.size() < (point.rule == Rule::kMean ? 1U : 3U)) {
      fields.refuse("sources",
                    point.rule == Rule::kMean
                        ? "expected at least one marker"
                        : "expected right ASIS, left ASIS, and one or two posterior markers");
    }
    fields.finish();
    points.push_back(std::move(point));
  }
  return points;
}

std::array<bool, 3> readAxes(JsonFields& fields) {
  const std::string letters = fields.text("axes", "XYZ");
  std::array<bool, 3> axes = {false, false, false};
  for (const char letter : letters) {
    if (letter < 'X' || letter > 'Z') {
      fields.refuse("axes", "expected some of the letters XYZ, found '" + letters + "'");
    }
    axes[static_cast<std::size_t>(letter - 'X')] = true;
  }
  return axes;
}

std::vector<MarkerPair> readPairs(JsonFields& fields) {
  std::vector<MarkerPair> pairs;
  const nlohmann::json& list = fields.raw("pairs");
  const auto is_pair = [](const nlohmann::json& entry) {
    return entry.is_array() && entry.size() == 2 && entry[0].is_string() && entry[1].is_string();
  };
  if (!list.is_array() || list.empty()) {
    fields.refuse("pairs", "expected a list of marker pairs");
  }
  for (const nlohmann::json& entry : list) {
    if (!is_pair(entry)) {
      fields.refuse("pairs", "each pair must be two marker names");
    }
    pairs.push_back({entry[0].get<std::string>(), entry[1].get<std::string>()});
  }
  return pairs;
}

std::optional<FactorLimit> readLimit(JsonFields& measurement) {
  if (!measurement.has("limit")) {
    return std::nullopt;
  }
  JsonFields fields = measurement.object("limit");
  FactorLimit limit{fields.text("measurement")};
  limit.min_ratio = fields.number("min_ratio", limit.min_ratio);
  limit.max_ratio = fields.number("max_ratio", limit.max_ratio);
  if (!(limit.min_ratio <= limit.max_ratio)) {
    fields.refuse("max_ratio", "lies below min_ratio");
  }
  fields.finish();
  return limit;
}

std::vector<MeasurementSpec> readMeasurements(JsonFields& scale) {
  std::vector<MeasurementSpec> measurements;
  for (JsonFields& fields : scale.objects("measurements")) {
    MeasurementSpec measurement;
    measurement.name = fields.text("name");
    measurement.pairs = readPairs(fields);
    measurement.bodies = fields.texts("bodies");
    measurement.axes = readAxes(fields);
    measurement.required = fields.flag("required", true);
    measurement.in_fitted_pose = fields.flag("in_fitted_pose", false);
    measurement.alternative_of = fields.text("alternative_of", "");
    measurement.min_factor = fields.number("min_factor", measurement.min_factor);
    measurement.max_factor = fields.number("max_factor", measurement.max_factor);
    measurement.limit = readLimit(fields);
    fields.finish();
    measurements.push_back(std::move(measurement));
  }
  return measurements;
}

std::vector<ManualScaleSpec> readManual(JsonFields& scale) {
  std::vector<ManualScaleSpec> manual;
  for (JsonFields& fields : scale.objects("manual")) {
    ManualScaleSpec entry{fields.texts("bodies"), fields.vector3("factors")};
    if (!(entry.factors.minCoeff() > 0)) {
      fields.refuse("factors", "scale factors must be positive");
    }
    fields.finish();
    manual.push_back(std::move(entry));
  }
  return manual;
}

ScalingOrder readOrder(JsonFields& scale) {
  if (!scale.has("order")) {
    return ScalingOrder::kMeasurementsThenManual;
  }
  const std::vector<std::string> order = scale.texts("order");
  if (order == std::vector<std::string>{"measurements", "manual"}) {
    return ScalingOrder::kMeasurementsThenManual;
  }
  if (order != std::vector<std::string>{"manual", "measurements"}) {
    scale.refuse("order", R"(expected ["measurements", "manual"] or ["manual", "measurements"])");
  }
  return ScalingOrder::kManualThenMeasurements;
}

void readScale(JsonFields scale, MarkerSetSpec& set) {
  set.order = readOrder(scale);
  set.measurement_range = readTimeRange(scale);
  set.size_ratio = scale.number("size_ratio", 1);
  if (!(set.size_ratio > 0)) {
    scale.refuse("size_ratio", "expected a positive number");
  }
  set.preserve_mass_distribution = scale.flag("preserve_mass_distribution", true);
  set.manual = readManual(scale);
  set.measurements = readMeasurements(scale);
  scale.finish();
}

std::vector<CoordinateTask> readCoordinateTasks(JsonFields& fit) {
  std::vector<CoordinateTask> tasks;
  for (JsonFields& fields : fit.objects("coordinate_tasks")) {
    CoordinateTask task{fields.text("coordinate"), readWeight(fields, "weight"), {}};
    task.value = readAngleOrLength(fields, "value");
    fields.finish();
    tasks.push_back(std::move(task));
  }
  return tasks;
}

std::vector<CoordinateRange> readRanges(JsonFields& fit) {
  std::vector<CoordinateRange> ranges;
  for (JsonFields& fields : fit.objects("ranges")) {
    CoordinateRange range;
    range.coordinate = fields.text("coordinate");
    range.min = readAngleOrLength(fields, "min").value_or(range.min);
    range.max = readAngleOrLength(fields, "max").value_or(range.max);
    if (range.min > range.max) {
      fields.refuse("coordinate", "the lower end of the range lies above the upper end");
    }
    fields.finish();
    ranges.push_back(std::move(range));
  }
  return ranges;
}

/// The fields that placements and inverse kinematics share; the caller finishes the object.
FitTasks readFitTasks(JsonFields& fit) {
  FitTasks tasks;
  JsonFields weights = fit.object("weights");
  for (const std::string& marker : weights.names()) {
    tasks.markers.push_back({marker, readWeight(weights, marker)});
  }
  tasks.coordinates = readCoordinateTasks(fit);
  tasks.ranges = readRanges(fit);
  return tasks;
}

PlacementSpec readPlacement(JsonFields& fields) {
  PlacementSpec placement;
  placement.range = readTimeRange(fields);
  placement.min_visible_fraction = fields.number("min_visible_fraction", 1);
  if (!(placement.min_visible_fraction > 0 && placement.min_visible_fraction <= 1)) {
    fields.refuse("min_visible_fraction", "expected a share in (0, 1]");
  }
  placement.tasks = readFitTasks(fields);
  return placement;
}

using Json = nlohmann::ordered_json;

void writeRange(const TimeRange& range, Json& json) {
  if (std::isfinite(range.start) && std::isfinite(range.end)) {
    json["time_range_s"] = {range.start, range.end};
  }
}

Json writePoint(const Eigen::Vector3d& point) {
  return {point.x(), point.y(), point.z()};
}

Json writeMarkers(const MarkerSetSpec& set) {
  Json list = Json::array();
  for (const MarkerSpec& marker : set.markers) {
    list.push_back({{"name", marker.name},
                    {"body", marker.body},
                    {"location_m", writePoint(marker.location)},
                    {"fixed", marker.fixed}});
    const auto deviation = set.place_deviations.find(marker.name);
    if (deviation != set.place_deviations.end()) {
      list.back()["place_deviation_m"] = deviation->second;
    }
  }
  return list;
}

Json writeVirtualMarkers(const std::vector<VirtualMarkerSpec>& points) {
  Json list = Json::array();
  for (const VirtualMarkerSpec& point : points) {
    for (const auto& [word, rule] : kRules) {
      if (rule == point.rule) {
        list.push_back({{"name", point.name}, {"rule", word}, {"sources", point.sources}});
      }
    }
  }
  return list;
}

Json writeLimit(const FactorLimit& limit) {
  Json json = {{"measurement", limit.measurement}, {"min_ratio", limit.min_ratio}};
  if (std::isfinite(limit.max_ratio)) {
    json["max_ratio"] = limit.max_ratio;
  }
  return json;
}

Json writeMeasurement(const MeasurementSpec& measurement) {
  Json pairs = Json::array();
  for (const MarkerPair& pair : measurement.pairs) {
    pairs.push_back({pair.first, pair.second});
  }
  std::string axes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (measurement.axes[axis]) {
      axes += "XYZ"[axis];
    }
  }
  Json json = {{"name", measurement.name},
               {"pairs", pairs},
               {"bodies", measurement.bodies},
               {"axes", axes},
               {"required", measurement.required},
               {"in_fitted_pose", measurement.in_fitted_pose},
               {"alternative_of", measurement.alternative_of},
               {"min_factor", measurement.min_factor}};
  if (std::isfinite(measurement.max_factor)) {
    json["max_factor"] = measurement.max_factor;
  }
  if (measurement.limit) {
    json["limit"] = writeLimit(*measurement.limit);
  }
  return json;
}

Json writeScale(const MarkerSetSpec& set) {
  Json json;
  json["order"] = set.order == ScalingOrder::kMeasurementsThenManual
                      ? Json{"measurements", "manual"}
                      : Json{"manual", "measurements"};
  writeRange(set.measurement_range, json);
  json["size_ratio"] = set.size_ratio;
  json["preserve_mass_distribution"] = set.preserve_mass_distribution;
  json["manual"] = Json::array();
  for (const ManualScaleSpec& manual : set.manual) {
    json["manual"].push_back({{"bodies", manual.bodies}, {"factors", writePoint(manual.factors)}});
  }
  json["measurements"] = Json::array();
  for (const MeasurementSpec& measurement : set.measurements) {
    json["measurements"].push_back(writeMeasurement(measurement));
  }
  return json;
}

void writeAngleOrLength(const ModelSpec& model,
                        const std::string& coordinate,
                        const std::string& stem,
                        double value,
                        Json& json) {
  if (!std::isfinite(value)) {
    return;
  }
  if (findMotionKind(model, coordinate) == MotionKind::kTranslational) {
    json[stem + "_m"] = value;
  } else {
    json[stem + "_deg"] = toDegrees(value);
  }
}

void writeFitTasks(const ModelSpec& model, const FitTasks& tasks, Json& json) {
  json["weights"] = Json::object();
  for (const MarkerWeight& marker : tasks.markers) {
    json["weights"][marker.marker] = marker.weight;
  }
  json["coordinate_tasks"] = Json::array();
  for (const CoordinateTask& task : tasks.coordinates) {
    Json entry = {{"coordinate", task.coordinate}, {"weight", task.weight}};
    if (task.value) {
      writeAngleOrLength(model, task.coordinate, "value", *task.value, entry);
    }
    json["coordinate_tasks"].push_back(std::move(entry));
  }
  json["ranges"] = Json::array();
  for (const CoordinateRange& range : tasks.ranges) {
    Json entry = {{"coordinate", range.coordinate}};
    writeAngleOrLength(model, range.coordinate, "min", range.min, entry);
    writeAngleOrLength(model, range.coordinate, "max", range.max, entry);
    json["ranges"].push_back(std::move(entry));
  }
}

}  // namespace

std::string writeMarkerSet(const MarkerSetSpec& set, const ModelSpec& model) {
  Json json;
  json["name"] = set.name;
  json["description"] = set.description;
  json["markers"] = writeMarkers(set);
  json["virtual_markers"] = writeVirtualMarkers(set.virtual_markers);
  json["scale"] = writeScale(set);
  json["placement"] = Json::array();
  for (const PlacementSpec& placement : set.placements) {
    Json entry;
    writeRange(placement.range, entry);
    entry["min_visible_fraction"] = placement.min_visible_fraction;
    writeFitTasks(model, placement.tasks, entry);
    json["placement"].push_back(std::move(entry));
  }
  writeFitTasks(model, set.ik, json["ik"]);
  return json.dump(2) + "\n";
}

MarkerSetSpec readMarkerSet(const InputFile& file) {
  const nlohmann::json document = parseJson(file);
  JsonFields fields(document, "", file.name);
  MarkerSetSpec set;
  set.name = fields.text("name");
  set.description = fields.text("description", "");
  readMarkers(fields, set);
  set.virtual_markers = readVirtualMarkers(fields);
  readScale(fields.object("scale"), set);
  for (JsonFields& placement : fields.objects("placement")) {
    set.placements.push_back(readPlacement(placement));
    placement.finish();
  }
  JsonFields ik = fields.object("ik");
  set.ik = readFitTasks(ik);
  ik.finish();
  fields.finish();
  return set;
}

}  // namespace gaitmill
