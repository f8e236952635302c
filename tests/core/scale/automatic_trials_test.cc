// The automatic marker set on the recorded trials of ../shared and on the sample trial: not worse
// than "warn" of the checks of static pose and inverse kinematics (quality_rules.cc).

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/ik/ik_solver.h"
#include "core/intake/automatic_marker_set.h"
#include "core/pipeline/quality_rules.h"
#include "core/scale/scale_solver.h"
#include "tests/support/marker_set_files.h"
#include "tests/support/model_files.h"
#include "tests/support/shared_data.h"

namespace gaitmill {
namespace {

struct Trial {
  const char* name;
  std::vector<const char*> static_files;
  const char* movement;
  double mass;    // [kg]
  double height;  // [m]
};

std::ostream& operator<<(std::ostream& stream, const Trial& trial) {
  return stream << trial.name;
}

const Trial kTrials[] = {
    {"walk",
     {"data/walk/static_walk_1.trc", "data/walk/static_walk_2.trc"},
     "data/walk/motion_capture_walk.trc",
     85.0668,
     1.829},
    {"walk_second_pose_only",
     {"data/walk/static_walk_2.trc"},
     "data/walk/motion_capture_walk.trc",
     85.0668,
     1.829},
    {"paper_run",
     {"data/run/paper_subject01/static_run.trc"},
     "data/run/paper_subject01/motion_capture_run.trc",
     72.84,
     1.80},
    {"hamner2010",
     {"data/run/hamner2010/subject02_static.trc"},
     "data/run/hamner2010/subject02_running.trc",
     65.9,
     1.83},
};

class AutomaticTrials : public SharedDataTest, public ::testing::WithParamInterface<Trial> {
 protected:
  void SetUp() override {
    SharedDataTest::SetUp();
    if (IsSkipped()) {
      return;
    }
    for (const char* file : GetParam().static_files) {
      poses_.push_back(readMarkerFile(shared(file)));
      names_.insert(names_.end(), poses_.back().names.begin(), poses_.back().names.end());
    }
    movement_ = readMarkerFile(shared(GetParam().movement));
    names_.insert(names_.end(), movement_.names.begin(), movement_.names.end());
    std::set<std::string> seen;
    names_.erase(std::remove_if(names_.begin(),
                                names_.end(),
                                [&](const std::string& name) { return !seen.insert(name).second; }),
                 names_.end());
  }

  ScaleResult scale(const ModelSpec& model, MarkerSetSpec& set) const {
    const MarkerMapping mapping = mapMarkerNames(names_);
    set = makeAutomaticMarkerSet({mapping, poses_, movement_, model, GetParam().height, true}).set;
    ScaleOptions options;
    options.marker_set = set;
    options.subject_mass = GetParam().mass;
    return ScaleSolver(model, options).solve(poses_);
  }

  std::vector<std::string> names_;
  std::vector<MarkerTrajectories> poses_;
  MarkerTrajectories movement_;
};

void expectNotFailed(const std::string& figure, double value, const std::string& whose) {
  EXPECT_NE(makeQualityCheck(figure, value, whose).judge(), Verdict::kFail)
      << figure << " " << value << " " << whose;
}

void expectPlausible(const ScaleResult& result) {
  for (const BodyScale& body : result.factors) {
    EXPECT_GT(body.factors.minCoeff(), 0.8) << body.body;
    EXPECT_LT(body.factors.maxCoeff(), 1.3) << body.body;
  }
  for (const MeasurementResult& one : result.measurements) {
    EXPECT_NE(one.use, MeasurementUse::kRefused) << one.name;
  }
}

TEST_P(AutomaticTrials, ScaleAndFollowOnOurModel) {
  MarkerSetSpec set;
  const ScaleResult result = scale(readOwnModel(), set);
  expectPlausible(result);
  for (const PlacementResult& placement : result.placements) {
    expectNotFailed("static_pose_rms", 100 * placement.rms, "");
    expectNotFailed("static_pose_peak", 100 * placement.max_error, placement.worst_marker);
  }
  IkOptions options;
  options.tasks = set.ik;
  const Model model(result.model);
  const IkResult ik = IkSolver(model, options, movement_.names).solve(movement_);
  expectNotFailed("marker_error_rms", 100 * ik.max_rms, "");
  expectNotFailed("marker_error_peak", 100 * ik.max_error, ik.max_error_marker);
  EXPECT_EQ(ik.unconverged_frames, 0);
}

TEST_P(AutomaticTrials, ScaleTheDelpLineageToo) {
  for (const char* file : {"data/models/FullBodyModel_Hamner2010_v2_0.osim",
                           "data/models/gait2392_millard2012muscle.osim"}) {
    SCOPED_TRACE(file);
    ModelSpec model = readModelFile(shared(file));
    model.muscles.clear();
    MarkerSetSpec set;
    const ScaleResult result = scale(model, set);
    expectPlausible(result);
    expectNotFailed("static_pose_rms", 100 * result.placements[0].rms, "");
  }
}

INSTANTIATE_TEST_SUITE_P(Recorded, AutomaticTrials, ::testing::ValuesIn(kTrials));

TEST(AutomaticSampleTrial, IsFollowedToItsNoise) {
  const std::vector<MarkerTrajectories> poses = {readMarkerFile("models/sample/static.trc")};
  const MarkerTrajectories movement = readMarkerFile("models/sample/markers.trc");
  const MarkerMapping mapping = mapMarkerNames(poses[0].names);
  const ModelSpec generic = readOwnModel();
  const AutomaticMarkerSet made =
      makeAutomaticMarkerSet({mapping, poses, movement, generic, 1.76, true});
  ScaleOptions options;
  options.marker_set = made.set;
  const ScaleResult result = ScaleSolver(generic, options).solve(poses);
  expectNotFailed("static_pose_rms", 100 * result.placements[0].rms, "");
  IkOptions ik_options;
  ik_options.tasks = made.set.ik;
  const Model model(result.model);
  const IkResult ik = IkSolver(model, ik_options, movement.names).solve(movement);
  expectNotFailed("marker_error_rms", 100 * ik.max_rms, "");
  expectNotFailed("marker_error_peak", 100 * ik.max_error, ik.max_error_marker);
}

}  // namespace
}  // namespace gaitmill
