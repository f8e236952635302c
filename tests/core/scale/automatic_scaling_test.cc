// Subjects made from the generic model, whose sizes the automatic marker set must find again.

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/intake/automatic_marker_set.h"
#include "core/intake/landmarks.h"
#include "core/model/free_coordinates.h"
#include "core/model/model.h"
#include "core/scale/apply_scale.h"
#include "core/scale/scale_solver.h"
#include "tests/support/model_files.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

using Eigen::Vector3d;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// Rounds of scaling and fitting stop at changes of 1e-4; what is left is a few times that.
constexpr double kRecovery = 1e-3;

const std::vector<std::string> kMedial = {"RMFC", "LMFC", "RMMAL", "LMMAL", "RMEL", "LMEL"};
const std::vector<std::string> kArms = {
    "RLEL", "LLEL", "RMEL", "LMEL", "RFAradius", "RFAulna", "LFAradius", "LFAulna"};

/// A full-body set without functional centres.
std::vector<std::string> listMarkers() {
  return {"C7",   "CLAV", "RACR",      "LACR",    "RASI",      "LASI",   "RPSI",  "LPSI",
          "RLFC", "LLFC", "RMFC",      "LMFC",    "RLMAL",     "LLMAL",  "RMMAL", "LMMAL",
          "RCAL", "LCAL", "RTOE",      "LTOE",    "RMT5",      "LMT5",   "RLEL",  "LLEL",
          "RMEL", "LMEL", "RFAradius", "RFAulna", "LFAradius", "LFAulna"};
}

std::vector<std::string> without(const std::vector<std::string>& names,
                                 const std::vector<std::string>& left_out) {
  std::vector<std::string> kept;
  for (const std::string& name : names) {
    if (std::find(left_out.begin(), left_out.end(), name) == left_out.end()) {
      kept.push_back(name);
    }
  }
  return kept;
}

class AutomaticScaling : public ::testing::Test {
 protected:
  /// Factors by stem of the body: "femur" for both sides; those that are not named keep 1.
  void stretch(const std::map<std::string, Vector3d>& factors) {
    for (const BodySpec& body : generic_.bodies) {
      const std::string stem = body.name.substr(0, body.name.find_last_of('_'));
      const auto own = factors.find(body.name);
      const auto both = factors.find(stem);
      truth_[body.name] = own != factors.end()    ? own->second
                          : both != factors.end() ? both->second
                                                  : Vector3d(Vector3d::Ones());
    }
  }

  void stretchAll(double limb, double trunk) {
    stretch({{"pelvis", Vector3d::Constant(trunk)},
             {"torso", Vector3d::Constant(trunk)},
             {"femur", Vector3d::Constant(limb)},
             {"patella", Vector3d::Constant(limb)},
             {"tibia", Vector3d::Constant(limb)},
             {"talus", Vector3d::Constant(limb)},
             {"calcn", Vector3d::Constant(limb)},
             {"toes", Vector3d::Constant(limb)},
             {"humerus", Vector3d::Constant(limb)},
             {"ulna", Vector3d::Constant(limb)},
             {"radius", Vector3d::Constant(limb)},
             {"hand", Vector3d::Constant(limb)}});
  }

  /// The static trial of the subject, standing still for half a second.
  MarkerTrajectories stand(const std::vector<std::string>& names) const {
    ModelSpec spec = generic_;
    spec.muscles.clear();
    spec.markers.clear();
    MarkerTrajectories trial;
    for (const std::string& name : names) {
      const Landmark& mark = *findLandmark(name);
      spec.markers.push_back({name, mark.body, mark.location, false});
    }
    std::vector<BodyScale> factors;
    for (const auto& [body, factor] : truth_) {
      factors.push_back({body, factor});
    }
    const Model subject(applyScaleFactors(spec, factors, MassDistribution::kPreserved));
    Eigen::VectorXd q = subject.defaultPose();
    for (const auto& [coordinate, degrees] : pose_deg_) {
      q[subject.getCoordinate(coordinate).value()] = toRadians(degrees);
    }
    FreeCoordinates(subject).conformPose(q);
    ModelState state(subject);
    state.setPose(q);
    trial.names = names;
    trial.positions = RowMatrix(51, 3 * static_cast<int>(names.size()));
    for (int frame = 0; frame < 51; ++frame) {
      trial.time.push_back(0.01 * frame);
      for (int m = 0; m < trial.markerCount(); ++m) {
        const MarkerSpec& marker = subject.spec().markers[static_cast<std::size_t>(m)];
        const Vector3d p_GM = state.pose(subject.getBody(marker.body)) * marker.location;
        trial.positions.row(frame).segment<3>(Eigen::Index{3} * m) = p_GM.transpose();
      }
    }
    return trial;
  }

  ScaleResult scale(const MarkerTrajectories& trial, bool symmetric = true, double height = 0) {
    const MarkerMapping mapping = mapMarkerNames(trial.names);
    made_ = makeAutomaticMarkerSet({mapping, {trial}, {}, generic_, height, symmetric});
    ScaleOptions options;
    options.marker_set = made_.set;
    return ScaleSolver(generic_, options).solve({trial});
  }

  void expectTruth(const ScaleResult& result, const std::vector<std::string>& bodies) const {
    for (const BodyScale& body : result.factors) {
      if (std::find(bodies.begin(), bodies.end(), body.body) != bodies.end()) {
        EXPECT_NEAR((body.factors - truth_.at(body.body)).cwiseAbs().maxCoeff(), 0, tol(kRecovery))
            << body.body << " " << body.factors.transpose();
      }
    }
  }

  static const MeasurementResult* findApplied(const ScaleResult& result, const std::string& group) {
    for (const MeasurementResult& one : result.measurements) {
      const bool applied =
          one.use == MeasurementUse::kApplied || one.use == MeasurementUse::kLimited;
      if (applied && one.name.compare(0, group.size() + 1, group + ":") == 0) {
        return &one;
      }
    }
    return nullptr;
  }

  static bool mentions(const std::vector<std::string>& sentences, const std::string& words) {
    return std::any_of(sentences.begin(), sentences.end(), [&](const std::string& sentence) {
      return sentence.find(words) != std::string::npos;
    });
  }

  ModelSpec generic_ = readOwnModel();
  std::map<std::string, Vector3d> truth_;
  std::map<std::string, double> pose_deg_ = {{"arm_add_r", -20}, {"arm_add_l", -20}};
  AutomaticMarkerSet made_{};
};

const std::vector<std::string> kAllBodies = {"pelvis",
                                             "torso",
                                             "femur_r",
                                             "femur_l",
                                             "patella_r",
                                             "tibia_r",
                                             "tibia_l",
                                             "talus_l",
                                             "calcn_r",
                                             "toes_l",
                                             "ulna_r",
                                             "hand_l",
                                             "humerus_r",
                                             "humerus_l",
                                             "radius_l"};

TEST_F(AutomaticScaling, FindsTheSizesOfATallSubjectWithShortTrunk) {
  stretchAll(1.12, 0.95);
  const ScaleResult result = scale(stand(listMarkers()));
  expectTruth(result, kAllBodies);
  EXPECT_LT(result.placements[0].rms, tol(1e-3));
  EXPECT_GT(result.pose_rounds, 1);
}

TEST_F(AutomaticScaling, FindsTheSizesOfAChild) {
  stretchAll(0.68, 0.75);
  expectTruth(scale(stand(listMarkers()), true, 1.20), kAllBodies);
}

class Heading : public AutomaticScaling, public ::testing::WithParamInterface<int> {};

TEST_P(Heading, DoesNotMatter) {
  stretchAll(1.08, 1.02);
  pose_deg_["pelvis_rotation"] = GetParam();
  const ScaleResult result = scale(stand(listMarkers()));
  expectTruth(result, kAllBodies);
  EXPECT_LT(result.placements[0].max_error, tol(2e-3));
}

INSTANTIATE_TEST_SUITE_P(FullTurn, Heading, ::testing::Range(0, 360, 30));

TEST_F(AutomaticScaling, ArmsMayHangOrBeRaisedAnyWay) {
  const std::map<std::string, std::map<std::string, double>> poses = {
      {"hanging", {{"arm_add_r", -5}, {"arm_add_l", -5}}},
      {"lateral", {{"arm_add_r", -88}, {"arm_add_l", -92}}},
      {"forward", {{"arm_flex_r", 88}, {"arm_flex_l", 85}, {"elbow_flex_r", 10}}},
      {"lateral, forearms forward",
       {{"arm_add_r", -85}, {"arm_add_l", -85}, {"elbow_flex_r", 90}, {"elbow_flex_l", 85}}},
  };
  stretchAll(1.1, 1.05);
  for (const auto& [name, angles] : poses) {
    SCOPED_TRACE(name);
    pose_deg_ = angles;
    const ScaleResult result = scale(stand(listMarkers()));
    expectTruth(result, kAllBodies);
    EXPECT_LT(result.placements[0].max_error, tol(2e-3));
    EXPECT_EQ(mentions(made_.notes, "arms are raised"), name != "hanging");
  }
}

TEST_F(AutomaticScaling, MissingMedialMarkersFallBackToTheLateralOnes) {
  stretchAll(1.1, 1.05);
  const ScaleResult result = scale(stand(without(listMarkers(), kMedial)));
  expectTruth(result, {"pelvis", "torso", "femur_r", "tibia_l", "calcn_r", "humerus_l", "ulna_r"});
  EXPECT_NE(findApplied(result, "shank")->name.find("lateral malleolus"), std::string::npos);
  EXPECT_TRUE(
      mentions(made_.notes, "shank is measured by \"lateral condyle to lateral malleolus\""));
}

TEST_F(AutomaticScaling, MissingArmsTakeTheHeightAndSaySo) {
  stretchAll(1.1, 1.05);
  const ScaleResult result = scale(stand(without(listMarkers(), kArms)), true, 1.87);
  expectTruth(result, {"pelvis", "torso", "femur_r", "tibia_l", "calcn_r"});
  const int humerus = generic_.findBody("humerus_r");
  EXPECT_NEAR(result.factors[static_cast<std::size_t>(humerus)].factors.x(), 1.1, tol(1e-12));
  EXPECT_TRUE(mentions(made_.notes, "no marker pair measures upper arm"));
  EXPECT_TRUE(mentions(result.warnings, "nothing measures humerus_r"));
  EXPECT_TRUE(mentions(result.warnings, "the subject's height over the model's"));
}

/// Which line measures a group when some landmarks are missing.
struct Fallback {
  const char* group;
  std::vector<std::string> added;
  std::vector<std::string> missing;
  const char* line;
};

TEST_F(AutomaticScaling, EveryLineOfTheTableStepsInForTheOneBefore) {
  stretchAll(1.1, 1.1);
  const std::vector<Fallback> cases = {
      {"pelvis depth", {}, {}, "front to back"},
      {"pelvis depth", {}, {"RPSI", "LPSI"}, "as the width"},
      {"pelvis width", {}, {}, "between the front spines"},
      {"pelvis width", {"RHJC", "LHJC"}, {"LASI"}, "between the rear spines"},
      {"pelvis height", {"RHJC", "LHJC"}, {}, "spines to measured hip centres"},
      {"pelvis height", {}, {}, "as the mean of width and depth"},
      {"thigh", {"RHJC", "LHJC"}, {}, "measured hip centre to knee centre"},
      {"thigh", {}, {}, "front spine to knee centre"},
      {"thigh", {"RHJC", "LHJC"}, {"RMFC", "LMFC"}, "measured hip centre to lateral condyle"},
      {"thigh", {}, {"RMFC", "LMFC"}, "front spine to lateral condyle"},
      {"shank", {}, {"RMFC", "LMFC", "RMMAL", "LMMAL"}, "lateral condyle to lateral malleolus"},
      {"shank", {}, {"RLMAL", "LLMAL", "RMMAL", "LMMAL"}, ""},
      {"shank", {}, {"RMMAL", "LMMAL"}, "lateral condyle to lateral malleolus"},
      {"foot", {}, {"RMT5", "LMT5"}, "heel to the heads"},
      {"foot", {}, {"RCAL", "LCAL"}, "ankle to the forefoot"},
      {"trunk", {}, {"RPSI", "LPSI"}, "front of the pelvis to the base of the neck"},
      {"trunk", {}, {"C7", "CLAV"}, "pelvis to the shoulders"},
      {"trunk width", {"RSJC", "LSJC"}, {"RACR"}, "between measured shoulder centres"},
      {"upper arm", {"RSJC", "LSJC"}, {}, "shoulder centre to elbow centre"},
      {"upper arm", {}, {}, "acromion to elbow centre"},
      {"upper arm", {}, {"RMEL", "LMEL"}, "acromion to lateral epicondyle"},
      {"forearm", {}, {"RMEL", "LMEL"}, "lateral epicondyle to wrist"},
      {"foot width", {}, {"RMT5", "LMT5"}, ""},
  };
  for (const Fallback& one : cases) {
    SCOPED_TRACE(std::string(one.group) + ": " + one.line);
    std::vector<std::string> names = without(listMarkers(), one.missing);
    names.insert(names.end(), one.added.begin(), one.added.end());
    const ScaleResult result = scale(stand(names), true, 1.87);
    const MeasurementResult* applied = findApplied(result, one.group);
    if (std::string(one.line).empty()) {
      EXPECT_EQ(applied, nullptr);
      EXPECT_TRUE(mentions(made_.notes, std::string("no marker pair measures ") + one.group));
      continue;
    }
    ASSERT_NE(applied, nullptr);
    EXPECT_NE(applied->name.find(one.line), std::string::npos) << applied->name;
    EXPECT_NEAR(applied->factor, 1.1, tol(kRecovery));
  }
}

TEST_F(AutomaticScaling, SidesShareTheMeanUnlessAsked) {
  stretchAll(1.1, 1.05);
  truth_["tibia_r"] = Vector3d::Constant(1.0);
  const MarkerTrajectories trial = stand(listMarkers());
  const ScaleResult shared = scale(trial);
  const std::size_t right = static_cast<std::size_t>(generic_.findBody("tibia_r"));
  const std::size_t left = static_cast<std::size_t>(generic_.findBody("tibia_l"));
  EXPECT_EQ(shared.factors[right].factors, shared.factors[left].factors);
  EXPECT_NEAR(shared.factors[left].factors.y(), 1.05, tol(0.02));
  EXPECT_TRUE(mentions(shared.warnings, "measurement 'shank:"));
  const ScaleResult own = scale(trial, false);
  expectTruth(own, kAllBodies);
  expectTruth(own, {"tibia_r"});
}

TEST_F(AutomaticScaling, OneSideBorrowsFromTheOther) {
  stretchAll(1.1, 1.05);
  const ScaleResult result = scale(stand(without(listMarkers(), {"LLMAL", "LMMAL"})), false);
  EXPECT_NEAR(findApplied(result, "shank left")->factor, 1.1, tol(kRecovery));
  EXPECT_TRUE(mentions(made_.notes, "shank left is measured by"));
}

TEST_F(AutomaticScaling, ImplausibleSegmentIsNamedAndTheNextLineTakesOver) {
  stretchAll(1.1, 1.1);
  std::vector<std::string> names = listMarkers();
  names.insert(names.end(), {"RHJC", "LHJC"});
  MarkerTrajectories trial = stand(names);
  // Both hip centres slipped half way down the thighs.
  for (const char* name : {"RHJC", "LHJC"}) {
    trial.positions.col(3 * *trial.findMarker(name) + 1).array() -= 0.25;
  }
  const ScaleResult result = scale(trial, true, 1.87);
  EXPECT_NE(findApplied(result, "thigh")->name.find("front spine"), std::string::npos);
  EXPECT_TRUE(mentions(result.warnings, "measured hip centre to knee centre' is refused"));
  EXPECT_TRUE(mentions(result.warnings, "RHJC"));
}

TEST_F(AutomaticScaling, MarkersWithGapsStillPlaceTheModel) {
  stretchAll(1.1, 1.05);
  MarkerTrajectories trial = stand(listMarkers());
  for (int frame = 0; frame < 20; ++frame) {
    trial.positions.row(frame).segment<3>(3 * *trial.findMarker("RMT5")).setConstant(kNaN);
  }
  const ScaleResult result = scale(trial);
  expectTruth(result, {"femur_r", "tibia_r", "calcn_r"});
  EXPECT_TRUE(mentions(made_.warnings, "RMT5 (61 %)"));
}

TEST_F(AutomaticScaling, WorksOnModelsWithoutArms) {
  stretchAll(1.1, 1.05);
  const MarkerTrajectories trial = stand(listMarkers());
  for (const char* arm : {"humerus", "ulna", "radius", "hand"}) {
    for (const char* side : {"_r", "_l"}) {
      const std::string body = std::string(arm) + side;
      generic_.bodies.erase(generic_.bodies.begin() + generic_.findBody(body));
      generic_.joints.erase(
          std::find_if(generic_.joints.begin(), generic_.joints.end(), [&](const JointSpec& joint) {
            return joint.child.body == body;
          }));
    }
  }
  generic_.muscles.clear();
  generic_.actuators.clear();
  generic_.markers.clear();
  const ScaleResult result = scale(trial);
  expectTruth(result, {"pelvis", "torso", "femur_r", "tibia_l", "calcn_r"});
  EXPECT_FALSE(mentions(made_.notes, "forearm"));
}

}  // namespace
}  // namespace gaitmill
