#include "core/validation/isometric_moments.h"

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/validation/isometric_figure.h"
#include "tests/support/model_files.h"
#include "tests/support/shared_data.h"
#include "tests/support/simple_models.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

MuscleSpec makeMuscle(const std::string& name, double ground_x) {
  MuscleSpec muscle;
  muscle.name = name;
  muscle.max_isometric_force = 1000;
  muscle.optimal_fiber_length = 0.1;
  muscle.tendon = TendonKind::kRigid;
  muscle.path = {{"ground", {ground_x, 0, 0}}, {"bob", {0, -0.4, 0}}};
  return muscle;
}

// Two mirrored muscles on a pendulum, 0.3 m to either side of the pin and 0.4 m below it: paths of
// 0.5 m with arms of 0.3 * 0.4/0.5 = 0.24 m. The one in front (+x) turns the rod forwards (+z).
TEST(IsometricMoments, PendulumByHand) {
  ModelSpec model = makePendulum(1, 0.4);
  MuscleSpec front = makeMuscle("front", 0.3);
  MuscleSpec back = makeMuscle("back", -0.3);
  front.tendon_slack_length = 0.5 - 0.1;  // optimal: 1000 N active, no passive force
  back.tendon_slack_length = 0.5 - 0.17;  // 1.7 l0M: passive force 1, active 0.218883310162
  model.muscles = {front, back};
  PosedMuscles posed(model);
  const IsometricMoments moments =
      calcIsometricMoments(posed, posed.model().getCoordinate("angle"));
  EXPECT_NEAR(moments.positive, 0.24 * 1000 - 0.24 * 1000, tol(1e-9));
  EXPECT_NEAR(moments.negative, -0.24 * 1000 * (1 + 0.218883310162), tol(1e-6));
  EXPECT_NEAR(moments.passive, -0.24 * 1000, tol(1e-9));
}

// Fiber length at rest by bisection on the balance itself, from the normalised curves
// (spec/muscle.md 7), independent of Muscle.
double findForceByBisection(const MuscleSpec& m, double activation, double path_length) {
  const MuscleCurves curves(m.curves);
  const double height = m.optimal_fiber_length * std::sin(m.pennation_at_optimal);
  const auto balance = [&](double length) {
    const double cos = std::sqrt(1 - height * height / (length * length));
    const double norm = length / m.optimal_fiber_length;
    return (activation * curves.active_force_length.calcBySolving(norm).value +
            curves.passive_force_length.calcBySolving(norm).value) *
               cos -
           curves.tendon_force_length
               .calcBySolving((path_length - length * cos) / m.tendon_slack_length)
               .value;
  };
  double low = std::max(0.25 * m.optimal_fiber_length, height / std::sin(m.maximum_pennation));
  double high = std::hypot(path_length, height);
  if (balance(low) > 0) {
    return 0;
  }
  for (int i = 0; i < 200; ++i) {
    (balance(0.5 * (low + high)) > 0 ? high : low) = 0.5 * (low + high);
  }
  const double cos = std::sqrt(1 - height * height / (low * low));
  return m.max_isometric_force *
         curves.tendon_force_length.calcBySolving((path_length - low * cos) / m.tendon_slack_length)
             .value;
}

// All plantarflexors have elastic tendons; each solved anew, summed by hand.
TEST(IsometricMoments, PlantarflexionIsTheSumOfSeparatelySolvedMuscles) {
  PosedMuscles posed(readOwnModel());
  const CoordinateIndex ankle = posed.model().getCoordinate("ankle_angle_r");
  for (const double angle_deg : {-25.0, 0.0, 15.0}) {
    posed.setPose({{"knee_angle_r", toRadians(80)}, {"ankle_angle_r", toRadians(angle_deg)}});
    double expected = 0;
    for (int i = 0; i < posed.model().muscleCount(); ++i) {
      const MuscleIndex m(i);
      const MuscleSpec& spec = posed.model().spec().muscles[static_cast<std::size_t>(i)];
      const double arm = posed.findMomentArm(m, ankle);
      if (arm == 0) {
        continue;
      }
      ASSERT_EQ(spec.tendon, TendonKind::kElastic) << spec.name;
      expected += arm * (arm < 0 ? findForceByBisection(spec, 1, posed.findLength(m))
                                 : posed.calcForce(m, 0).passive);
    }
    EXPECT_NEAR(calcIsometricMoments(posed, ankle).negative, expected, tol(1e-6)) << angle_deg;
  }
}

const Panel& findPanel(const Figure& figure, const std::string& name) {
  for (const Panel& panel : figure.panels) {
    if (panel.name == name) {
      return panel;
    }
  }
  ADD_FAILURE() << "no panel " << name;
  return figure.panels.front();
}

double readAt(const Series& series, double x) {
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (std::abs(series.x[i] - x) < 0.01) {
      return series.y[i];
    }
  }
  ADD_FAILURE() << series.name << " has no " << x;
  return NAN;
}

TEST(IsometricFigure, ShowsTheMomentsOfThePapersPoses) {
  const ModelSpec model = readOwnModel();
  const Figure figure = makeIsometricFigure(model);
  ASSERT_EQ(figure.panels.size(), 7u);
  PosedMuscles posed(model);
  posed.setPose({{"hip_flexion_r", toRadians(70)}, {"knee_angle_r", toRadians(60)}});
  const IsometricMoments knee =
      calcIsometricMoments(posed, posed.model().getCoordinate("knee_angle_r"));
  // The sweep ends at the document's ranges, which state angles to 1e-8 rad.
  const Panel& active = findPanel(figure, "knee_active");
  EXPECT_NEAR(readAt(active.series[0], 60), knee.positive, tol(1e-6));
  EXPECT_NEAR(readAt(active.series[1], 60), knee.negative, tol(1e-6));
  EXPECT_NEAR(readAt(findPanel(figure, "knee_passive").series[0], 60), knee.passive, tol(1e-6));
  posed.setPose({{"hip_flexion_r", toRadians(30)}, {"knee_angle_r", toRadians(10)}});
  const IsometricMoments hip =
      calcIsometricMoments(posed, posed.model().getCoordinate("hip_flexion_r"));
  EXPECT_NEAR(
      readAt(findPanel(figure, "hip_flexion_active").series[1], 30), hip.negative, tol(1e-6));
}

TEST(IsometricFigure, AgonistsPullTheirWay) {
  const Figure figure = makeIsometricFigure(readOwnModel());
  for (const char* name : {"knee_active", "ankle_active", "hip_adduction_active"}) {
    const Panel& panel = findPanel(figure, name);
    for (std::size_t i = 0; i < panel.series[0].x.size(); ++i) {
      EXPECT_GT(panel.series[0].y[i], panel.series[1].y[i]) << name;
    }
  }
}

class FiberReference : public SharedDataTest {};

// Forces at rest in the reference's poses: tendon force of every muscle at three activations.
TEST_F(FiberReference, StaticForcesAgree) {
  const CsvTable csv = readCsv(shared("reference/model_rajagopal2016/fibers.csv"));
  const CsvTable paths = readCsv(shared("reference/model_rajagopal2016/muscle_tendon.csv"));
  const ModelSpec model = readModelFile(shared("data/models/Rajagopal2016.osim"));
  const std::vector<Muscle> muscles = makeMuscles(model.muscles);
  std::map<std::string, double> path_length;
  for (std::size_t r = 0; r < paths.rows.size(); ++r) {
    path_length[paths.rows[r][0] + paths.rows[r][1]] = paths.number(static_cast<int>(r), 2);
  }
  int compared = 0;
  for (std::size_t r = 0; r < csv.rows.size(); ++r) {
    if (csv.rows[r][2] != "static_equilibrium") {
      continue;
    }
    const int row = static_cast<int>(r);
    const auto m = static_cast<std::size_t>(model.findMuscle(csv.rows[r][1]));
    const double length = path_length.at(csv.rows[r][0] + csv.rows[r][1]);
    const double expected = csv.number(row, csv.column("tendon_force_N"));
    const IsometricForce force = calcIsometricForce(muscles[m], csv.number(row, 3), length);
    // Both solve to 1e-8 of the maximum force; lengths are printed to 10 digits.
    EXPECT_NEAR(force.total, expected, tol(2e-6) * model.muscles[m].max_isometric_force)
        << csv.rows[r][0] << " " << csv.rows[r][1];
    ++compared;
  }
  EXPECT_GT(compared, 1000);
}

}  // namespace
}  // namespace gaitmill
