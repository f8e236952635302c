#include <cmath>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/io/grf_reader.h"
#include "core/io/table_reader.h"
#include "core/math/natural_spline.h"
#include "core/rra/mass_adjustment.h"
#include "core/rra/rra_solver.h"
#include "tests/support/model_files.h"
#include "tests/support/paper_rra.h"
#include "tests/support/shared_data.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

// OpenSim 4.6 on the published trials with the published set-ups; figures of spec/rra.md 10. Their
// print and the reference's integration tolerance make the margins: averages of inverse dynamics
// 2e-5, walking kinematics 3.5e-5 rad and 1e-6 m.
struct Expected {
  double before[6];
  double shift_x, shift_z, mass_change;
  double peak[6];
};

const Expected kWalk[] = {{{1.308532, 0.180321, -0.568966, -1.081243, -1.464700, -5.811396},
                           -0.019563,
                           0.003640,
                           -0.018388,
                           {15.5110, 19.1279, 8.5237, 18.6508, 11.8967, 22.1493}},
                          {{1.30089, -0.11384, -0.34885, 0.00677, -1.40644, -0.12528},
                           -0.000422,
                           -0.000023,
                           0.011608,
                           {8.153, 7.915, 3.057, 24.054, 11.545, 25.493}}};
const Expected kRun[] = {{{0.83908, -5.76859, 2.52339, 1.30319, -0.87015, -6.24201},
                          -0.024540,
                          -0.005123,
                          0.588232,
                          {2.049, 6.976, 1.875, 30.468, 32.022, 63.838}},
                         {{0.85660, 0.12556, 2.43605, 0.07193, -0.89469, -0.21734},
                          -0.000848,
                          -0.000281,
                          -0.012803,
                          {1.938, 15.508, 1.860, 28.618, 31.298, 52.109}},
                         {{2.22008, -0.13518, 3.20022, 0.01848, -0.84202, 0.20579},
                          0.000803,
                          -0.000072,
                          0.013785,
                          {1.394, 12.954, 2.074, 29.677, 29.518, 39.503}}};

struct Trial {
  ModelSpec model;
  TimeSeries coordinates;
  GroundReaction reaction;
};

class RraReference : public SharedDataTest {
 protected:
  Trial readTrial(const std::string& name, const std::string& forces) const {
    const std::string folder = "reference/" + name;
    Trial trial;
    trial.model = readModelFile(shared(folder + "/scale/subject_scaled.osim"));
    trial.coordinates = readCoordinates(folder + "/ik/ik.mot", trial.model);
    GrfOptions as_filed;
    as_filed.threshold = 0;
    trial.reaction = readGroundReaction(readTable(readFile(shared(forces)), forces), as_filed);
    return trial;
  }
  Trial readWalk() const { return readTrial("walk", "data/walk/grf_walk.mot"); }
  Trial readRun() const { return readTrial("run", "data/run/paper_subject01/grf_run.mot"); }

  TimeSeries readCoordinates(const std::string& path, const ModelSpec& model) const {
    return toCoordinates(readTable(readFile(shared(path)), path), model);
  }

  struct Difference {
    double rotation = 0;     // [rad]
    double translation = 0;  // [m]
  };

  // Largest difference at the rows that both have.
  Difference compareKinematics(const RraPassResult& pass, const std::string& path) const {
    const TimeSeries reference = readCoordinates(path, pass.adjusted_model);
    Difference difference;
    for (int row = 0; row < reference.rowCount(); ++row) {
      const double t = reference.time[static_cast<std::size_t>(row)];
      const int ours = pass.coordinates.findNearestRow(t);
      if (std::abs(pass.coordinates.time[static_cast<std::size_t>(ours)] - t) > 1e-8) continue;
      for (int c = 0; c < reference.columnCount(); ++c) {
        const int column =
            pass.coordinates.getColumn(reference.labels[static_cast<std::size_t>(c)]);
        const double d = std::abs(pass.coordinates.values(ours, column) - reference.values(row, c));
        const bool slides = pass.coordinates.units[static_cast<std::size_t>(column)] == "m";
        double& largest = slides ? difference.translation : difference.rotation;
        largest = std::max(largest, d);
      }
    }
    return difference;
  }

  static void compare(const RraPassResult& pass, const Expected& expected, double peak_tolerance) {
    const ResidualSum& before = pass.adjustment.average_before;
    const ResidualSum& peak = pass.residuals.peak;
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(before.force(i), expected.before[i], tol(2e-5)) << i;
      EXPECT_NEAR(before.moment(i), expected.before[i + 3], tol(2e-5)) << i;
      EXPECT_NEAR(peak.force(i), expected.peak[i], tol(peak_tolerance)) << i;
      EXPECT_NEAR(peak.moment(i), expected.peak[i + 3], tol(peak_tolerance)) << i;
    }
    EXPECT_NEAR(pass.adjustment.shift_x, expected.shift_x, tol(6e-7));
    EXPECT_NEAR(pass.adjustment.shift_z, expected.shift_z, tol(6e-7));
    EXPECT_NEAR(pass.adjustment.mass_change, expected.mass_change, tol(2e-6));
  }

  static void compareControls(const RraOptions& options,
                              const RraPassResult& pass,
                              int row,
                              const double (&expected)[6]) {
    for (int k = 0; k < 6; ++k) {
      const double control = pass.actuator_forces.values(row, k) /
                             options.actuators[static_cast<std::size_t>(k)].optimal_force;
      EXPECT_NEAR(control, expected[k], tol(1.6e-6)) << "row " << row << " actuator " << k;
    }
  }
};

TEST_F(RraReference, WalkingResidualsAtTheFirstRow) {
  const Trial trial = readWalk();
  const RraOptions options = makePaperWalkRra();
  const Model model(trial.model);
  const FreeCoordinates free(model);
  const ExternalLoads loads(model, trial.reaction);
  const ReferenceMotion reference(model, free, prepareDesiredMotion(trial.coordinates, options));
  const TimeSeries residuals =
      calcDesiredResiduals(trial.model, reference, loads, options, options.passes[0]);
  const double expected[] = {0.769148, -4.902766, 1.538289, -26.908714, -3.049887, 6.400249};
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(residuals.values(0, k), expected[k], tol(2e-6)) << k;
}

TEST_F(RraReference, WalkingPasses) {
  const Trial trial = readWalk();
  const RraOptions options = makePaperWalkRra();
  const RraResult result = solveRra(trial.model, trial.coordinates, trial.reaction, options);
  ASSERT_EQ(result.passes.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    SCOPED_TRACE("pass " + std::to_string(i + 1));
    compare(result.passes[i], kWalk[i], 1e-3);
    const Difference difference = compareKinematics(
        result.passes[i], "reference/walk/rra/pass" + std::to_string(i + 1) + "/kinematics_q.sto");
    EXPECT_LE(difference.rotation, tol(3.5e-5));
    EXPECT_LE(difference.translation, tol(1e-6));
  }
  const RraPassResult& first = result.passes[0];
  compareControls(
      options, first, 0, {0.188132, -0.587435, 0.302376, -6.735777, -0.789931, 3.399388});
  compareControls(
      options, first, 1, {0.209771, -0.684197, 0.312516, -6.651937, -0.809185, 3.461315});
  compareControls(
      options, first, 2, {0.236717, -0.781819, 0.325182, -6.666998, -0.835787, 3.574356});
  compareControls(
      options, first, 3, {0.267315, -0.872508, 0.336382, -6.676768, -0.863287, 3.688145});

  // After the shift, and averages of the simulated motion (the reference averages over the
  // integrator's own rows, ours over windows).
  const double after[] = {1.299017, 0.063551, -0.349875, 0.007111, -1.406409, -0.118271};
  const double simulated[] = {-0.370211, 0.500168, 0.190594, 1.58578, -1.30404, -0.144915};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(first.adjustment.average_after.force(i), after[i], tol(2e-5));
    EXPECT_NEAR(first.adjustment.average_after.moment(i), after[i + 3], tol(2e-5));
    EXPECT_NEAR(first.residuals.average.force(i), simulated[i], tol(2e-4));
    EXPECT_NEAR(first.residuals.average.moment(i), simulated[i + 3], tol(2e-4));
  }
  EXPECT_NEAR(first.adjustment.mass_before, 85.066800, tol(1e-6));
  EXPECT_NEAR(first.adjustment.mass_after, 85.048412, tol(1e-6));
  EXPECT_NEAR(first.coordinates.time.back(), 1.799, tol(1e-9));
  EXPECT_EQ(first.coordinates.rowCount(), 1350);
  EXPECT_EQ(first.counters.bounded_windows, 0);
}

// Acceptance of the paper: changes under 2 deg and 2 cm, RMS under 1.75 deg and 1 cm, in the pass
// whose statistics it reports.
TEST_F(RraReference, RunningPasses) {
  const Trial trial = readRun();
  const RraOptions options = makePaperRunRra();
  const RraResult result = solveRra(trial.model, trial.coordinates, trial.reaction, options);
  ASSERT_EQ(result.passes.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    SCOPED_TRACE("pass " + std::to_string(i + 1));
    // The point of application jumps at foot strike; OpenSim splines the jump, we do not.
    compare(result.passes[i], kRun[i], 3e-3);
    const Difference difference = compareKinematics(
        result.passes[i], "reference/run/rra/pass" + std::to_string(i + 1) + "/kinematics_q.sto");
    EXPECT_LE(difference.rotation, tol(1e-3));
    EXPECT_LE(difference.translation, tol(3e-6));
  }
  compareControls(options,
                  result.passes[0],
                  0,
                  {0.465512, -0.931747, 1.177191, -8.930567, -2.834534, 15.221775});
  compareControls(options,
                  result.passes[0],
                  1,
                  {0.437253, -1.089720, 1.235128, -9.797367, -3.815487, 15.212957});
  const TrackingStatistics& tracking = result.passes[1].tracking;
  EXPECT_LT(tracking.max_deg, 2);
  EXPECT_LT(tracking.max_cm, 2);
  EXPECT_LT(tracking.max_rms_deg, 1.75);
  EXPECT_LT(tracking.max_rms_cm, 1);
}

// Forces as OpenSim forms them between the samples: force, point and torque splined one by one,
// sampled densely enough that the way we interpolate them no longer matters.
GroundReaction splineSeparately(const GroundReaction& reaction, double start, double end) {
  constexpr double kStep = 5e-5;
  GroundReaction dense;
  const int rows = static_cast<int>(std::lround((end - start) / kStep)) + 1;
  for (int i = 0; i < rows; ++i) dense.time.push_back(start + i * kStep);
  Eigen::VectorXd value(9);
  for (const ExternalForce& force : reaction.forces) {
    RowMatrix columns(force.force.cols(), 9);
    columns << force.force.transpose(), force.point.transpose(), force.torque.transpose();
    const NaturalSpline spline(reaction.time, columns, 3);
    ExternalForce out = force;
    out.force.resize(3, rows);
    out.point.resize(3, rows);
    out.torque.resize(3, rows);
    for (int i = 0; i < rows; ++i) {
      spline.evaluate(dense.time[static_cast<std::size_t>(i)], value);
      out.force.col(i) = value.segment<3>(0);
      out.point.col(i) = value.segment<3>(3);
      out.torque.col(i) = value.segment<3>(6);
    }
    dense.forces.push_back(out);
  }
  return dense;
}

// With OpenSim's loads the running passes agree to the spec's 2.7e-7 rad: the difference above is
// the loads' alone.
TEST_F(RraReference, RunningPassWithLoadsAsOpenSimFormsThem) {
  const Trial trial = readRun();
  RraOptions options = makePaperRunRra();
  options.passes.resize(1);
  const RraResult result =
      solveRra(trial.model, trial.coordinates, splineSeparately(trial.reaction, 0.7, 1.7), options);
  const Difference difference =
      compareKinematics(result.passes[0], "reference/run/rra/pass1/kinematics_q.sto");
  EXPECT_LE(difference.rotation, tol(5e-7));
  EXPECT_LE(difference.translation, tol(5e-8));
}

}  // namespace
}  // namespace gaitmill
