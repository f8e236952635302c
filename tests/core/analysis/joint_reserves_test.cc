#include "core/analysis/joint_reserves.h"

#include <gtest/gtest.h>

namespace gaitmill {
namespace {

JointSpec makeJoint(const std::string& name, const std::vector<std::string>& coordinates) {
  JointSpec joint;
  joint.name = name;
  for (const std::string& coordinate : coordinates) {
    joint.coordinates.emplace_back();
    joint.coordinates.back().name = coordinate;
  }
  return joint;
}

ActuatorSpec makeReserve(const std::string& coordinate) {
  ActuatorSpec spec;
  spec.name = coordinate + "_reserve";
  spec.coordinate = coordinate;
  return spec;
}

class JointReservesTest : public ::testing::Test {
 protected:
  JointReservesTest() { moments_.values << 10, -80, 30, -60, 5, 40; }
  std::vector<JointSpec> joints_ = {makeJoint("hip_r", {"hip_flexion_r", "hip_rotation_r"}),
                                    makeJoint("knee_r", {"knee_angle_r"})};
  std::vector<ActuatorSpec> specs_ = {
      makeReserve("hip_flexion_r"), makeReserve("hip_rotation_r"), makeReserve("knee_angle_r")};
  TimeSeries moments_ = makeTimeSeries(
      "moments", {"hip_rotation_r_moment", "hip_flexion_r_moment", "knee_angle_r_moment"}, {0, 1});
};

TEST_F(JointReservesTest, HoldTheLargestOfAJointAgainstItsLargestMoment) {
  const std::vector<JointReserve> found = calcJointReserves({{"hip_flexion_r_reserve", 1, 0.5},
                                                             {"hip_rotation_r_reserve", 4, 2},
                                                             {"knee_angle_r_reserve", 2, 1}},
                                                            specs_,
                                                            joints_,
                                                            moments_);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].joint, "hip_r");
  EXPECT_EQ(found[0].actuator, "hip_rotation_r_reserve");
  EXPECT_EQ(found[0].peak, 4);
  EXPECT_EQ(found[0].joint_moment, 80);
  EXPECT_EQ(found[1].joint, "knee_r");
  EXPECT_EQ(found[1].joint_moment, 40);
}

TEST_F(JointReservesTest, LeaveOutJointsWithoutAMoment) {
  joints_.push_back(makeJoint("ankle_r", {"ankle_angle_r"}));
  specs_.push_back(makeReserve("ankle_angle_r"));
  EXPECT_TRUE(
      calcJointReserves({{"ankle_angle_r_reserve", 1, 1}}, specs_, joints_, moments_).empty());
}

}  // namespace
}  // namespace gaitmill
