#include "service/model_command.h"

#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/io/fiber_target_reader.h"
#include "core/io/files.h"
#include "core/io/model_table.h"
#include "core/io/osim_reader.h"
#include "core/io/osim_writer.h"
#include "core/validation/tendon_slack.h"

namespace gaitmill {

namespace {

// Keys stay in the order of the text report.
using nlohmann::ordered_json;

ordered_json makeVector(const Eigen::Vector3d& v) {
  return ordered_json::array({v[0], v[1], v[2]});
}

ordered_json makeCounts(const ModelSpec& spec) {
  const ModelCounts counts = countModel(spec);
  return {{"bodies", counts.bodies},
          {"joints", counts.joints},
          {"coordinates", counts.coordinates},
          {"coupled_coordinates", counts.coupled_coordinates},
          {"locked_coordinates", counts.locked_coordinates},
          {"muscles", counts.muscles},
          {"rigid_tendons", counts.rigid_tendons},
          {"wrap_cylinders", counts.wrap_cylinders},
          {"wrap_spheres", counts.wrap_spheres},
          {"wrap_ellipsoids", counts.wrap_ellipsoids},
          {"passive_forces", counts.passive_forces},
          {"actuators", counts.actuators},
          {"markers", counts.markers}};
}

ordered_json makeMuscle(const MuscleSpec& muscle) {
  return {{"name", muscle.name},
          {"max_isometric_force_n", muscle.max_isometric_force},
          {"optimal_fiber_length_m", muscle.optimal_fiber_length},
          {"tendon_slack_length_m", muscle.tendon_slack_length},
          {"pennation_at_optimal_deg", toDegrees(muscle.pennation_at_optimal)},
          {"rigid_tendon", muscle.tendon == TendonKind::kRigid},
          {"max_contraction_velocity_fiber_lengths_per_s", muscle.max_contraction_velocity},
          {"fiber_damping", muscle.fiber_damping},
          {"path_points", muscle.path.size()},
          {"wraps", muscle.wraps.size()}};
}

ordered_json makeBody(const BodySpec& body) {
  return {{"name", body.name},
          {"mass_kg", body.mass},
          {"mass_center_m", makeVector(body.mass_center)},
          {"inertia_kg_m2", body.inertia}};
}

ordered_json makeCoordinate(const JointSpec& joint, const CoordinateSpec& coordinate) {
  const bool angle = findMotionKind(joint, coordinate.name) == MotionKind::kRotational;
  const double factor = angle ? kDegreesPerRadian : 1.0;
  const std::string unit = angle ? "_deg" : "";
  return {{"name", coordinate.name},
          {"joint", joint.name},
          {"range_minimum" + unit, coordinate.range_min * factor},
          {"range_maximum" + unit, coordinate.range_max * factor},
          {"clamped", coordinate.clamped},
          {"locked", coordinate.locked}};
}

ordered_json makeActuator(const ActuatorSpec& actuator) {
  const bool on_coordinate = actuator.kind == ActuatorSpec::Kind::kCoordinate;
  return {
      {"name", actuator.name},
      {on_coordinate ? "coordinate" : "body", on_coordinate ? actuator.coordinate : actuator.body},
      {"optimal_force", actuator.optimal_force}};
}

std::string makeJson(const ModelSpec& spec, const std::vector<std::string>& warnings) {
  ordered_json document = {{"name", spec.name},
                           {"credits", spec.credits},
                           {"total_mass_kg", spec.calcTotalMass()},
                           {"counts", makeCounts(spec)}};
  for (const MuscleSpec& muscle : spec.muscles) {
    document["muscles"].push_back(makeMuscle(muscle));
  }
  for (const BodySpec& body : spec.bodies) {
    document["bodies"].push_back(makeBody(body));
  }
  for (const JointSpec& joint : spec.joints) {
    for (const CoordinateSpec& coordinate : joint.coordinates) {
      document["coordinates"].push_back(makeCoordinate(joint, coordinate));
    }
  }
  for (const ActuatorSpec& actuator : spec.actuators) {
    document["actuators"].push_back(makeActuator(actuator));
  }
  document["warnings"] = warnings;
  return document.dump(2) + "\n";
}

void writeCalibrationRow(std::ostream& out, const SlackCalibration& row) {
  const double difference_mm = 1000 * (row.slack_length - row.present_slack_length);
  out << std::left << std::setw(18) << row.muscle << std::right << std::fixed
      << std::setprecision(4) << std::setw(8) << row.norm_fiber_length
      << (row.is_given ? "  " : " .") << std::setprecision(3) << std::setw(12)
      << 100 * row.path_length << std::setw(12) << 100 * row.present_slack_length << std::setw(14)
      << 100 * row.slack_length << (row.tendon == TendonKind::kRigid ? "*" : " ")
      << std::setprecision(2) << std::setw(11) << difference_mm << '\n';
}

std::string formatCalibration(const std::vector<SlackCalibration>& rows) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << "Tendon slack lengths at hip flexion 7, abduction 2, knee 0, plantarflexion 20 deg, "
         "activation 1 %\n\n"
      << "Muscle              target l~   path [cm] present [cm] calibrated [cm]  change [mm]\n";
  int given = 0;
  int within = 0;
  for (const SlackCalibration& row : rows) {
    writeCalibrationRow(out, row);
    given += row.is_given ? 1 : 0;
    within += row.is_given && std::abs(row.slack_length - row.present_slack_length) < 1e-3 ? 1 : 0;
  }
  out << "\n* rigid tendon; . no target: where the muscle rests as it is, kept\n";
  if (given > 0) {
    out << within << " of " << given
        << " calibrated slack lengths are within 1 mm of the present\n";
  }
  return out.str();
}

}  // namespace

std::string describeModel(const std::string& path, ModelReport report) {
  std::vector<std::string> warnings;
  const ModelSpec spec = readOsim(readFile(path), path, &warnings);
  if (report == ModelReport::kJson) {
    return makeJson(spec, warnings);
  }
  std::string text = formatModelTable(spec);
  for (const std::string& warning : warnings) {
    text += "warning: " + warning + "\n";
  }
  return text;
}

std::string calibrateModel(const CalibrateOptions& options) {
  ModelSpec spec = readOsim(readFile(options.path), options.path);
  std::vector<FiberTarget> targets;
  if (!options.targets.empty()) {
    targets = readFiberTargets(readFile(options.targets), options.targets);
  }
  std::vector<SlackCalibration> rows;
  try {
    rows = calibrateTendonSlack(spec, targets);
  } catch (Error& error) {
    if (error.where().line > 0) {
      error.setFile(options.targets);
    }
    throw;
  }
  std::string text = formatCalibration(rows);
  if (!options.out.empty()) {
    writeFile(options.out, writeOsim(applyCalibration(std::move(spec), rows)));
    text += "written: " + options.out + "\n";
  }
  return text;
}

}  // namespace gaitmill
