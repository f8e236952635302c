#include "core/model/free_coordinates.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/model/model.h"
#include "tests/support/model_files.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

TEST(FreeCoordinates, PatellaFollowsTheKneeAndCarriesItsForce) {
  const Model model(readOwnModel());
  const FreeCoordinates free(model);
  const int knee = model.getCoordinate("knee_angle_r").value();
  const int beta = model.getCoordinate("knee_angle_r_beta").value();
  Eigen::VectorXd q_free = Eigen::VectorXd::Zero(free.count());
  q_free[free.findFree(CoordinateIndex(knee))] = 0.8;
  Eigen::VectorXd q(model.coordinateCount());
  free.expandPose(q_free, q);
  EXPECT_EQ(q[beta], 0.8);
  Eigen::VectorXd tau = Eigen::VectorXd::Zero(model.coordinateCount());
  tau[knee] = 3;
  tau[beta] = 4;
  Eigen::VectorXd tau_free(free.count());
  free.reduceForces(tau, tau_free);
  EXPECT_EQ(tau_free[free.findFree(CoordinateIndex(knee))], 7);
  EXPECT_EQ(free.findFree(CoordinateIndex(beta)), -1);
  EXPECT_EQ(free.findFree(model.getCoordinate("subtalar_angle_r")), -1);
}

// J^T M J of the elimination is the mass matrix of the motion it expands: u^T M u = u_f^T M_f u_f.
TEST(FreeCoordinates, ReducedMassMatrixHasTheSameKineticEnergy) {
  const Model model(readOwnModel());
  const FreeCoordinates free(model);
  const int n = model.coordinateCount();
  ModelState state(model);
  Eigen::VectorXd u_free(free.count());
  for (int i = 0; i < free.count(); ++i) {
    u_free[i] = 0.3 * (i % 7) - 0.8;
  }
  Eigen::VectorXd u(n);
  free.expandRates(u_free, u);
  state.setMotion(model.defaultPose(), u);
  Eigen::MatrixXd M(n, n), M_free(free.count(), free.count());
  state.calcMassMatrix(M);
  free.reduceMassMatrix(M, M_free);
  EXPECT_NEAR(0.5 * u_free.dot(M_free * u_free),
              state.calcKineticEnergy(),
              tol(1e-11) * state.calcKineticEnergy());
}

TEST(FreeCoordinates, ConformingAPoseIsExpandingItsFreePart) {
  const Model model(readOwnModel());
  const FreeCoordinates free(model);
  Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(model.coordinateCount(), 0.1, 1.0);
  Eigen::VectorXd q_free(free.count()), expanded(model.coordinateCount());
  free.pick(q, q_free);
  free.expandPose(q_free, expanded);
  free.conformPose(q);
  EXPECT_EQ((q - expanded).norm(), 0.0);
  EXPECT_EQ(q[model.getCoordinate("mtp_angle_l").value()], 0.0);  // locked at its default
}

TEST(FreeCoordinates, CurvedCouplersAreRefusedByName) {
  ModelSpec spec = readOwnModel();
  spec.couplers[0].function = {FunctionSpec::Kind::kPolynomial, {}, {1, 0, 0}, 1};
  try {
    const FreeCoordinates free{Model(spec)};
    FAIL() << "did not throw";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kModelUnsupported);
    EXPECT_EQ(error.where().field, spec.couplers[0].name);
  }
}

}  // namespace
}  // namespace gaitmill
