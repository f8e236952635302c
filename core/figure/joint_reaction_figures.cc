// Figures of the loads in the joints of the leg.
#include <cmath>
#include <cstddef>

#include "core/figure/job_builders.h"

namespace gaitmill {

namespace {

/// A joint by its distal body, whose frame has x forward, y upward and z to the right.
struct ReactionJoint {
  const char* child;
  const char* title;
};
constexpr ReactionJoint kJoints[] = {
    {"femur", "Hip"}, {"tibia", "Tibiofemoral"}, {"patella", "Patellofemoral"}, {"talus", "Ankle"}};

/// Index of the column "<joint>_on_<child>_in_<child>_<component>"; joints have many names.
std::optional<int> findReaction(const TimeSeries& table,
                                const std::string& child,
                                const std::string& component) {
  const std::string end = "_on_" + child + "_in_" + child + "_" + component;
  for (int column = 0; column < table.columnCount(); ++column) {
    const std::string& label = table.labels[static_cast<std::size_t>(column)];
    if (label.size() > end.size() &&
        label.compare(label.size() - end.size(), end.size(), end) == 0) {
      return column;
    }
  }
  return std::nullopt;
}

/// "<quantity>_r" and "<quantity>_l" of one joint [N]: resultant, forward, compression, lateral.
TimeSeries calcReactions(const TimeSeries& reactions, const std::string& child) {
  TimeSeries table = makeEmptyTable(reactions);
  for (const Side side : {Side::kRight, Side::kLeft}) {
    const std::string letter = std::string("_") + sideLetter(side);
    const std::optional<int> fx = findReaction(reactions, child + letter, "fx");
    const std::optional<int> fy = findReaction(reactions, child + letter, "fy");
    const std::optional<int> fz = findReaction(reactions, child + letter, "fz");
    if (!fx || !fy || !fz) {
      continue;
    }
    const Eigen::VectorXd forward = reactions.values.col(*fx);
    const Eigen::VectorXd down = -reactions.values.col(*fy);
    const Eigen::VectorXd lateral = (side == Side::kRight ? 1.0 : -1.0) * reactions.values.col(*fz);
    const Eigen::VectorXd resultant =
        (forward.array().square() + down.array().square() + lateral.array().square()).sqrt();
    addColumn("resultant" + letter, resultant, table);
    addColumn("forward" + letter, forward, table);
    addColumn("down" + letter, down, table);
    addColumn("lateral" + letter, lateral, table);
  }
  return table;
}

struct ReactionQuantity {
  const char* column;
  const char* title;
};
constexpr ReactionQuantity kQuantities[] = {{"resultant", "resultant"},
                                            {"forward", "forward"},
                                            {"down", "downward"},
                                            {"lateral", "lateral"}};

}  // namespace

void buildJointReactions(const JobData& data, Figure& figure) {
  const TimeSeries& reactions = data.table("joint_reactions");
  const std::optional<double> weight = data.findBodyWeight();
  for (const ReactionJoint& joint : kJoints) {
    const TimeSeries table = calcReactions(reactions, joint.child);
    if (table.columnCount() == 0) {
      continue;
    }
    for (const ReactionQuantity& quantity : kQuantities) {
      Panel panel = makePanel(data,
                              std::string(joint.child) + "_" + quantity.column,
                              std::string(joint.title) + ", " + quantity.title,
                              {"Force", weight ? "BW" : "N"});
      const std::string column = quantity.column;
      data.addSides(
          table, {column, column + "_r", column + "_l", ""}, weight ? 1 / *weight : 1, panel);
      data.addToeOffs(panel);
      figure.panels.push_back(std::move(panel));
    }
  }
  figure.caption += " " + data.describeAxis();
}

}  // namespace gaitmill
