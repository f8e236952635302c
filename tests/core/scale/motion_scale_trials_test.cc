// The bar of scaling without a static trial: over the motion, the model fitted to it meets its
// markers at least as well as the model that a static trial gave, on every trial there is.

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/ik/ik_solver.h"
#include "core/scale/motion_scale.h"
#include "core/scale/scale_solver.h"
#include "tests/support/marker_set_files.h"
#include "tests/support/model_files.h"
#include "tests/support/shared_data.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

struct Trial {
  const char* marker_set;
  std::vector<const char*> static_files;
  const char* motion;
  double mass;    // [kg]
  double height;  // [m]
};

const Trial kWalk{"paper_walk",
                  {"data/walk/static_walk_1.trc", "data/walk/static_walk_2.trc"},
                  "data/walk/motion_capture_walk.trc",
                  85.0668,
                  1.829};
const Trial kRun{"paper_run",
                 {"data/run/paper_subject01/static_run.trc"},
                 "data/run/paper_subject01/motion_capture_run.trc",
                 72.84,
                 1.80};
const Trial kRunOwnSet{"rajagopal2016",
                       {"data/run/paper_subject01/static_run.trc"},
                       "data/run/paper_subject01/motion_capture_run.trc",
                       72.84,
                       1.80};
const Trial kSubject04{
    "rajagopal2016", {}, "data/run/hamner2013_subject04/run400/markers.trc", 80.47, 1.772};

class MotionScaleTrialsTest : public SharedDataTest {
 protected:
  ScaleOptions makeOptions(const Trial& trial) const {
    ScaleOptions options;
    options.marker_set = readShippedMarkerSet(trial.marker_set);
    options.subject_mass = trial.mass;
    return options;
  }
  ScaleResult scaleByStaticTrial(const Trial& trial) const {
    std::vector<MarkerTrajectories> poses;
    for (const char* file : trial.static_files) {
      poses.push_back(readMarkerFile(shared(file)));
    }
    return ScaleSolver(readOwnModel(), makeOptions(trial)).solve(poses);
  }
  ScaleResult scaleByMotion(const Trial& trial) const {
    MotionScaleOptions motion;
    motion.subject_height = trial.height;
    return MotionScaleSolver(readOwnModel(), makeOptions(trial), motion)
        .solve(readMarkerFile(shared(trial.motion)));
  }
  IkResult pose(const Trial& trial, const ScaleResult& scale) const {
    IkOptions options;
    options.tasks = readShippedMarkerSet(trial.marker_set).ik;
    const MarkerTrajectories markers = readMarkerFile(shared(trial.motion));
    const Model model(scale.model);
    return IkSolver(model, options, markers.names).solve(markers);
  }
};

class MotionScaleBar : public MotionScaleTrialsTest, public ::testing::WithParamInterface<Trial> {};

// The bar. Mean over the frames of the RMS distance of all weighted markers, as IK reports it.
TEST_P(MotionScaleBar, MeetsTheMarkersNoWorseThanTheStaticTrialsModel) {
  const ScaleResult by_motion = scaleByMotion(GetParam());
  ASSERT_TRUE(by_motion.motion.has_value());
  EXPECT_TRUE(by_motion.motion->converged);
  const IkResult ik = pose(GetParam(), by_motion);
  const IkResult ik_static = pose(GetParam(), scaleByStaticTrial(GetParam()));
  EXPECT_LE(ik.mean_rms, ik_static.mean_rms);
  EXPECT_LE(ik.max_rms, ik_static.max_rms);
  // What scaling says of the motion is what inverse kinematics finds.
  EXPECT_NEAR(by_motion.motion->motion_rms, ik.mean_rms, tol(1e-6));
  EXPECT_LT(by_motion.motion->motion_rms, by_motion.motion->motion_rms_before);
}

// Lengths of the leg agree with those that static trials with joint centres or medial markers gave,
// but for the walker, whose published factors were set by hand (thigh 4 % too short and shank 7 %
// too long for the measured joint centres).
TEST_P(MotionScaleBar, LegsAreAsLongAsTheStaticTrialSays) {
  const ScaleResult by_motion = scaleByMotion(GetParam());
  const ScaleResult by_static = scaleByStaticTrial(GetParam());
  const auto length = [](const ScaleResult& result) {
    double sum = 0;
    for (const BodyScale& body : result.factors) {
      sum += body.body == "femur_r" ? 0.41 * body.factors.y() : 0.0;  // [m] of the generic model
      sum += body.body == "tibia_r" ? 0.40 * body.factors.y() : 0.0;
    }
    return sum;
  };
  EXPECT_NEAR(length(by_motion) / length(by_static), 1.0, tol(0.03));
}

INSTANTIATE_TEST_SUITE_P(Trials,
                         MotionScaleBar,
                         ::testing::Values(kWalk, kRun, kRunOwnSet),
                         [](const auto& one) {
                           return std::string(one.param.marker_set) + std::to_string(one.index);
                         });

// Markers, mass and height are all there is of this runner. Guidance of the field for running: mean
// RMS below 2 cm, no marker beyond 4 cm (spec/ik.md 3).
TEST_F(MotionScaleTrialsTest, ARunnerWithoutAStaticTrialIsMetWithinGuidance) {
  const ScaleResult scale = scaleByMotion(kSubject04);
  EXPECT_TRUE(scale.motion->converged);
  const IkResult ik = pose(kSubject04, scale);
  EXPECT_LT(ik.mean_rms, tol(0.012));
  EXPECT_LT(ik.max_error, tol(0.04));
  for (const SizeEstimate& size : scale.motion->sizes) {
    EXPECT_LT(std::abs(size.deviations), tol(2.0)) << size.name;
    EXPECT_FALSE(size.at_bound) << size.name;
  }
}

}  // namespace
}  // namespace gaitmill
