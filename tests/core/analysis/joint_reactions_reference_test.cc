// Joint reactions of the published walk against OpenSim's, from the same muscle forces and motion.
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/analysis/joint_reactions.h"
#include "core/io/grf_reader.h"
#include "core/io/table_reader.h"
#include "core/model/reference_motion.h"
#include "tests/support/model_files.h"
#include "tests/support/shared_data.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

class JointReactionsReference : public SharedDataTest {
 protected:
  void SetUp() override {
    SharedDataTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) {
      return;
    }
    const std::string folder = shared("reference/walk/");
    model_ = std::make_unique<Model>(readModelFile(folder + "subject_adjusted.osim"));
    const std::string loads_path = shared("data/walk/grf_walk.mot");
    GrfOptions as_it_is;
    as_it_is.threshold = 0;
    loads_ = std::make_unique<ExternalLoads>(
        *model_, readGroundReaction(readTable(readFile(loads_path), loads_path), as_it_is));
    const std::string path = folder + "joint_reaction/so_child_in_child.sto";
    reference_ = readTable(readFile(path), path).table;
    readForces(folder + "so/force_N.csv");
    sampleMotion(folder + "rra/pass2/kinematics_q.sto");
  }

  /// Forces at the rows of the reference, which are up to a millisecond beside those of the table.
  void readForces(const std::string& path) {
    const TimeSeries table = readCsvSeries(path);
    forces_ = makeTimeSeries(table.name, table.labels, reference_.time);
    for (int row = 0; row < forces_.rowCount(); ++row) {
      const double time = forces_.time[static_cast<std::size_t>(row)];
      forces_.values.row(row) = table.interpolate(time).transpose();
      const auto nearest = static_cast<std::size_t>(table.findNearestRow(time));
      has_forces_.push_back(std::abs(table.time[nearest] - time) < 1e-6);
    }
  }

  /// The model's own actuators, then reserves and residuals of the published set-up
  /// (spec/cmc.md 1).
  std::vector<ActuatorSpec> makeActuators() const {
    std::vector<ActuatorSpec> actuators = model_->spec().actuators;
    for (const char* side : {"_r", "_l"}) {
      for (const char* coordinate :
           {"hip_flexion", "hip_adduction", "hip_rotation", "knee_angle", "ankle_angle"}) {
        ActuatorSpec reserve;
        reserve.coordinate = std::string(coordinate) + side;
        reserve.name = reserve.coordinate + "_reserve";
        actuators.push_back(reserve);
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      ActuatorSpec residual;
      residual.body = "pelvis";
      residual.direction = Eigen::Vector3d::Unit(axis);
      residual.kind = ActuatorSpec::Kind::kPoint;
      residual.name = std::string("F") + "XYZ"[axis];
      residual.point = {-0.107324, 0.0155155, 0};
      actuators.push_back(residual);
      residual.kind = ActuatorSpec::Kind::kTorque;
      residual.name = std::string("M") + "XYZ"[axis];
      actuators.push_back(residual);
    }
    return actuators;
  }

  /// Pose and speed at the rows of the force table.
  void sampleMotion(const std::string& path) {
    const FreeCoordinates free(*model_);
    const ReferenceMotion motion(
        *model_, free, toCoordinates(readTable(readFile(path), path), model_->spec()));
    pose_ = makeTimeSeries("pose", model_->coordinateNames(), forces_.time);
    speed_ = makeTimeSeries("speed", model_->coordinateNames(), forces_.time);
    Eigen::VectorXd q_free(free.count());
    Eigen::VectorXd u_free(free.count());
    Eigen::VectorXd full(model_->coordinateCount());
    for (int row = 0; row < pose_.rowCount(); ++row) {
      motion.calcPose(forces_.time[static_cast<std::size_t>(row)], q_free);
      motion.calcSpeed(forces_.time[static_cast<std::size_t>(row)], u_free);
      free.expandPose(q_free, full);
      pose_.values.row(row) = full.transpose();
      free.expandRates(u_free, full);
      speed_.values.row(row) = full.transpose();
    }
  }

  std::unique_ptr<Model> model_;
  std::unique_ptr<ExternalLoads> loads_;
  TimeSeries forces_, reference_, pose_, speed_;
  std::vector<bool> has_forces_;  ///< whether the force table has the row's very time
};

/// Worst of the columns of all joints.
struct Agreement {
  int rows = 0;
  double rms_force = 0, largest_force = 0;    ///< [N]
  double rms_moment = 0, largest_moment = 0;  ///< [N.m]
  double largest_place = 0;                   ///< [m]

  void add(char kind, const Eigen::VectorXd& difference) {
    const double rms = std::sqrt(difference.squaredNorm() / static_cast<double>(difference.size()));
    const double largest = difference.cwiseAbs().maxCoeff();
    if (kind == 'p') {
      largest_place = std::max(largest_place, largest);
      return;
    }
    double& worst_rms = kind == 'f' ? rms_force : rms_moment;
    double& worst_largest = kind == 'f' ? largest_force : largest_moment;
    worst_rms = std::max(worst_rms, rms);
    worst_largest = std::max(worst_largest, largest);
  }
};

/// Over the rows where the force table itself has a row, or over all.
enum class Rows { kOfTheForces, kAll };
Agreement compare(const TimeSeries& ours,
                  const TimeSeries& reference,
                  const std::vector<bool>& has_forces,
                  Rows which) {
  std::vector<Eigen::Index> rows;
  for (std::size_t row = 0; row < has_forces.size(); ++row) {
    if (which == Rows::kAll || has_forces[row]) {
      rows.push_back(static_cast<Eigen::Index>(row));
    }
  }
  Agreement agreement;
  agreement.rows = static_cast<int>(rows.size());
  for (int column = 0; column < reference.columnCount(); ++column) {
    const std::string& label = reference.labels[static_cast<std::size_t>(column)];
    const int our_column = ours.getColumn(label);
    Eigen::VectorXd difference(agreement.rows);
    for (int i = 0; i < agreement.rows; ++i) {
      const Eigen::Index row = rows[static_cast<std::size_t>(i)];
      difference[i] = ours.values(row, our_column) - reference.values(row, column);
    }
    agreement.add(label[label.size() - 2], difference);
  }
  return agreement;
}

// Places and moments of simple joints are equal to round-off. What is left are the directions in
// which hip muscles leave their cylinders: geodesics here, near-geodesics there, which also turns
// into accelerations. Hips carry 3300 N, ankles 4400 N.
TEST_F(JointReactionsReference, AreThoseOfOpenSimWhereItsForcesAreKnown) {
  const TimeSeries ours =
      calcJointReactions(*model_, {pose_, speed_, forces_, forces_, makeActuators(), *loads_});
  const Agreement agreement = compare(ours, reference_, has_forces_, Rows::kOfTheForces);
  ASSERT_GT(agreement.rows, 30);
  EXPECT_LT(agreement.largest_place, tol(1e-8));
  EXPECT_LT(agreement.rms_force, tol(4.6));        // measured: 4.45
  EXPECT_LT(agreement.largest_force, tol(13.0));   // measured: 12.5
  EXPECT_LT(agreement.rms_moment, tol(0.19));      // measured: 0.181
  EXPECT_LT(agreement.largest_moment, tol(0.45));  // measured: 0.440
}

// The other rows lie up to a millisecond beside those of the force table, whose 10 ms miss tens of
// newtons where a foot strikes.
TEST_F(JointReactionsReference, AreThoseOfOpenSimUpToTheInterpolationOfItsForces) {
  const TimeSeries ours =
      calcJointReactions(*model_, {pose_, speed_, forces_, forces_, makeActuators(), *loads_});
  const Agreement agreement = compare(ours, reference_, has_forces_, Rows::kAll);
  EXPECT_EQ(agreement.rows, 138);
  EXPECT_LT(agreement.rms_force, tol(9.5));   // measured: 8.9
  EXPECT_LT(agreement.rms_moment, tol(0.5));  // measured: 0.46
}

}  // namespace
}  // namespace gaitmill
