#include "core/pipeline/settings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/base/error.h"
#include "core/pipeline/json_fields.h"

namespace gaitmill {

namespace {

/// One of a few words. `choices` are in the order of the enumerators given.
template <class Enum>
void readChoice(JsonFields& fields,
                const std::string& name,
                const std::vector<std::pair<const char*, Enum>>& choices,
                Enum& value) {
  if (!fields.has(name)) {
    return;
  }
  const std::string word = fields.text(name);
  std::string known;
  for (const auto& [choice, meaning] : choices) {
    if (word == choice) {
      value = meaning;
      return;
    }
    known += (known.empty() ? "" : ", ") + std::string(choice);
  }
  fields.refuse(name, "found '" + word + "', expected one of " + known);
}

void readNumber(
    JsonFields& fields, const std::string& name, double low, double high, double& value) {
  if (!fields.has(name)) {
    return;
  }
  const double found = fields.number(name);
  if (!(found >= low && found <= high)) {
    fields.refuse(name,
                  "found " + std::to_string(found) + ", expected a number from " +
                      std::to_string(low) + " to " + std::to_string(high));
  }
  value = found;
}

void readOptional(JsonFields& fields,
                  const std::string& name,
                  double low,
                  double high,
                  std::optional<double>& value) {
  if (fields.has(name)) {
    double found = low;
    readNumber(fields, name, low, high, found);
    value = found;
  }
}

std::optional<TimeRange> readRange(JsonFields& fields, const std::string& name) {
  if (!fields.has(name)) {
    return std::nullopt;
  }
  const std::vector<double> ends = fields.numbers(name);
  if (ends.size() != 2 || !(ends[0] < ends[1])) {
    fields.refuse(name, "expected two increasing times [start, end] in seconds");
  }
  return TimeRange{ends[0], ends[1]};
}

CoordinateValues readValues(JsonFields& fields, const std::string& name) {
  CoordinateValues values;
  JsonFields entries = fields.object(name);
  for (const std::string& coordinate : entries.names()) {
    const double value = entries.number(coordinate);
    if (!std::isfinite(value) || value < 0) {
      entries.refuse(coordinate, "expected a number >= 0");
    }
    values[coordinate] = value;
  }
  return values;
}

ActuatorSetSettings::Residuals readResiduals(JsonFields fields) {
  ActuatorSetSettings::Residuals residuals;
  residuals.body = fields.text("body", residuals.body);
  if (fields.has("point_m")) {
    residuals.point = fields.vector3("point_m");
  }
  readNumber(fields, "optimal_force_n", 1e-6, 1e6, residuals.optimal_force);
  readNumber(fields, "optimal_moment_nm", 1e-6, 1e6, residuals.optimal_moment);
  readNumber(fields, "control_limit", 0, 1e12, residuals.control_limit);
  fields.finish();
  return residuals;
}

void readActuators(JsonFields& parent, ActuatorSetSettings& set) {
  if (!parent.has("actuators")) {
    return;
  }
  JsonFields fields = parent.object("actuators");
  set.residuals.reset();
  if (fields.has("residuals")) {
    set.residuals = readResiduals(fields.object("residuals"));
  }
  set.coordinates = readValues(fields, "coordinates");
  set.name_suffix = fields.text("name_suffix", set.name_suffix);
  readNumber(fields, "control_limit", 0, 1e12, set.control_limit);
  fields.finish();
}

void readStages(JsonFields fields, PipelineSettings& settings) {
  const auto stageAt = [&](const std::string& name, Stage& stage) {
    if (fields.has(name)) {
      try {
        stage = parseStage(fields.text(name));
      } catch (const Error& error) {
        fields.refuse(name, error.message());
      }
    }
  };
  stageAt("first", settings.first);
  stageAt("last", settings.last);
  if (fields.has("skip")) {
    for (const std::string& name : fields.texts("skip")) {
      settings.skipped.push_back(parseStage(name));
    }
  }
  if (settings.last < settings.first) {
    fields.refuse("last", "is a stage before the first one");
  }
  fields.finish();
}

void readTrialFiles(JsonFields fields, PipelineSettings& settings) {
  readChoice(fields,
             "marker_times",
             {{"regular", TrcOptions::Times::kRegular}, {"exact", TrcOptions::Times::kExact}},
             settings.trc.times);
  readChoice(fields,
             "marker_zeros",
             {{"missing", TrcOptions::Zeros::kMissing}, {"measured", TrcOptions::Zeros::kMeasured}},
             settings.trc.zeros);
  readChoice(fields,
             "marker_prefixes",
             {{"keep", TrcOptions::Prefixes::kKeep}, {"strip", TrcOptions::Prefixes::kStrip}},
             settings.trc.prefixes);
  readNumber(fields, "force_threshold_n", 0, 500, settings.forces.reading.threshold);
  readOptional(fields, "force_lowpass_cutoff_hz", 0.1, 1000, settings.forces.lowpass_cutoff);
  settings.forces.reading.right_body =
      fields.text("right_foot_body", settings.forces.reading.right_body);
  settings.forces.reading.left_body =
      fields.text("left_foot_body", settings.forces.reading.left_body);
  for (JsonFields& plate : fields.objects("plates")) {
    settings.forces.reading.plates.push_back({plate.text("family"), plate.text("body")});
    plate.finish();
  }
  settings.gait_cycle = readRange(fields, "gait_cycle_s");
  if (fields.has("paper_trial")) {
    settings.paper_trial = PaperTrial::kWalk;
    readChoice(fields,
               "paper_trial",
               {{"walk", PaperTrial::kWalk}, {"run", PaperTrial::kRun}},
               *settings.paper_trial);
  }
  fields.finish();
}

void readScale(JsonFields fields, PipelineSettings& settings) {
  settings.marker_set = fields.text("marker_set", settings.marker_set);
  readOptional(fields, "fiber_damping", 0, 10, settings.fiber_damping);
  fields.finish();
}

void readIk(JsonFields fields, PipelineSettings& settings) {
  settings.ik_range = readRange(fields, "time_range_s").value_or(settings.ik_range);
  readNumber(fields, "warn_rms_m", 0, 10, settings.ik_warn_rms);
  readNumber(fields, "warn_max_m", 0, 10, settings.ik_warn_max);
  fields.finish();
}

void readRra(JsonFields fields, RraSettings& rra) {
  readOptional(fields, "lowpass_cutoff_hz", 0.1, 1000, rra.lowpass_cutoff);
  rra.range = readRange(fields, "time_range_s").value_or(rra.range);
  readActuators(fields, rra.actuators);
  rra.adjusted_body = fields.text("adjusted_body", rra.adjusted_body);
  readChoice(fields,
             "inertia",
             {{"with_mass", InertiaScaling::kWithMass}, {"keep", InertiaScaling::kKeep}},
             rra.inertia);
  if (fields.has("passes")) {
    rra.passes.clear();
    for (JsonFields& entry : fields.objects("passes")) {
      rra.passes.push_back({readValues(entry, "weights"), readRange(entry, "time_range_s")});
      entry.finish();
    }
    rra.max_passes = static_cast<int>(rra.passes.size());
  }
  double passes = rra.max_passes;
  readNumber(fields, "max_passes", 1, 20, passes);
  rra.max_passes = static_cast<int>(passes);
  readNumber(fields, "mass_tolerance_kg", 0, 100, rra.mass_tolerance);
  readNumber(fields, "center_tolerance_m", 0, 1, rra.center_tolerance);
  fields.finish();
}

void readStrength(JsonFields fields, PipelineSettings& settings) {
  readChoice(fields,
             "law",
             {{"none", StrengthLaw::kNone},
              {"as_intended", StrengthLaw::kAsIntended},
              {"as_published", StrengthLaw::kAsPublished}},
             settings.strength_law);
  readOptional(fields, "height_m", 0.5, 2.6, settings.strength_height);
  readOptional(fields, "max_contraction_velocity", 1, 100, settings.max_contraction_velocity);
  fields.finish();
}

void readId(JsonFields fields, PipelineSettings& settings) {
  readOptional(fields, "lowpass_cutoff_hz", 0.1, 1000, settings.id.lowpass_cutoff);
  if (const std::optional<TimeRange> range = readRange(fields, "time_range_s")) {
    settings.id.start_time = range->start;
    settings.id.end_time = range->end;
  }
  double pass = settings.id_pass;
  readNumber(fields, "rra_pass", 0, 20, pass);
  settings.id_pass = static_cast<int>(pass);
  fields.finish();
}

void readSo(JsonFields fields, PipelineSettings& settings) {
  readNumber(fields, "exponent", 1, 10, settings.so.exponent);
  settings.so.capacity = fields.flag("force_length_velocity", true)
                             ? SoOptions::Capacity::kForceLengthVelocity
                             : SoOptions::Capacity::kIsometric;
  settings.so.passive_force = fields.flag("passive_force", false) ? SoOptions::PassiveForce::kOn
                                                                  : SoOptions::PassiveForce::kOff;
  settings.so.range = readRange(fields, "time_range_s").value_or(settings.so.range);
  readNumber(fields, "row_interval_s", 0, 10, settings.so_interval);
  readActuators(fields, settings.so_actuators);
  fields.finish();
}

std::vector<ExcitationLimit> readExcitationLimits(JsonFields& fields) {
  std::vector<ExcitationLimit> limits;
  for (JsonFields& entry : fields.objects("excitation_limits")) {
    ExcitationLimit limit;
    limit.muscle = entry.text("muscle");
    for (JsonFields& node : entry.objects("nodes")) {
      ExcitationLimit::Node value;
      value.time = node.number("until_s");
      readNumber(node, "upper", 0, 1, value.upper);
      node.finish();
      limit.nodes.push_back(value);
    }
    entry.finish();
    limits.push_back(std::move(limit));
  }
  return limits;
}

void readCmc(JsonFields fields, PipelineSettings& settings) {
  CmcOptions& cmc = settings.cmc;
  settings.cmc_range = readRange(fields, "time_range_s").value_or(settings.cmc_range);
  readNumber(fields, "window_s", 0.001, 0.1, cmc.window);
  readNumber(fields, "position_gain", 0, 1e6, cmc.position_gain);
  readNumber(fields, "velocity_gain", 0, 1e6, cmc.velocity_gain);
  readNumber(fields, "min_excitation", 0, 1, cmc.min_excitation);
  readNumber(fields, "max_excitation", 0, 1, cmc.max_excitation);
  cmc.equilibrate_at_default_pose =
      fields.flag("equilibrate_at_default_pose", cmc.equilibrate_at_default_pose);
  readNumber(fields, "integration_step_s", 1e-5, 0.1, cmc.integration_step);
  readNumber(fields, "excitation_tolerance", 1e-12, 0.1, cmc.excitation_tolerance);
  readNumber(fields, "barrier", 0, 1, cmc.barrier);
  readChoice(fields,
             "solver",
             {{"dual", CmcQpSolver::kDual}, {"ipopt", CmcQpSolver::kIpopt}},
             cmc.qp_solver);
  if (fields.has("excitation_limits")) {
    cmc.excitation_limits = readExcitationLimits(fields);
  }
  readActuators(fields, settings.cmc_actuators);
  fields.finish();
}

}  // namespace

bool PipelineSettings::runs(Stage stage) const {
  return stage >= first && stage <= last &&
         std::find(skipped.begin(), skipped.end(), stage) == skipped.end();
}

PipelineSettings readSettings(const InputFile& document) {
  const nlohmann::json json = parseJson(document);
  JsonFields fields(json, "", document.name);
  PipelineSettings settings;
  settings.name = fields.text("name", "");
  settings.description = fields.text("description", "");
  readStages(fields.object("stages"), settings);
  readTrialFiles(fields.object("trial"), settings);
  readScale(fields.object("scale"), settings);
  readIk(fields.object("ik"), settings);
  readRra(fields.object("rra"), settings.rra);
  readStrength(fields.object("strength"), settings);
  readId(fields.object("id"), settings);
  readSo(fields.object("so"), settings);
  readCmc(fields.object("cmc"), settings);
  fields.finish();
  return settings;
}

std::map<std::string, double> expandSides(const CoordinateValues& values, const ModelSpec& model) {
  std::map<std::string, double> expanded;
  std::vector<std::string> names;
  for (const JointSpec& joint : model.joints) {
    for (const CoordinateSpec& coordinate : joint.coordinates) {
      names.push_back(coordinate.name);
    }
  }
  const auto known = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  // Names of both sides first, so that an entry for one side replaces its half.
  for (const auto& [name, value] : values) {
    if (!known(name)) {
      const std::string nearest = findNearestName(name, names);
      require(known(name + "_r") && known(name + "_l"),
              ErrorCode::kInputCoordinates,
              "the model has no coordinate '" + name + "'" +
                  (nearest.empty() ? "" : "; the nearest is '" + nearest + "'"),
              {{}, 0, 0, name});
      expanded[name + "_r"] = value;
      expanded[name + "_l"] = value;
    }
  }
  for (const auto& [name, value] : values) {
    if (known(name)) {
      expanded[name] = value;
    }
  }
  return expanded;
}

namespace {

ActuatorSpec makeResidual(const ActuatorSetSettings::Residuals& residuals,
                          const ModelSpec& model,
                          int axis,
                          ActuatorSpec::Kind kind) {
  const bool force = kind == ActuatorSpec::Kind::kPoint;
  const int body = model.findBody(residuals.body);
  require(body >= 0,
          ErrorCode::kModelReference,
          "the residuals act on a body '" + residuals.body + "' that the model does not have",
          {{}, 0, 0, residuals.body});
  ActuatorSpec actuator;
  actuator.name = std::string(force ? "F" : "M") + "XYZ"[axis];
  actuator.kind = kind;
  actuator.body = residuals.body;
  actuator.point =
      residuals.point.value_or(model.bodies[static_cast<std::size_t>(body)].mass_center);
  actuator.direction = Eigen::Vector3d::Unit(axis);
  actuator.direction_in_ground = true;
  actuator.optimal_force = force ? residuals.optimal_force : residuals.optimal_moment;
  actuator.min_control = -residuals.control_limit;
  actuator.max_control = residuals.control_limit;
  return actuator;
}

}  // namespace

std::vector<ActuatorSpec> makeActuators(const ActuatorSetSettings& settings,
                                        const ModelSpec& model) {
  std::vector<ActuatorSpec> actuators;
  for (int axis = 0; settings.residuals && axis < 3; ++axis) {
    actuators.push_back(makeResidual(*settings.residuals, model, axis, ActuatorSpec::Kind::kPoint));
  }
  for (int axis = 0; settings.residuals && axis < 3; ++axis) {
    actuators.push_back(
        makeResidual(*settings.residuals, model, axis, ActuatorSpec::Kind::kTorque));
  }
  const std::map<std::string, double> optimal = expandSides(settings.coordinates, model);
  for (const JointSpec& joint : model.joints) {
    for (const CoordinateSpec& coordinate : joint.coordinates) {
      const auto found = optimal.find(coordinate.name);
      if (found == optimal.end() || found->second <= 0) {
        continue;
      }
      ActuatorSpec actuator;
      actuator.name = coordinate.name + settings.name_suffix;
      actuator.coordinate = coordinate.name;
      actuator.optimal_force = found->second;
      actuator.min_control = -settings.control_limit;
      actuator.max_control = settings.control_limit;
      actuators.push_back(actuator);
    }
  }
  return actuators;
}

}  // namespace gaitmill
