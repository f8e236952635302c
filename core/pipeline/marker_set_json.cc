#include "core/pipeline/marker_set_json.h"

#include <cmath>
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

std::vector<MarkerSpec> readMarkers(JsonFields& document) {
  std::vector<MarkerSpec> markers;
  for (JsonFields& fields : document.objects("markers")) {
    markers.push_back({fields.text("name"),
                       fields.text("body"),
                       fields.vector3("location_m"),
                       fields.flag("fixed", false)});
    fields.finish();
  }
  return markers;
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

std::vector<MeasurementSpec> readMeasurements(JsonFields& scale) {
  std::vector<MeasurementSpec> measurements;
  for (JsonFields& fields : scale.objects("measurements")) {
    MeasurementSpec measurement;
    measurement.name = fields.text("name");
    measurement.pairs = readPairs(fields);
    measurement.bodies = fields.texts("bodies");
    measurement.axes = readAxes(fields);
    measurement.required = fields.flag("required", true);
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

}  // namespace

MarkerSetSpec readMarkerSet(const InputFile& file) {
  const nlohmann::json document = parseJson(file);
  JsonFields fields(document, "", file.name);
  MarkerSetSpec set;
  set.name = fields.text("name");
  set.description = fields.text("description", "");
  set.markers = readMarkers(fields);
  readScale(fields.object("scale"), set);
  for (JsonFields& placement : fields.objects("placement")) {
    const TimeRange range = readTimeRange(placement);
    set.placements.push_back({range, readFitTasks(placement)});
    placement.finish();
  }
  JsonFields ik = fields.object("ik");
  set.ik = readFitTasks(ik);
  ik.finish();
  fields.finish();
  return set;
}

}  // namespace gaitmill
