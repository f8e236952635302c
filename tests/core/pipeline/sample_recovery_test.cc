#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/id/id_solver.h"
#include "core/ik/ik_solver.h"
#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "core/model/external_loads.h"
#include "core/model/free_coordinates.h"
#include "core/pipeline/marker_set_json.h"
#include "core/pipeline/sample_files.h"
#include "core/scale/scale_solver.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

// What the stages make of a trial whose truth is known.
class SampleRecovery : public ::testing::Test {
 protected:
  SampleRecovery() : generic_(readGeneric()), subject_(makeSampleSubject(generic_)) {}

  static ModelSpec readGeneric() {
    const std::string path = "models/rajagopal2016/rajagopal2016.osim";
    return readOsim(readFile(path), path);
  }

  static MarkerSetSpec readSet() {
    const std::string path = "models/marker_sets/rajagopal2016.json";
    return readMarkerSet(InputFile{path, readFile(path)});
  }

  SampleTrial generate(double marker_noise) const {
    SampleOptions options;
    options.marker_noise = marker_noise;
    return generateSampleTrial(subject_, options);
  }

  static TimeSeries solveIk(const Model& model, const MarkerTrajectories& markers) {
    IkOptions options;
    options.tasks = readSet().ik;
    return IkSolver(model, options, markers.names).solve(markers).coordinates;
  }

  static TimeSeries solveId(const Model& model,
                            const TimeSeries& coordinates,
                            const SampleTrial& trial) {
    const ExternalLoads loads(model, trial.ground_reaction);
    return IdSolver(model, {}).solve(coordinates, &loads).generalized_forces;
  }

  // Moments within 1 % of each curve's peak (issue; curves that stay below 1 N.m count as 1 N.m),
  // and what is left at the pelvis below the given bound. The splines' end conditions are felt over
  // ten rows.
  static void expectMoments(const TimeSeries& found,
                            const SampleTrial& trial,
                            double residual_bound) {
    const int rows = found.rowCount() - 20;
    for (const std::string& label : trial.moments.labels) {
      const auto truth = trial.moments.values.col(trial.moments.getColumn(label)).segment(10, rows);
      const auto column = found.values.col(found.getColumn(label)).segment(10, rows);
      const bool is_residual = label.rfind("pelvis_", 0) == 0;
      const double bound =
          is_residual ? residual_bound : 0.01 * std::max(1.0, truth.cwiseAbs().maxCoeff());
      EXPECT_LT((column - truth).cwiseAbs().maxCoeff(), tol(bound)) << label;
    }
  }

  // Standard deviation of each free coordinate that white marker noise of unit size leaves in a
  // weighted fit, at one pose: diagonal of A C A^T with A = (J^T W J)^-1 J^T W, J by differences.
  Eigen::VectorXd calcNoiseGain(const Eigen::VectorXd& pose,
                                const std::vector<MarkerWeight>& weights) const {
    const FreeCoordinates free(subject_);
    ModelState state(subject_);
    const auto positionsAt = [&](const Eigen::VectorXd& q) {
      state.setPose(q);
      Eigen::VectorXd positions(3 * static_cast<Eigen::Index>(weights.size()));
      for (std::size_t i = 0; i < weights.size(); ++i) {
        const MarkerSpec& marker =
            subject_.spec()
                .markers[static_cast<std::size_t>(subject_.spec().findMarker(weights[i].marker))];
        positions.segment<3>(3 * static_cast<Eigen::Index>(i)) =
            state.pose(subject_.getBody(marker.body)) * marker.location;
      }
      return positions;
    };
    Eigen::VectorXd q_free(free.count()), q = pose;
    free.pick(pose, q_free);
    const Eigen::VectorXd center = positionsAt(pose);
    Eigen::MatrixXd J(center.size(), free.count());
    for (int c = 0; c < free.count(); ++c) {
      Eigen::VectorXd stepped = q_free;
      stepped[c] += 1e-6;
      free.expandPose(stepped, q);
      J.col(c) = (positionsAt(q) - center) / 1e-6;
    }
    Eigen::VectorXd w(center.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
      w.segment<3>(3 * static_cast<Eigen::Index>(i)).setConstant(weights[i].weight);
    }
    const Eigen::MatrixXd JtW = J.transpose() * w.asDiagonal();
    const Eigen::MatrixXd gain = (JtW * J).ldlt().solve(JtW);
    return gain.rowwise().norm();
  }

  ModelSpec generic_;
  Model subject_;
};

TEST_F(SampleRecovery, InverseDynamicsGivesTheTrueMomentsAndNoResidual) {
  const SampleTrial trial = generate(0.0);
  expectMoments(solveId(subject_, trial.coordinates, trial), trial, 0.01);
}

TEST_F(SampleRecovery, MarkersGiveTheTrueCoordinates) {
  const SampleTrial trial = generate(0.0);
  const TimeSeries found = solveIk(subject_, trial.markers);
  const RowMatrix error = found.values - trial.coordinates.values;
  EXPECT_LT(error.cwiseAbs().maxCoeff(), tol(1e-6));  // [rad|m]
}

// From markers and forces alone: the generic model, scaled on the standing trial, finds angles,
// moments and no residual.
TEST_F(SampleRecovery, AllStagesTogetherGiveTheTruth) {
  const SampleTrial trial = generate(0.0);
  ScaleOptions options;
  options.marker_set = readSet();
  options.subject_mass = subject_.spec().calcTotalMass();
  const Model scaled(ScaleSolver(generic_, options).solve({trial.static_markers}).model);
  const TimeSeries coordinates = solveIk(scaled, trial.markers);
  const RowMatrix error = coordinates.values - trial.coordinates.values;
  EXPECT_LT(error.cwiseAbs().maxCoeff(), tol(toRadians(0.1)));
  expectMoments(solveId(scaled, coordinates, trial), trial, 1.0);
}

// With noise the error of each coordinate is what the noise makes of it: RMS over the trial against
// the first-order propagation, averaged over poses.
TEST_F(SampleRecovery, NoiseShowsInTheCoordinatesAsPropagated) {
  const SampleOptions defaults;
  const SampleTrial trial = generate(defaults.marker_noise);
  const TimeSeries found = solveIk(subject_, trial.markers);
  const FreeCoordinates free(subject_);
  std::vector<MarkerWeight> weights;
  for (const MarkerWeight& weight : readSet().ik.markers) {
    if (trial.markers.findMarker(weight.marker)) {
      weights.push_back(weight);
    }
  }
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(free.count());
  const int step = 10;
  int poses = 0;
  for (int frame = 0; frame < found.rowCount(); frame += step, ++poses) {
    const Eigen::VectorXd gain =
        calcNoiseGain(trial.coordinates.values.row(frame).transpose(), weights);
    variance += gain.cwiseProduct(gain);
  }
  for (int c = 0; c < free.count(); ++c) {
    const int column = free.indices()[static_cast<std::size_t>(c)].value();
    const Eigen::VectorXd error = found.values.col(column) - trial.coordinates.values.col(column);
    const double rms = std::sqrt(error.squaredNorm() / static_cast<double>(error.size()));
    const double expected = defaults.marker_noise * std::sqrt(variance[c] / poses);
    // 175 frames: four standard errors of a deviation are 4 / sqrt(350) = 21 %.
    EXPECT_NEAR(rms / expected, 1.0, tol(0.21)) << found.labels[static_cast<std::size_t>(column)];
  }
}

}  // namespace
}  // namespace gaitmill
