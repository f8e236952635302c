// Agreement with OpenSim's scaled subjects of both published trials.

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/io/table_reader.h"
#include "core/scale/marker_placement.h"
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
  double mass;  // [kg]
  const char* reference;
};

const Trial kWalk{"paper_walk",
                  {"data/walk/static_walk_1.trc", "data/walk/static_walk_2.trc"},
                  85.0668,
                  "reference/walk/scale/subject_scaled.osim"};
const Trial kRun{"paper_run",
                 {"data/run/paper_subject01/static_run.trc"},
                 72.84,
                 "reference/run/scale/subject_scaled.osim"};

class ScaleReferenceTest : public SharedDataTest {
 protected:
  ScaleResult scale(const Trial& trial) const {
    ScaleOptions options;
    options.marker_set = readShippedMarkerSet(trial.marker_set);
    options.subject_mass = trial.mass;
    std::vector<MarkerTrajectories> poses;
    for (const char* file : trial.static_files) {
      poses.push_back(readMarkerFile(shared(file)));
    }
    return ScaleSolver(readModelFile(shared("data/models/Rajagopal2016.osim")), options)
        .solve(poses);
  }
  ModelSpec readReference(const Trial& trial) const {
    return readModelFile(shared(trial.reference));
  }
};

double calcRelative(double value, double reference) {
  return std::abs(value - reference) / std::max(std::abs(reference), 1e-12);
}

void expectFactors(const ScaleResult& result,
                   const std::map<std::string, Eigen::Vector3d>& expected) {
  for (const BodyScale& scale : result.factors) {
    const auto found = expected.find(scale.body.substr(0, scale.body.find_last_of('_')));
    const Eigen::Vector3d factors =
        found == expected.end() ? Eigen::Vector3d::Ones() : found->second;
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(scale.factors[axis], factors[axis], tol(1e-6)) << scale.body << " " << axis;
    }
  }
}

// Published scale sets (spec/scale.md 1 and 6.1), printed to ten decimals.
TEST_F(ScaleReferenceTest, WalkFactorsAreThePublishedOnes) {
  const Eigen::Vector3d foot(1.1431554757, 1.6607608927, 1.4975279291);
  expectFactors(scale(kWalk),
                {{"pelvis", {1.2446319356, 1.0016674577, 1.1973582015}},
                 {"talus", foot},
                 {"calcn", foot},
                 {"toes", foot},
                 {"femur", Eigen::Vector3d::Constant(0.958)},
                 {"patella", Eigen::Vector3d::Constant(0.958)},
                 {"tibia", Eigen::Vector3d::Constant(1.149)},
                 {"torso", {1.21013, 1.17781, 1.21013}},
                 {"humerus", Eigen::Vector3d::Constant(1.09817)},
                 {"ulna", Eigen::Vector3d::Constant(1.01397)},
                 {"radius", Eigen::Vector3d::Constant(1.01397)}});
}

// Published as well, but for the shank: the distributed set-up gives 1.0774128840 (so does OpenSim
// 4.6, whose scaled subject this factor reproduces), its scale set states 1.0727245170.
TEST_F(ScaleReferenceTest, RunFactorsAreThePublishedOnes) {
  const Eigen::Vector3d foot = Eigen::Vector3d::Constant(1.1180803991);
  const Eigen::Vector3d forearm = Eigen::Vector3d::Constant(1.1134716192);
  expectFactors(scale(kRun),
                {{"pelvis", {0.9886967295, 1.0194672130, 1.1264506254}},
                 {"talus", foot},
                 {"calcn", foot},
                 {"toes", foot},
                 {"femur", Eigen::Vector3d::Constant(1.1089045060)},
                 {"tibia", Eigen::Vector3d::Constant(1.0774128840)},
                 {"torso", Eigen::Vector3d::Constant(0.9914853984)},
                 {"humerus", Eigen::Vector3d::Constant(1.1058200251)},
                 {"ulna", forearm},
                 {"radius", forearm},
                 {"hand", forearm}});
}

/// sum w |x - mean m|^2 [m^2] at a pose, over the whole recording.
double calcWeightedError(const Model& model,
                         const TimeSeries& pose,
                         const FitTasks& tasks,
                         const MarkerTrajectories& trial) {
  Eigen::VectorXd q = model.defaultPose();
  for (int c = 0; c < pose.columnCount(); ++c) {
    q[model.getCoordinate(pose.labels[static_cast<std::size_t>(c)]).value()] = pose.values(0, c);
  }
  ModelState state(model);
  state.setPose(q);
  double error = 0;
  for (const MarkerWeight& task : tasks.markers) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (int frame = 0; frame < trial.frameCount(); ++frame) {
      mean += trial.position(frame, *trial.findMarker(task.marker)) / trial.frameCount();
    }
    const MarkerSpec& marker =
        model.spec().markers[static_cast<std::size_t>(model.spec().findMarker(task.marker))];
    const Eigen::Vector3d p_GM = state.pose(model.getBody(marker.body)) * marker.location;
    error += task.weight * (p_GM - mean).squaredNorm();
  }
  return error;
}

void expectBodies(const ModelSpec& model, const ModelSpec& reference) {
  for (const BodySpec& expected : reference.bodies) {
    const BodySpec& body = model.bodies[static_cast<std::size_t>(model.findBody(expected.name))];
    EXPECT_NEAR(body.mass, expected.mass, tol(1e-10)) << body.name;
    EXPECT_NEAR((body.mass_center - expected.mass_center).norm(), 0, tol(1e-12)) << body.name;
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(body.inertia[i], expected.inertia[i], tol(1e-12)) << body.name << " " << i;
    }
    for (std::size_t i = 0; i < expected.wrap_objects.size(); ++i) {
      const WrapObjectSpec& wrap = expected.wrap_objects[i];
      EXPECT_NEAR(body.wrap_objects[i].radius, wrap.radius, tol(1e-12)) << wrap.name;
      EXPECT_NEAR(body.wrap_objects[i].length, wrap.length, tol(1e-12)) << wrap.name;
      EXPECT_NEAR((body.wrap_objects[i].translation - wrap.translation).norm(), 0, tol(1e-12))
          << wrap.name;
    }
  }
}

void expectJoints(const ModelSpec& model, const ModelSpec& reference) {
  for (std::size_t j = 0; j < reference.joints.size(); ++j) {
    const JointSpec& expected = reference.joints[j];
    const JointSpec& joint = model.joints[j];
    ASSERT_EQ(joint.name, expected.name);
    EXPECT_NEAR((joint.parent.translation - expected.parent.translation).norm(), 0, tol(1e-12));
    EXPECT_NEAR((joint.child.translation - expected.child.translation).norm(), 0, tol(1e-12));
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(joint.axes[i].function.scale * joint.axes[i].function.y.back(),
                  expected.axes[i].function.scale * expected.axes[i].function.y.back(),
                  tol(1e-12))
          << joint.name << " axis " << i;
    }
  }
}

/// Largest relative difference of the two lengths of each muscle; path points exactly.
std::map<std::string, double> compareMuscles(const ModelSpec& model, const ModelSpec& reference) {
  std::map<std::string, double> differences;
  for (const MuscleSpec& expected : reference.muscles) {
    const MuscleSpec& muscle =
        model.muscles[static_cast<std::size_t>(model.findMuscle(expected.name))];
    for (std::size_t p = 0; p < expected.path.size(); ++p) {
      EXPECT_NEAR((muscle.path[p].location - expected.path[p].location).norm(), 0, tol(1e-12));
    }
    EXPECT_EQ(muscle.max_isometric_force, expected.max_isometric_force);
    EXPECT_EQ(muscle.pennation_at_optimal, expected.pennation_at_optimal);
    differences[expected.name] =
        std::max(calcRelative(muscle.optimal_fiber_length, expected.optimal_fiber_length),
                 calcRelative(muscle.tendon_slack_length, expected.tendon_slack_length));
  }
  return differences;
}

/// Largest |exact - OpenSim 4.6| of the path length [m] over random poses (spec/path.md 8), of the
/// muscles whose wrapped path OpenSim only approximates. All others agree to round-off.
const std::map<std::string, double> kWrapDifferences = {{"addbrev", 2.0e-4},
                                                        {"addlong", 3.7e-4},
                                                        {"addmagDist", 3.3e-4},
                                                        {"addmagIsch", 2.8e-4},
                                                        {"addmagMid", 3.9e-4},
                                                        {"addmagProx", 1.2e-4},
                                                        {"gaslat", 2.6e-3},
                                                        {"gasmed", 6.2e-3}};

/// Bound on the relative difference of a muscle's scaled lengths. Measured: adductors up to 9.3e-5
/// (near-geodesic of one cylinder), gastrocnemii 2.6e-3 in walking and 4.3e-4 in running (stale
/// wrap points of two cylinders, which the default pose with its straight knee has both), psoas and
/// gracilis up to 9e-6, everything else below 1e-6.
double findMuscleBound(const MuscleSpec& generic) {
  const auto found = kWrapDifferences.find(generic.name.substr(0, generic.name.size() - 2));
  if (found == kWrapDifferences.end()) {
    return tol(1e-5);
  }
  const double path_length = generic.tendon_slack_length + generic.optimal_fiber_length;
  return tol(1.5 * found->second / path_length);
}

class ScaledSubject : public ScaleReferenceTest, public ::testing::WithParamInterface<Trial> {};

TEST_P(ScaledSubject, BodiesAndJointsAreThoseOfOpenSim) {
  const ModelSpec model = scale(GetParam()).model;
  const ModelSpec reference = readReference(GetParam());
  expectBodies(model, reference);
  expectJoints(model, reference);
}

TEST_P(ScaledSubject, MuscleLengthsAreThoseOfOpenSim) {
  const ModelSpec generic = readModelFile(shared("data/models/Rajagopal2016.osim"));
  const ModelSpec model = scale(GetParam()).model;
  const auto differences = compareMuscles(model, readReference(GetParam()));
  ASSERT_EQ(differences.size(), 80U);
  for (const MuscleSpec& muscle : generic.muscles) {
    EXPECT_LE(differences.at(muscle.name), findMuscleBound(muscle)) << muscle.name;
  }
}

TEST_P(ScaledSubject, MassIsTheSubjects) {
  const ScaleResult result = scale(GetParam());
  EXPECT_NEAR(result.mass, GetParam().mass, tol(1e-12));
  EXPECT_NEAR(result.model.calcTotalMass(), GetParam().mass, tol(1e-12));
}

TEST_P(ScaledSubject, MarkersAreThoseOfTheStaticFileAndFixedOnesOnlyScale) {
  const ScaleResult result = scale(GetParam());
  const ModelSpec reference = readReference(GetParam());
  ASSERT_EQ(result.model.markers.size(), reference.markers.size());
  for (const MarkerSpec& expected : reference.markers) {
    const int index = result.model.findMarker(expected.name);
    ASSERT_GE(index, 0) << expected.name;
    const MarkerSpec& marker = result.model.markers[static_cast<std::size_t>(index)];
    EXPECT_EQ(marker.body, expected.body);
    if (expected.fixed) {
      EXPECT_NEAR((marker.location - expected.location).norm(), 0, tol(1e-12)) << marker.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(BothTrials,
                         ScaledSubject,
                         ::testing::Values(kWalk, kRun),
                         [](const auto& test) { return std::string(test.param.marker_set); });

// OpenSim stops its static fit at 1e-4; the minimum lies 12 % lower and up to 3 degrees away, so
// that movable markers end up to 11 mm from its own.
TEST_F(ScaleReferenceTest, StaticPoseMeetsTheMarkersBetterThanOpenSims) {
  ScaleOptions options;
  options.marker_set = readShippedMarkerSet(kRun.marker_set);
  options.marker_set.placements.clear();
  options.subject_mass = kRun.mass;
  const MarkerTrajectories trial = readMarkerFile(shared(kRun.static_files[0]));
  const ModelSpec stretched =
      ScaleSolver(readModelFile(shared("data/models/Rajagopal2016.osim")), options)
          .solve({trial})
          .model;
  const PlacementSpec placement = readShippedMarkerSet(kRun.marker_set).placements.at(0);

  const std::string path = shared("reference/run/scale/static_pose.mot");
  std::vector<std::string> ignored;
  const TimeSeries pose = toCoordinates(readTable(readFile(path), path), stretched, &ignored);
  ModelSpec placed = stretched;
  const PlacementResult result = placeMarkers(placement, trial, {}, placed);
  const Model model(stretched);
  const double ours = calcWeightedError(model, result.pose, placement.tasks, trial);
  const double theirs = calcWeightedError(model, pose, placement.tasks, trial);
  EXPECT_LT(ours, theirs);
  EXPECT_NEAR(theirs, 0.84315638, tol(1e-6));  // pose printed to 1e-8 rad
}

}  // namespace
}  // namespace gaitmill
