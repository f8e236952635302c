#include "core/cmc/excitation_limits.h"

#include <cstddef>
#include <string>

#include "core/base/error.h"
#include "core/base/where.h"

namespace gaitmill {
namespace {

// Window times are sums of 10 ms steps; a node within their round-off counts as passed, as in the
// published run (spec/cmc.md 1).
constexpr double kTimeRoundOff = 1e-9;

}  // namespace

ExcitationLimits::ExcitationLimits(const ModelSpec& model, const CmcOptions& options)
    : max_excitation_(options.max_excitation), nodes_(model.muscles.size()) {
  for (const ExcitationLimit& limit : options.excitation_limits) {
    const int muscle = model.findMuscle(limit.muscle);
    Where where = atMuscle(limit.muscle);
    where.field = "excitation_limits";
    require(muscle >= 0,
            ErrorCode::kSettingsValue,
            "cmc: excitation limit for '" + limit.muscle + "', which is no muscle of the model",
            where);
    auto& nodes = nodes_[static_cast<std::size_t>(muscle)];
    require(nodes.empty(),
            ErrorCode::kSettingsValue,
            "cmc: two excitation limits for '" + limit.muscle + "'",
            where);
    nodes = limit.nodes;
  }
}

double ExcitationLimits::findUpper(int muscle, double t) const {
  const auto& nodes = nodes_[static_cast<std::size_t>(muscle)];
  if (nodes.empty()) {
    return max_excitation_;
  }
  for (const ExcitationLimit::Node& node : nodes) {
    if (t < node.time - kTimeRoundOff) {
      return node.upper;
    }
  }
  return nodes.back().upper;
}

}  // namespace gaitmill
