#include "core/scale/scale_groups.h"

#include <algorithm>
#include <cstddef>

namespace gaitmill {

namespace {

/// How much a segment varies among people of one height, as a standard deviation relative to its
/// mean. Surveys of adults (Gordon et al. 1989, NATICK/TR-89/044, men: stature 175.6 +- 6.7 cm,
/// foot length 27.0 +- 1.3 cm, biacromial breadth 39.7 +- 1.8 cm) find 4 to 5 % for lengths and
/// breadths of all heights together; the correlation of limb lengths with stature (0.7 to 0.9)
/// leaves 3 to 4 % of it for a leg. The numbers here are wider, because what is fitted is the
/// distance of joint centres of a generic model with proportions of its own, and widest at the
/// pelvis, whose depth and width hardly follow stature.
struct Segment {
  const char* name;
  std::vector<const char*> bodies;  ///< without their side
  bool uneven;
  double deviation;
};

const std::vector<Segment>& segments() {
  static const std::vector<Segment> table = {
      {"pelvis", {"pelvis"}, true, 0.08},
      {"femur", {"femur", "patella"}, false, 0.05},
      {"tibia", {"tibia"}, false, 0.05},
      {"foot", {"talus", "calcn", "toes"}, false, 0.05},
      {"torso", {"torso"}, true, 0.07},
      {"humerus", {"humerus"}, false, 0.05},
      {"forearm", {"ulna", "radius", "hand"}, false, 0.05},
  };
  return table;
}

constexpr double kUnknownDeviation = 0.08;

/// Proportions that vary less than the parts do: thigh to shank, arm to forearm, and the extents of
/// one bone.
const std::vector<SizePair>& pairs() {
  static const std::vector<SizePair> table = {
      {"femur", "tibia", 0.05},
      {"humerus", "forearm", 0.05},
      {"pelvis_x", "pelvis_y", 0.08},
      {"pelvis_y", "pelvis_z", 0.08},
      {"pelvis_x", "pelvis_z", 0.08},
      {"torso_x", "torso_y", 0.07},
      {"torso_y", "torso_z", 0.10},
  };
  return table;
}

std::string stripSide(const std::string& body) {
  const std::size_t n = body.size();
  const bool sided = n > 2 && body[n - 2] == '_' && (body[n - 1] == 'r' || body[n - 1] == 'l');
  return sided ? body.substr(0, n - 2) : body;
}

Segment findSegment(const std::string& stem) {
  for (const Segment& segment : segments()) {
    for (const char* body : segment.bodies) {
      if (stem == body) {
        return segment;
      }
    }
  }
  return {nullptr, {}, false, kUnknownDeviation};
}

ScaleGroup& needGroup(const ScaleGroup& wanted, std::vector<ScaleGroup>& groups) {
  const auto found = std::find_if(groups.begin(), groups.end(), [&](const ScaleGroup& group) {
    return group.name == wanted.name;
  });
  if (found != groups.end()) {
    return *found;
  }
  groups.push_back(wanted);
  return groups.back();
}

bool hasGroup(const std::vector<ScaleGroup>& groups, const std::string& name) {
  return std::any_of(
      groups.begin(), groups.end(), [&](const ScaleGroup& group) { return group.name == name; });
}

}  // namespace

std::vector<ScaleGroup> makeScaleGroups(const ModelSpec& model) {
  std::vector<ScaleGroup> groups;
  for (const BodySpec& body : model.bodies) {
    const std::string stem = stripSide(body.name);
    const Segment segment = findSegment(stem);
    const std::string name = segment.name == nullptr ? stem : segment.name;
    const auto add = [&](const std::string& suffix, const Eigen::Vector3d& axes) {
      needGroup({name + suffix, name, {}, segment.deviation}, groups)
          .shares.push_back({body.name, axes});
    };
    if (segment.uneven) {
      add("_x", Eigen::Vector3d::UnitX());
      add("_y", Eigen::Vector3d::UnitY());
      add("_z", Eigen::Vector3d::UnitZ());
    } else {
      add("", Eigen::Vector3d::Ones());
    }
  }
  return groups;
}

std::vector<SizePair> makeSizePairs(const std::vector<ScaleGroup>& groups) {
  std::vector<SizePair> present;
  for (const SizePair& pair : pairs()) {
    if (hasGroup(groups, pair.first) && hasGroup(groups, pair.second)) {
      present.push_back(pair);
    }
  }
  return present;
}

std::vector<BodyScale> calcBodyScales(const ModelSpec& model,
                                      const std::vector<ScaleGroup>& groups,
                                      const Eigen::Ref<const Eigen::VectorXd>& sizes) {
  std::vector<BodyScale> scales;
  for (const BodySpec& body : model.bodies) {
    scales.push_back({body.name, Eigen::Vector3d::Zero()});
  }
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const BodyScale& share : groups[g].shares) {
      const auto body = static_cast<std::size_t>(model.findBody(share.body));
      scales[body].factors += sizes[static_cast<Eigen::Index>(g)] * share.factors;
    }
  }
  return scales;
}

}  // namespace gaitmill
