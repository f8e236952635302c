#include "core/data/marker_trajectories.h"

#include <algorithm>
#include <iterator>

namespace gaitmill {

std::optional<int> MarkerTrajectories::findMarker(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    return std::nullopt;
  }
  return static_cast<int>(std::distance(names.begin(), found));
}

bool MarkerTrajectories::isMissing(int frame, int marker) const {
  return !positions.row(frame).segment<3>(3 * marker).allFinite();
}

}  // namespace gaitmill
