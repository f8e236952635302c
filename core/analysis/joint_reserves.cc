#include "core/analysis/joint_reserves.h"

#include <algorithm>
#include <cstddef>
#include <optional>

#include "core/base/error.h"

namespace gaitmill {

namespace {

const JointSpec* findJoint(const std::vector<JointSpec>& joints, const std::string& coordinate) {
  for (const JointSpec& joint : joints) {
    for (const CoordinateSpec& own : joint.coordinates) {
      if (own.name == coordinate) {
        return &joint;
      }
    }
  }
  return nullptr;
}

std::string findCoordinate(const std::vector<ActuatorSpec>& specs, const std::string& actuator) {
  for (const ActuatorSpec& spec : specs) {
    if (spec.name == actuator) {
      return spec.coordinate;
    }
  }
  return "";
}

double findLargestMoment(const JointSpec& joint, const TimeSeries& moments) {
  double largest = 0;
  for (const CoordinateSpec& coordinate : joint.coordinates) {
    if (const std::optional<int> column = moments.findColumn(coordinate.name + "_moment")) {
      largest = std::max(largest, moments.values.col(*column).cwiseAbs().maxCoeff());
    }
  }
  return largest;
}

}  // namespace

std::vector<JointReserve> calcJointReserves(const std::vector<ActuatorStatistics>& reserves,
                                            const std::vector<ActuatorSpec>& specs,
                                            const std::vector<JointSpec>& joints,
                                            const TimeSeries& moments) {
  require(moments.rowCount() > 0, ErrorCode::kTableNoRows, "there are no joint moments");
  std::vector<JointReserve> found;
  for (const ActuatorStatistics& reserve : reserves) {
    const JointSpec* joint = findJoint(joints, findCoordinate(specs, reserve.name));
    const double moment = joint == nullptr ? 0.0 : findLargestMoment(*joint, moments);
    if (moment <= 0) {
      continue;
    }
    const auto known = std::find_if(found.begin(), found.end(), [&](const JointReserve& entry) {
      return entry.joint == joint->name;
    });
    if (known == found.end()) {
      found.push_back({joint->name, reserve.name, reserve.peak, moment});
    } else if (reserve.peak > known->peak) {
      known->actuator = reserve.name;
      known->peak = reserve.peak;
    }
  }
  return found;
}

}  // namespace gaitmill
