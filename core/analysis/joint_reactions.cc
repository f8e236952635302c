#include "core/analysis/joint_reactions.h"

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/analysis/force_replay.h"

namespace gaitmill {

namespace {

constexpr Eigen::Index kColumnsPerFrame = 9;

TimeSeries makeTable(const Model& model, const std::vector<double>& time) {
  TimeSeries table = makeTimeSeries("joint_reactions", {}, time);
  for (const JointSpec& joint : model.spec().joints) {
    const std::string& child = joint.child.body;
    for (const std::string& frame : {child, std::string("ground")}) {
      for (const char* component : {"fx", "fy", "fz", "mx", "my", "mz", "px", "py", "pz"}) {
        table.labels.push_back(joint.name + "_on_" + child + "_in_" + frame + "_" + component);
        table.units.emplace_back(component[0] == 'f' ? "N" : component[0] == 'm' ? "N.m" : "m");
      }
    }
  }
  table.values.resize(table.rowCount(), table.columnCount());
  return table;
}

}  // namespace

TimeSeries calcJointReactions(const Model& model, const ForceRecord& record) {
  ForceReplay replay(model, record);
  TimeSeries table = makeTable(model, replay.times());
  std::vector<BodyIndex> children;
  for (const JointSpec& joint : model.spec().joints) {
    children.push_back(model.getBody(joint.child.body));
  }
  Matrix6X wrenches;
  for (int row = 0; row < replay.rowCount(); ++row) {
    replay.setRow(row);
    ModelState& state = replay.state();
    state.calcJointWrenches(replay.calcAcceleration(), replay.calcBodyForces(), wrenches);
    for (std::size_t j = 0; j < children.size(); ++j) {
      const Pose& X_GB = state.pose(children[j]);
      const Eigen::Vector3d p = state.findJointCenter(static_cast<int>(j));
      const Eigen::Vector3d F = wrenches.col(children[j].value()).tail<3>();
      const Eigen::Vector3d M = wrenches.col(children[j].value()).head<3>() - p.cross(F);
      const Eigen::Matrix3d R_BG = X_GB.R.transpose();
      const auto first = static_cast<Eigen::Index>(j) * 2 * kColumnsPerFrame;
      table.values.row(row).segment(first, 2 * kColumnsPerFrame) << (R_BG * F).transpose(),
          (R_BG * M).transpose(), (R_BG * (p - X_GB.p)).transpose(), F.transpose(), M.transpose(),
          p.transpose();
    }
  }
  return table;
}

}  // namespace gaitmill
