#include "service/picture_data.h"

#include <nlohmann/json.hpp>

namespace gaitmill {

namespace {

constexpr ResultSource::Axis kTime = ResultSource::Axis::kTime;

// The result table with what muscles are coloured by.
const char* tableOf(MuscleColor color) {
  switch (color) {
    case MuscleColor::kActivation:
      return "activations";
    case MuscleColor::kForce:
      return "forces";
    case MuscleColor::kFiberLength:
      return "norm_fiber_lengths";
    case MuscleColor::kNone:
      break;
  }
  return "";
}

TimeSeries readIfThere(const ResultSource& results, const std::string& table) {
  return results.has(table, kTime) ? results.table(table, kTime) : TimeSeries{};
}

}  // namespace

MuscleColor parseMuscleColor(const std::string& color) {
  return color == "activation"     ? MuscleColor::kActivation
         : color == "force"        ? MuscleColor::kForce
         : color == "fiber_length" ? MuscleColor::kFiberLength
                                   : MuscleColor::kNone;
}

PictureData collectPictureData(const ResultSource& results, MuscleColor color) {
  PictureData data;
  data.kinematics = results.table("kinematics", kTime);
  data.muscle_values = readIfThere(results, tableOf(color));
  data.ground_reactions = readIfThere(results, "ground_reactions");
  data.markers = readIfThere(results, "measured_markers");
  const CycleSpan cycle = findCycleSpan(results.summary());
  if (cycle.exists()) {
    data.cycle = GaitCycle{cycle.start, cycle.end};
  }
  return data;
}

CycleSpan findCycleSpan(const std::string& summary_json) {
  using nlohmann::json;
  const json summary = json::parse(summary_json, nullptr, false);
  const auto cycle = summary.is_object() ? summary.find("gait_cycle_s") : summary.end();
  if (!summary.is_object() || cycle == summary.end() || !cycle->is_array() || cycle->size() != 2 ||
      !cycle->at(0).is_number() || !cycle->at(1).is_number()) {
    return {};
  }
  return {cycle->at(0).get<double>(), cycle->at(1).get<double>()};
}

}  // namespace gaitmill
