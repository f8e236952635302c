// The comparison of Rajagopal et al. (2016): muscle control of one running trial through a model of
// the Delp lineage (Hamner et al. 2010) and through Rajagopal2016. Both are prepared alike: scaled
// to the subject on one static trial, inverse kinematics, residual reduction, the same residuals
// and reserves. They are measured in turn in one run of this program; the ratio is that of the
// medians.
#include <time.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/cmc/cmc_solver.h"
#include "core/io/files.h"
#include "core/io/grf_reader.h"
#include "core/io/osim_reader.h"
#include "core/io/osim_writer.h"
#include "core/io/table_reader.h"
#include "core/math/table_filters.h"
#include "core/model/external_loads.h"
#include "core/model/free_coordinates.h"
#include "core/model/model.h"
#include "core/model/reference_motion.h"
#include "core/pipeline/pipeline.h"
#include "tests/support/shared_data.h"

namespace gaitmill {
namespace {

/// Time of the Delp lineage over that of Rajagopal2016 in the paper: 11 % faster.
constexpr double kPaperRatio = 0.89;

// Nothing that only one of the models has, and no muscle held off.
constexpr const char* kSettings = R"({
  "name": "lineage",
  "scale": {"marker_set": "paper_run"},
  "rra": {"lowpass_cutoff_hz": 15, "time_range_s": [0.82, 1.56]},
  "strength": {"law": "none"},
  "stages": {"first": "scale", "last": "rra"}
})";

std::vector<ActuatorSpec> makeActuators(const ModelSpec& model) {
  std::vector<ActuatorSpec> actuators;
  const auto add = [&](const std::string& name, double optimal_force) -> ActuatorSpec& {
    ActuatorSpec actuator;
    actuator.name = name;
    actuator.optimal_force = optimal_force;
    actuator.min_control = -1000;
    actuator.max_control = 1000;
    actuators.push_back(actuator);
    return actuators.back();
  };
  const BodySpec& pelvis = model.bodies.at(static_cast<std::size_t>(model.findBody("pelvis")));
  for (int axis = 0; axis < 3; ++axis) {
    ActuatorSpec& force = add("force" + std::to_string(axis), 10);
    force.kind = ActuatorSpec::Kind::kPoint;
    force.body = "pelvis";
    force.point = pelvis.mass_center;
    force.direction = Eigen::Vector3d::Unit(axis);
    ActuatorSpec& torque = add("moment" + std::to_string(axis), 15);
    torque.kind = ActuatorSpec::Kind::kTorque;
    torque.body = "pelvis";
    torque.direction = Eigen::Vector3d::Unit(axis);
  }
  // Every joint of legs, trunk and arms; the torque actuators of Rajagopal2016 itself are dropped.
  for (const JointSpec& joint : model.joints) {
    for (const CoordinateSpec& coordinate : joint.coordinates) {
      const bool of_patella = coordinate.name.find("_beta") != std::string::npos;
      const bool of_pelvis = coordinate.name.rfind("pelvis_", 0) == 0;
      if (!coordinate.locked && !of_patella && !of_pelvis) {
        add(coordinate.name + "_reserve", 10).coordinate = coordinate.name;
      }
    }
  }
  return actuators;
}

/// A model and a motion, ready for muscle control.
struct Prepared {
  Prepared(const ModelSpec& spec, const TimeSeries& motion, const GroundReaction& reaction)
      : model(spec),
        free(model),
        reference(model, free, padOdd(motion, 60)),
        loads(model, reaction) {
    options.start_time = 0.83;  // as published
    options.end_time = 1.546;
    options.actuators = makeActuators(spec);
  }
  Model model;
  FreeCoordinates free;
  ReferenceMotion reference;
  ExternalLoads loads;
  CmcOptions options;
};

InputFile openFile(const std::string& path) {
  return {path, readFile(path)};
}

/// Hamner's model with the markers of the trial's laboratory, which the unscaled model of another
/// of its subjects carries on the same bodies.
InputFile makeDelpModel(const std::string& shared) {
  const auto read = [&](const std::string& file) {
    return readOsim(readFile(shared + "/data/" + file), file);
  };
  ModelSpec model = read("models/FullBodyModel_Hamner2010_v2_0.osim");
  model.markers = read("run/hamner2013_subject04/unscaled_generic.osim").markers;
  return {"hamner2010.osim", writeOsim(model)};
}

Prepared prepare(const std::string& shared, const InputFile& model) {
  const std::string trial = shared + "/data/run/paper_subject01/";
  TrialInput input;
  input.model = model;
  input.static_markers = openFile(trial + "static_run.trc");
  input.markers = openFile(trial + "motion_capture_run.trc");
  input.ground_reaction = openFile(trial + "grf_run.mot");
  input.mass = 72.84;
  input.height = 1.80;
  const PipelineResult result = Pipeline().run(input, {"lineage.json", kSettings}, {});
  ModelSpec spec = readOsim(result.files.at("adjusted_model.osim"), "adjusted_model.osim");
  spec.actuators.clear();
  const TimeSeries motion = toCoordinates(readTable(result.files.at("rra.mot"), "rra.mot"), spec);
  const GroundReaction reaction = readGroundReaction(
      readTable(input.ground_reaction->bytes, input.ground_reaction->name), GrfOptions());
  return {spec, motion, reaction};
}

double readProcessorClock() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double findMedian(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.at(values.size() / 2);
}

/// One simulation: what it took, and whether it followed the motion.
struct Timed {
  std::vector<double> seconds;
  CmcResult result;

  void run(const Prepared& prepared) {
    const double before = readProcessorClock();
    result = solveCmc(prepared.model, prepared.reference, prepared.loads, prepared.options);
    seconds.push_back(readProcessorClock() - before);
  }
  double findWorstError() const { return result.tracking_error.values.cwiseAbs().maxCoeff(); }
};

void muscleControlDelpAgainstRajagopal(benchmark::State& run) {
  const std::string shared = findSharedFolder();
  if (shared.empty()) {
    run.SkipWithError("the shared trials are absent");
    return;
  }
  const Prepared delp = prepare(shared, makeDelpModel(shared));
  const Prepared rajagopal = prepare(shared, openFile("models/rajagopal2016/rajagopal2016.osim"));
  Timed delp_time;
  Timed rajagopal_time;
  for (auto _ : run) {
    delp_time.run(delp);
    rajagopal_time.run(rajagopal);
  }
  const double delp_s = findMedian(delp_time.seconds);
  const double rajagopal_s = findMedian(rajagopal_time.seconds);
  run.counters["delp_s"] = delp_s;
  run.counters["rajagopal_s"] = rajagopal_s;
  run.counters["ratio"] = delp_s / rajagopal_s;
  run.counters["paper_ratio"] = kPaperRatio;
  run.counters["delp_finished"] = delp_time.result.stop == CmcStop::kFinished ? 1 : 0;
  run.counters["delp_infeasible"] = static_cast<double>(delp_time.result.infeasible_windows.size());
  run.counters["delp_worst_error"] = delp_time.findWorstError();
  run.counters["rajagopal_worst_error"] = rajagopal_time.findWorstError();
  run.counters["delp_fiber_steps"] = static_cast<double>(delp_time.result.counters.fiber_steps);
  run.counters["rajagopal_fiber_steps"] =
      static_cast<double>(rajagopal_time.result.counters.fiber_steps);
}
BENCHMARK(muscleControlDelpAgainstRajagopal)->Unit(benchmark::kMillisecond)->Iterations(5);

}  // namespace
}  // namespace gaitmill
