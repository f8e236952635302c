#include "core/pipeline/sample_files.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/io/number_text.h"
#include "core/io/osim_writer.h"
#include "core/io/table_writer.h"
#include "core/model/model.h"
#include "core/scale/apply_scale.h"

namespace gaitmill {

namespace {

// Steps to which recorded values are rounded, as laboratory files are. Rounding also keeps the
// files the same where a mathematical library differs in its last bit.
constexpr double kLengthStep = 1e-5;    // [m]
constexpr double kPointStep = 1e-6;     // [m] a centre of pressure carries the whole weight
constexpr double kForceStep = 1e-4;     // [N|N.m]
constexpr double kEnvelopeStep = 1e-4;  // [-]

// Nearest multiple of 1 / round(1 / step): the quotient is the double nearest to the decimal
// number, so that it prints with few digits.
double roundTo(double value, double step) {
  const double per_unit = std::round(1.0 / step);
  return std::round(value * per_unit) / per_unit + 0.0;  // + 0 turns -0 into 0
}

MarkerTrajectories roundMarkers(MarkerTrajectories markers) {
  markers.positions = markers.positions.unaryExpr([](double x) { return roundTo(x, kLengthStep); });
  return markers;
}

TimeSeries makeForceTable(const GroundReaction& reaction) {
  constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
  std::vector<std::string> labels;
  std::vector<std::string> units;
  for (const ExternalForce& force : reaction.forces) {
    // "ground_force_r" with torques "ground_torque_r_x"
    const std::string torque = "ground_torque" + force.name.substr(force.name.rfind('_'));
    for (const auto& [prefix, unit] : {std::pair<std::string, std::string>(force.name + "_v", "N"),
                                       {force.name + "_p", "m"},
                                       {torque + "_", "N.m"}}) {
      for (const char* axis : kAxes) {
        labels.push_back(prefix + axis);
        units.push_back(unit);
      }
    }
  }
  TimeSeries table = makeTimeSeries("ground reaction of the sample trial", labels, reaction.time);
  table.units = units;
  for (int row = 0; row < table.rowCount(); ++row) {
    Eigen::Index column = 0;
    for (const ExternalForce& force : reaction.forces) {
      for (const auto& [values, step] :
           {std::pair<const Eigen::Matrix3Xd*, double>(&force.force, kForceStep),
            {&force.point, kPointStep},
            {&force.torque, kForceStep}}) {
        for (int axis = 0; axis < 3; ++axis) {
          table.values(row, column++) = roundTo((*values)(axis, row), step);
        }
      }
    }
  }
  return table;
}

TimeSeries roundEnvelopes(TimeSeries emg) {
  emg.values = emg.values.unaryExpr([](double x) { return roundTo(x, kEnvelopeStep); });
  return emg;
}

std::string writeTrialPart(const SamplePerson& person) {
  return "{\n  \"mass_kg\": " + formatNumber(person.mass) +
         ",\n  \"height_m\": " + formatNumber(person.height) + "\n}\n";
}

}  // namespace

ModelSpec makeSampleSubject(const ModelSpec& generic, const SamplePerson& person) {
  std::vector<BodyScale> scales;
  for (const SegmentFactor& segment : person.factors) {
    for (const std::string& body : segment.bodies) {
      scales.push_back({body, Eigen::Vector3d::Constant(segment.factor)});
    }
  }
  ModelSpec subject = applyScaleFactors(generic, scales, MassDistribution::kPreserved);
  setTotalMass(subject, person.mass, InertiaScaling::kWithMass);
  subject.name = "sample_subject";
  return subject;
}

SampleFiles makeSampleFiles(const ModelSpec& generic,
                            const SamplePerson& person,
                            const SampleOptions& options) {
  const ModelSpec spec = makeSampleSubject(generic, person);
  const Model subject(spec);
  const SampleTrial trial = generateSampleTrial(subject, options);

  SampleFiles files;
  files.recorded["static.trc"] = writeTrc(roundMarkers(trial.static_markers), "static.trc");
  files.recorded["markers.trc"] = writeTrc(roundMarkers(trial.markers), "markers.trc");
  files.recorded["grf.mot"] = writeTable(makeForceTable(trial.ground_reaction));
  files.recorded["emg.sto"] = writeTable(roundEnvelopes(trial.emg));
  files.recorded["trial.json"] = writeTrialPart(person);

  files.truth["subject.osim"] = writeOsim(spec);
  files.truth["coordinates.mot"] = writeTable(trial.coordinates, {AngleUnit::kDegrees, &spec, {}});
  files.truth["moments.sto"] = writeTable(trial.moments);
  return files;
}

}  // namespace gaitmill
