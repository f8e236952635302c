#include "core/scale/marker_placement.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/model/model.h"
#include "tests/support/model_files.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The project's model standing with its arms raised; its skin markers RTH1 and RTB2 sit elsewhere
/// on the subject than on the model.
class MarkerPlacement : public ::testing::Test {
 protected:
  MarkerPlacement() {
    const Model model(truth_);
    Eigen::VectorXd q = model.defaultPose();
    q[model.getCoordinate("arm_add_r").value()] = -1.4;
    q[model.getCoordinate("arm_add_l").value()] = -1.4;
    q[model.getCoordinate("knee_angle_r").value()] = 0.1;
    q[model.getCoordinate("pelvis_rotation").value()] = -1.5;
    FreeCoordinates(model).conformPose(q);
    pose_ = q;
    ModelState state(model);
    state.setPose(q);
    trial_.time = {0, 0.01, 0.02};
    trial_.positions = RowMatrix(3, 3 * static_cast<int>(truth_.markers.size()));
    for (const MarkerSpec& marker : truth_.markers) {
      const int column = 3 * trial_.markerCount();
      trial_.names.push_back(marker.name);
      const Eigen::Vector3d p_GM = state.pose(model.getBody(marker.body)) * marker.location;
      trial_.positions.middleCols(column, 3).rowwise() = p_GM.transpose();
    }
    for (const MarkerSpec& marker : truth_.markers) {
      const bool on_skin = marker.name == "RTH1" || marker.name == "RTB2";
      placement_.tasks.markers.push_back({marker.name, on_skin ? 0.0 : 1.0});
    }
    for (const char* name : {"RTH1", "RTB2"}) {
      findMarker(name).location += Eigen::Vector3d(0.02, -0.03, 0.01);
    }
  }

  MarkerSpec& findMarker(const std::string& name) {
    return model_.markers[static_cast<std::size_t>(model_.findMarker(name))];
  }

  ModelSpec truth_ = readOwnModel();
  ModelSpec model_ = truth_;
  Eigen::VectorXd pose_;
  MarkerTrajectories trial_;
  PlacementSpec placement_;
};

TEST_F(MarkerPlacement, SkinMarkersMoveToWhereTheyWereMeasured) {
  const PlacementResult result = placeMarkers(placement_, trial_, {}, model_);
  EXPECT_TRUE(result.converged);
  EXPECT_NEAR(result.rms, 0, tol(1e-9));
  EXPECT_NEAR(
      (result.pose.values.row(0).transpose() - pose_).lpNorm<Eigen::Infinity>(), 0, tol(1e-7));
  for (std::size_t i = 0; i < truth_.markers.size(); ++i) {
    EXPECT_NEAR((model_.markers[i].location - truth_.markers[i].location).norm(), 0, tol(1e-8));
  }
}

TEST_F(MarkerPlacement, FixedMarkerStays) {
  findMarker("RTH1").fixed = true;
  const Eigen::Vector3d before = findMarker("RTH1").location;
  placeMarkers(placement_, trial_, {}, model_);
  EXPECT_EQ(findMarker("RTH1").location, before);
}

TEST_F(MarkerPlacement, MarkersThatTheFileLacksAreRemoved) {
  model_.markers.push_back({"Hat", "torso", {0, 0.7, 0}, false});
  const PlacementResult result = placeMarkers(placement_, trial_, {}, model_);
  EXPECT_EQ(result.removed_markers, std::vector<std::string>{"Hat"});
  EXPECT_EQ(model_.findMarker("Hat"), -1);
}

TEST_F(MarkerPlacement, MarkerMissingInAFrameIsMovedButDoesNotPull) {
  const int column = 3 * *trial_.findMarker("CLAV");
  trial_.positions(1, column) = kNaN;
  trial_.positions(0, column + 1) += 0.3;  // would spoil the fit
  const PlacementResult result = placeMarkers(placement_, trial_, {}, model_);
  EXPECT_NEAR(result.rms, 0, tol(1e-9));
  const Eigen::Vector3d truth =
      truth_.markers[static_cast<std::size_t>(truth_.findMarker("CLAV"))].location;
  EXPECT_NEAR((findMarker("CLAV").location - truth).norm(), 0.15, tol(1e-7));
}

TEST_F(MarkerPlacement, DefaultPoseOfTheModelStays) {
  placeMarkers(placement_, trial_, {}, model_);
  EXPECT_EQ(Model(model_).defaultPose(), Model(truth_).defaultPose());
}

TEST_F(MarkerPlacement, LaboratoryMarkersReplaceThoseOfTheSameName) {
  const std::size_t count = model_.markers.size();
  addMarkers({{"RASI", "pelvis", {0.1, 0.2, 0.3}, true}, {"Hat", "torso", {0, 0.7, 0}, false}},
             model_);
  EXPECT_EQ(model_.markers.size(), count + 1);
  EXPECT_EQ(findMarker("RASI").location, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_THROW(addMarkers({{"X", "thorax", {0, 0, 0}, false}}, model_), Error);
}

}  // namespace
}  // namespace gaitmill
