#include "core/scale/motion_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/model/free_coordinates.h"
#include "core/scale/apply_scale.h"
#include "core/scale/motion_frames.h"
#include "core/scale/stretched_markers.h"
#include "tests/support/marker_set_files.h"
#include "tests/support/model_files.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr double kHeight = 1.785;  // [m], 1.05 of the generic model's
constexpr int kFrames = 80;

/// A person whose sizes, markers and motion are known.
class KnownSubject {
 public:
  KnownSubject() : generic_(readOwnModel()), set_(readShippedMarkerSet("rajagopal2016")) {
    generic_ = makeKinematicModel(generic_);
    groups_ = makeScaleGroups(generic_);
    std::uniform_real_distribution<double> uniform(-1, 1);
    sizes_.resize(static_cast<Eigen::Index>(groups_.size()));
    for (double& size : sizes_) {
      size = 1.05 * (1 + 0.05 * uniform(random_));
    }
    subject_ = applyScaleFactors(
        generic_, calcBodyScales(generic_, groups_, sizes_), MassDistribution::kPreserved);
    std::normal_distribution<double> normal(0, 1);
    for (MarkerSpec& marker : subject_.markers) {
      const bool tracking =
          marker.name.find("TH") == 1 || marker.name.find("TB") == 1 || marker.name.find("UA") == 1;
      const double spread = tracking ? 0.03 : 0.01;  // [m]
      marker.location +=
          spread * Eigen::Vector3d(normal(random_), normal(random_), normal(random_));
    }
  }

  /// @param noise  standard deviation [m]
  MarkerTrajectories move(double noise) {
    const Model model(subject_);
    const FreeCoordinates free(model);
    ModelState state(model);
    MarkerTrajectories trial;
    for (const MarkerWeight& task : set_.ik.markers) {
      trial.names.push_back(task.marker);
    }
    trial.positions.resize(kFrames, static_cast<Eigen::Index>(3 * trial.names.size()));
    std::normal_distribution<double> normal(0, noise);
    for (int frame = 0; frame < kFrames; ++frame) {
      trial.time.push_back(0.02 * frame);
      Eigen::VectorXd q = model.defaultPose();
      for (int c = 0; c < model.coordinateCount(); ++c) {
        const std::string& name = model.coordinateNames()[static_cast<std::size_t>(c)];
        q[c] = calcCoordinate(name, c, 0.02 * frame, q[c]);
      }
      free.conformPose(q);
      state.setPose(q);
      for (std::size_t m = 0; m < trial.names.size(); ++m) {
        const MarkerSpec& marker =
            subject_.markers[static_cast<std::size_t>(subject_.findMarker(trial.names[m]))];
        const Eigen::Vector3d p_GM = state.pose(model.getBody(marker.body)) * marker.location;
        for (int axis = 0; axis < 3; ++axis) {
          trial.positions(frame, static_cast<Eigen::Index>(3 * m) + axis) =
              p_GM[axis] + (noise > 0 ? normal(random_) : 0.0);
        }
      }
    }
    return trial;
  }

  ScaleOptions makeOptions() const {
    ScaleOptions options;
    options.marker_set = set_;
    options.subject_mass = 75;
    return options;
  }

  const ModelSpec& generic() const { return generic_; }
  const ModelSpec& subject() const { return subject_; }
  double size(const std::string& name) const {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      if (groups_[g].name == name) {
        return sizes_[static_cast<Eigen::Index>(g)];
      }
    }
    return std::numeric_limits<double>::quiet_NaN();
  }

 private:
  /// Middle and amplitude [deg] by the stem of the name, each side and coordinate in a phase of its
  /// own: every joint turns about every axis.
  static double calcCoordinate(const std::string& name, int c, double time, double rest) {
    struct Swing {
      double middle, amplitude;
    };
    static const std::map<std::string, Swing> swings = {{"pelvis_tilt", {-5, 8}},
                                                        {"pelvis_list", {0, 6}},
                                                        {"pelvis_rotation", {0, 10}},
                                                        {"hip_flexion", {15, 35}},
                                                        {"hip_adduction", {-3, 10}},
                                                        {"hip_rotation", {0, 12}},
                                                        {"knee_angle", {45, 35}},
                                                        {"ankle_angle", {0, 18}},
                                                        {"lumbar_extension", {-5, 12}},
                                                        {"lumbar_bending", {0, 12}},
                                                        {"lumbar_rotation", {0, 15}},
                                                        {"arm_flex", {-10, 35}},
                                                        {"arm_add", {-25, 15}},
                                                        {"arm_rot", {0, 25}},
                                                        {"elbow_flex", {70, 40}},
                                                        {"pro_sup", {45, 25}}};
    const std::size_t side = name.size() - 2;
    const std::string stem = name[side] == '_' && name != "pelvis_tx" ? name.substr(0, side) : name;
    if (name == "pelvis_tx") {
      return 1.2 * time;
    }
    const auto found = swings.find(stem);
    if (found == swings.end()) {
      return rest;
    }
    const double phase = 2 * kPi * (time / 1.1 + 0.37 * c);
    return (found->second.middle + found->second.amplitude * std::sin(phase)) * kPi / 180;
  }

  std::mt19937 random_{2016};
  ModelSpec generic_;
  MarkerSetSpec set_;
  std::vector<ScaleGroup> groups_;
  Eigen::VectorXd sizes_;
  ModelSpec subject_;
};

MotionScaleOptions makeMotionOptions() {
  MotionScaleOptions options;
  options.subject_height = kHeight;
  return options;
}

/// Sizes that the motion of joint centres shows, whatever the markers' places: lengths between two
/// joints, and the widths between hips and between shoulders. The others are known no better than
/// the places of a few landmarks: one centimetre on twenty. (Depth and height of the pelvis: its
/// axes turn with its markers, so that only their common length shows.)
bool showsInJointCenters(const std::string& size) {
  const std::vector<std::string> shown = {
      "femur", "tibia", "humerus", "pelvis_z", "torso_y", "torso_z"};
  return std::find(shown.begin(), shown.end(), size) != shown.end();
}

// Trust in the markers of 0.1 mm, so that beliefs about sizes and places fade.
TEST(MotionScale, ExactMarkersGiveTheSizesBack) {
  KnownSubject known;
  MotionScaleOptions options = makeMotionOptions();
  options.marker_deviation = 1e-4;
  const ScaleResult result =
      MotionScaleSolver(known.generic(), known.makeOptions(), options).solve(known.move(0));
  EXPECT_TRUE(result.motion->converged);
  EXPECT_LT(result.motion->frames_rms, tol(1e-4));
  EXPECT_LT(result.motion->motion_rms, tol(1e-4));
  for (const SizeEstimate& size : result.motion->sizes) {
    const double allowed = showsInJointCenters(size.name) ? 1e-4 : 0.05;
    EXPECT_NEAR(size.factor / known.size(size.name), 1, tol(allowed)) << size.name;
  }
}

// 2 mm of noise and the usual trust in markers (1 cm, for the skin): sizes of up to 5 % from the
// expected ones come back to 2 % in the legs, whose joints turn far, and to 5 % elsewhere.
TEST(MotionScale, NoiseOfTwoMillimetresKeepsTheSizesInBounds) {
  KnownSubject known;
  const ScaleResult result =
      MotionScaleSolver(known.generic(), known.makeOptions(), makeMotionOptions())
          .solve(known.move(0.002));
  EXPECT_TRUE(result.motion->converged);
  EXPECT_LT(result.motion->motion_rms, tol(0.006));
  for (const SizeEstimate& size : result.motion->sizes) {
    const bool leg = size.name == "femur" || size.name == "tibia" || size.name == "pelvis_z";
    EXPECT_NEAR(size.factor / known.size(size.name), 1, tol(leg ? 0.02 : 0.05)) << size.name;
  }
}

TEST(MotionScale, TheSameInputGivesTheSameBits) {
  KnownSubject known;
  const MarkerTrajectories trial = known.move(0.002);
  const MotionScaleSolver solver(known.generic(), known.makeOptions(), makeMotionOptions());
  const ScaleResult first = solver.solve(trial);
  const ScaleResult second = solver.solve(trial);
  for (std::size_t b = 0; b < first.factors.size(); ++b) {
    EXPECT_EQ(first.factors[b].factors, second.factors[b].factors);
  }
  for (std::size_t m = 0; m < first.model.markers.size(); ++m) {
    EXPECT_EQ(first.model.markers[m].location, second.model.markers[m].location);
  }
}

// Height alone decides where markers do not: without arms' markers the arms have the expected size.
TEST(MotionScale, WhatNoMarkerSeesFollowsTheHeight) {
  KnownSubject known;
  ScaleOptions options = known.makeOptions();
  std::vector<MarkerWeight> kept;
  for (const MarkerWeight& task : options.marker_set.ik.markers) {
    const bool arm =
        task.marker.find("UA") == 1 || task.marker.find("EL") == 2 || task.marker.find("FA") == 1;
    if (!arm) {
      kept.push_back(task);
    }
  }
  options.marker_set.ik.markers = kept;
  const ScaleResult result =
      MotionScaleSolver(known.generic(), options, makeMotionOptions()).solve(known.move(0));
  for (const SizeEstimate& size : result.motion->sizes) {
    if (size.name == "humerus" || size.name == "forearm") {
      EXPECT_NEAR(size.factor, kHeight / 1.70, tol(1e-6)) << size.name;
    }
  }
}

// A set may say how well it knows a marker's place: told that it knows all to 0.1 mm, the fit
// leaves them there.
TEST(MotionScale, PlacesThatTheSetIsSureOfStay) {
  KnownSubject known;
  ScaleOptions options = known.makeOptions();
  for (const MarkerWeight& task : options.marker_set.ik.markers) {
    options.marker_set.place_deviations[task.marker] = 1e-4;
  }
  const ScaleResult result =
      MotionScaleSolver(known.generic(), options, makeMotionOptions()).solve(known.move(0));
  for (const OffsetEstimate& offset : result.motion->offsets) {
    EXPECT_LT(offset.distance, tol(1e-3)) << offset.marker;
  }
}

TEST(MotionScale, ASubjectOfNoHeightIsRefused) {
  KnownSubject known;
  try {
    MotionScaleSolver(known.generic(), known.makeOptions(), {});
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInputValue);
    EXPECT_EQ(error.where().field, "height");
  }
}

TEST(MotionScale, StopsWhenAsked) {
  KnownSubject known;
  const MotionScaleSolver solver(known.generic(), known.makeOptions(), makeMotionOptions());
  const MarkerTrajectories trial = known.move(0.002);
  for (const double at : {0.05, 0.2, 0.9}) {
    double reached = 0;
    try {
      solver.solve(trial, [&](double fraction) {
        reached = std::max(reached, fraction);
        return fraction < at;
      });
      ADD_FAILURE() << "not cancelled at " << at;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kCancelled);
      EXPECT_LT(reached, 1.0);
    }
  }
}

/// Ten frames of two markers; the second is missing in frames 4 and 5.
MarkerTrajectories makeGappyTrial() {
  MarkerTrajectories trial;
  trial.names = {"A", "B"};
  trial.positions = RowMatrix::Zero(10, 6);
  for (int frame = 0; frame < 10; ++frame) {
    trial.time.push_back(0.1 * frame);
  }
  trial.positions.block(4, 3, 2, 3).setConstant(std::numeric_limits<double>::quiet_NaN());
  return trial;
}

TEST(MotionFrames, SpreadOverTheRangeAndAvoidGaps) {
  const MarkerTrajectories trial = makeGappyTrial();
  EXPECT_EQ(chooseFrames(trial, {"A", "B"}, {}, 2), (std::vector<int>{2, 7}));
  EXPECT_EQ(chooseFrames(trial, {"A", "B"}, {}, 1), (std::vector<int>{3}));
  EXPECT_EQ(chooseFrames(trial, {"A"}, {}, 1), (std::vector<int>{4}));
  EXPECT_EQ(chooseFrames(trial, {"A", "B"}, {0.15, 0.35}, 5), (std::vector<int>{2, 3}));
}

TEST(MotionFrames, PartsThatShowTooLittleAreLeftOut) {
  const MarkerTrajectories trial = makeGappyTrial();
  EXPECT_EQ(chooseFrames(trial, {"B"}, {}, 5), (std::vector<int>{0, 2, 6, 8}));
}

TEST(MotionFrames, ARangeWithoutFramesAndMarkersWithoutSightAreErrors) {
  MarkerTrajectories trial = makeGappyTrial();
  EXPECT_THROW(chooseFrames(trial, {"A"}, {2.0, 3.0}, 5), Error);
  EXPECT_THROW(chooseFrames(trial, {"C"}, {}, 5), Error);
  trial.positions.setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(chooseFrames(trial, {"A"}, {}, 5), Error);
}

TEST(ScaleGroups, EveryBodyIsInOneSegmentAndSidesShareIt) {
  const ModelSpec model = makeKinematicModel(readOwnModel());
  const std::vector<ScaleGroup> groups = makeScaleGroups(model);
  EXPECT_EQ(groups.size(), 11U);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(11);
  for (const BodyScale& body : calcBodyScales(model, groups, ones)) {
    EXPECT_EQ(body.factors, Eigen::Vector3d::Ones()) << body.body;
  }
  for (const ScaleGroup& group : groups) {
    if (group.name == "femur") {
      std::vector<std::string> bodies;
      for (const BodyScale& share : group.shares) {
        bodies.push_back(share.body);
      }
      EXPECT_EQ(bodies, (std::vector<std::string>{"femur_r", "patella_r", "femur_l", "patella_l"}));
    }
  }
}

TEST(ScaleGroups, ABodyOfAnotherNameIsASegmentOfItsOwn) {
  ModelSpec model;
  model.bodies.resize(3);
  model.bodies[0].name = "head";
  model.bodies[1].name = "wing_r";
  model.bodies[2].name = "wing_l";
  const std::vector<ScaleGroup> groups = makeScaleGroups(model);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].name, "head");
  EXPECT_EQ(groups[1].name, "wing");
  EXPECT_EQ(groups[1].shares.size(), 2U);
  EXPECT_TRUE(makeSizePairs(groups).empty());
}

}  // namespace
}  // namespace gaitmill
