#include "core/model/reference_motion.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/simple_models.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

TimeSeries makeSine(const std::string& label) {
  std::vector<double> time;
  for (int i = 0; i <= 400; ++i) {
    time.push_back(0.01 * i);
  }
  TimeSeries table = makeTimeSeries("sine", {label}, time);
  for (int i = 0; i <= 400; ++i) {
    table.values(i, 0) = std::sin(0.01 * i);
  }
  return table;
}

struct Motion {
  Eigen::VectorXd q, q_dot, u, u_dot;
};

Motion evaluate(const TimeSeries& table, double t) {
  const Model model(makeSlider("cart"));
  const FreeCoordinates free(model);
  const ReferenceMotion reference(model, free, table);
  Motion m;
  m.q = m.q_dot = m.u = m.u_dot = Eigen::VectorXd::Constant(1, NAN);
  reference.calcPose(t, m.q, m.q_dot);
  reference.calcSpeed(t, m.u);
  reference.calcAcceleration(t, m.u_dot);
  return m;
}

// Away from the ends the natural end conditions have died out.
TEST(ReferenceMotion, SplinesFollowASine) {
  for (const char* label : {"x", "/jointset/rail/x/value"}) {
    const Motion m = evaluate(makeSine(label), 2.003);
    EXPECT_NEAR(m.q[0], std::sin(2.003), tol(1e-12));
    EXPECT_NEAR(m.q_dot[0], std::cos(2.003), tol(1e-11));
    EXPECT_NEAR(m.u[0], std::cos(2.003), tol(1e-11));
    EXPECT_NEAR(m.u_dot[0], -std::sin(2.003), tol(1e-9));
  }
}

TEST(ReferenceMotion, MissingCoordinateRestsAtZero) {
  const Motion m = evaluate(makeSine("another"), 2.0);
  EXPECT_EQ(m.q[0], 0);
  EXPECT_EQ(m.u_dot[0], 0);
}

TEST(ReferenceMotion, RowOfARepeatedTimeIsDropped) {
  TimeSeries table = makeSine("x");
  table.time[200] = table.time[199];
  table.values(200, 0) = 1000;
  EXPECT_NEAR(evaluate(table, 1.997).q[0], std::sin(1.997), tol(1e-10));
}

TEST(ReferenceMotion, RefusesATableOfFiveRows) {
  try {
    evaluate(makeSine("x").copyRows(0, 4), 0);
    FAIL() << "did not throw";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kTableNoRows);
  }
}

}  // namespace
}  // namespace gaitmill
