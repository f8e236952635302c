#pragma once

#include <cmath>
#include <vector>

#include "core/model/external_loads.h"
#include "core/model/model.h"
#include "core/model/reference_motion.h"
#include "core/rra/mass_adjustment.h"
#include "core/rra/rra_solver.h"
#include "tests/support/model_files.h"
#include "tests/support/paper_rra.h"

namespace gaitmill {

/// A person who sways with every joint for two seconds over one foot, with the ground reaction that
/// Newton and Euler ask of it: without noise, so that a solver can find back what was changed.
struct SwayingTrial {
  ModelSpec spec = readOwnModel();  ///< the person
  TimeSeries coordinates;
  GroundReaction reaction;

  SwayingTrial() {
    const Model model(spec);
    std::vector<double> time;
    for (int i = 0; i <= 200; ++i) time.push_back(0.01 * i);
    coordinates = makeTimeSeries("sway", model.coordinateNames(), time);
    for (int row = 0; row < coordinates.rowCount(); ++row) {
      const double t = time[static_cast<std::size_t>(row)];
      for (int c = 0; c < coordinates.columnCount(); ++c) {
        // Amplitude 2 deg or 2 cm; every coordinate at its own pace and phase.
        coordinates.values(row, c) =
            model.defaultPose()(c) + 0.035 * std::sin((2 + 0.11 * c) * t + 0.7 * c);
      }
    }
    reaction.time = time;
    ExternalForce foot{"right", "calcn_r", {}, {}, {}};
    foot.force = foot.point = foot.torque = Eigen::Matrix3Xd::Zero(3, 201);
    reaction.forces = {foot};
    bearWhatTheMotionNeeds(model);
  }

  RraOptions makeOptions() const {
    RraOptions options = makePaperWalkRra();
    options.strategy = RraStrategy::kAutopilot;
    options.passes.resize(1);
    options.passes[0].start_time = 0.5;
    options.passes[0].end_time = 0.8;
    options.inertia_scaling = InertiaScaling::kWithMass;
    options.actuators = makePaperRraActuators({{-0.07, 0, 0}, 1});
    return options;
  }

  /// The person as a model that is `mass` kg too heavy, with the trunk's mass center `ahead` and
  /// `right` of its place.
  ModelSpec misjudge(double mass, double ahead, double right) const {
    ModelSpec wrong = spec;
    setTotalMass(wrong, spec.calcTotalMass() + mass, InertiaScaling::kWithMass);
    BodySpec& torso = wrong.bodies[static_cast<std::size_t>(wrong.findBody("torso"))];
    torso.mass_center += Eigen::Vector3d(ahead, 0, right);
    return wrong;
  }

 private:
  // What the residual actuators would have to give is put under the foot, at the point where they
  // act.
  void bearWhatTheMotionNeeds(const Model& model) {
    const FreeCoordinates free(model);
    const RraOptions options = makeOptions();
    const ReferenceMotion reference(model, free, prepareDesiredMotion(coordinates, options));
    RraPassOptions whole = options.passes[0];
    whole.start_time = 0;
    whole.end_time = 2;
    const TimeSeries residuals =
        calcDesiredResiduals(spec, reference, ExternalLoads(model, reaction), options, whole);
    ModelState state(model);
    Eigen::VectorXd q_free(free.count()), q(model.coordinateCount());
    for (int row = 0; row < residuals.rowCount(); ++row) {
      reference.calcPose(residuals.time[static_cast<std::size_t>(row)], q_free);
      free.expandPose(q_free, q);
      state.setPose(q);
      const auto pelvis = state.pose(model.getBody("pelvis"));
      reaction.forces[0].force.col(row) = residuals.values.row(row).head<3>().transpose();
      reaction.forces[0].torque.col(row) = residuals.values.row(row).tail<3>().transpose();
      reaction.forces[0].point.col(row) = pelvis.p + pelvis.R * options.actuators[0].point;
    }
  }
};

}  // namespace gaitmill
