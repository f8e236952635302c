#pragma once

#include <string>
#include <vector>

#include "core/cmc/cmc_options.h"
#include "core/io/files.h"
#include "core/io/grf_reader.h"
#include "core/io/osim_reader.h"
#include "core/io/table_reader.h"
#include "core/math/table_filters.h"
#include "core/model/external_loads.h"
#include "core/model/free_coordinates.h"
#include "core/model/model.h"
#include "core/model/reference_motion.h"

namespace gaitmill {

/// Residuals and reserves of the two published set-ups (spec/cmc.md 1).
struct PaperActuators {
  Eigen::Vector3d residual_point;  ///< on the pelvis [m]
  double knee_reserve;             ///< optimal force [N.m]
  double ankle_reserve;
};

inline std::vector<ActuatorSpec> makePaperActuators(const PaperActuators& paper) {
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
  const char* axes[] = {"X", "Y", "Z"};
  for (int i = 0; i < 3; ++i) {
    ActuatorSpec& force = add(std::string("F") + axes[i], 10);
    force.kind = ActuatorSpec::Kind::kPoint;
    force.body = "pelvis";
    force.point = paper.residual_point;
    force.direction = Eigen::Vector3d::Unit(i);
  }
  for (int i = 0; i < 3; ++i) {
    ActuatorSpec& torque = add(std::string("M") + axes[i], 15);
    torque.kind = ActuatorSpec::Kind::kTorque;
    torque.body = "pelvis";
    torque.direction = Eigen::Vector3d::Unit(i);
  }
  for (const char* side : {"_r", "_l"}) {
    const auto reserve = [&](const char* coordinate, double optimal_force) {
      add(std::string(coordinate) + side + "_reserve", optimal_force).coordinate =
          std::string(coordinate) + side;
    };
    reserve("hip_flexion", 2.5);
    reserve("hip_adduction", 5);
    reserve("hip_rotation", 10);
    reserve("knee_angle", paper.knee_reserve);
    reserve("ankle_angle", paper.ankle_reserve);
  }
  return actuators;
}

/// What the reference CMC of a trial started from.
struct CmcTrial {
  CmcTrial(const std::string& model_file,
           const std::string& kinematics_file,
           const std::string& force_file,
           CmcOptions cmc_options)
      : model(readOsim(readFile(model_file), model_file)),
        free(model),
        reference(model, free, readKinematics(model.spec(), kinematics_file)),
        loads(model, readLoads(force_file)),
        options(std::move(cmc_options)) {}

  static TimeSeries readKinematics(const ModelSpec& spec, const std::string& file) {
    constexpr int kPadding = 60;  // rows; unfiltered, since residual reduction left it smooth
    return padOdd(toCoordinates(readTable(readFile(file), file), spec), kPadding);
  }
  static GroundReaction readLoads(const std::string& file) {
    GrfOptions as_it_is;
    as_it_is.threshold = 0;
    return readGroundReaction(readTable(readFile(file), file), as_it_is);
  }

  Model model;
  FreeCoordinates free;
  ReferenceMotion reference;
  ExternalLoads loads;
  CmcOptions options;
};

inline CmcTrial readWalkTrial(const std::string& shared) {
  CmcOptions options;
  options.start_time = 0.45;
  options.end_time = 1.80;
  options.actuators = makePaperActuators({{-0.107324, 0.0155155, 0}, 2.5, 2.5});
  for (const char* muscle : {"gaslat_r", "gasmed_r"}) {
    options.excitation_limits.push_back({muscle, {{0.5, 1}, {1.0, 1}, {1.393, 0.02}}});
  }
  return {shared + "/reference/walk/subject_adjusted.osim",
          shared + "/reference/walk/rra/pass2/kinematics_q.sto",
          shared + "/data/walk/grf_walk.mot",
          options};
}

inline CmcTrial readRunTrial(const std::string& shared) {
  CmcOptions options;
  options.start_time = 0.83;
  options.end_time = 1.546;
  options.actuators = makePaperActuators({{-0.073, -0.02525, 0}, 1, 1});
  options.equilibrate_at_default_pose = false;
  for (const char* muscle : {"gaslat_r", "gasmed_r"}) {
    options.excitation_limits.push_back({muscle, {{1.0672, 1}, {1.375, 0.02}, {1.546, 1}}});
  }
  for (const char* muscle : {"gaslat_l", "gasmed_l"}) {
    options.excitation_limits.push_back({muscle, {{1.4099, 1}, {1.7128, 0.02}, {1.881, 1}}});
  }
  return {shared + "/reference/run/subject_adjusted.osim",
          shared + "/reference/run/rra/pass3/kinematics_q.sto",
          shared + "/data/run/paper_subject01/grf_run.mot",
          options};
}

}  // namespace gaitmill
