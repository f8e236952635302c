#pragma once

#include <string>
#include <vector>

#include "core/data/model_spec.h"
#include "core/scale/scale_result.h"

namespace gaitmill {

/// One size of the subject: a factor that stretches some bodies along some axes. The factors of a
/// body are the sum over the groups of factor x share.
struct ScaleGroup {
  std::string name;               ///< "femur", "pelvis_x"
  std::string segment;            ///< "femur", "pelvis"
  std::vector<BodyScale> shares;  ///< per body of the group: 1 along the axes that it stretches
  /// Standard deviation of the factor about height / generic height, relative.
  double deviation = 0;
};

/// Two sizes that go together.
struct SizePair {
  std::string first;
  std::string second;
  double deviation = 0;  ///< standard deviation of their difference, relative
};

/// The sizes that are fitted to a motion, every body in exactly one segment: left and right share
/// theirs; the patella goes with the femur, talus and toes with the calcaneus, radius and hand with
/// the ulna; pelvis and torso stretch unevenly, the others evenly, which keeps the axes of the knee
/// and the cylinders around it in shape. A body of another name is a segment of its own.
std::vector<ScaleGroup> makeScaleGroups(const ModelSpec& model);

/// Pairs of groups of the model.
std::vector<SizePair> makeSizePairs(const std::vector<ScaleGroup>& groups);

/// Factors of every body, in model order. @param sizes (n_groups)
std::vector<BodyScale> calcBodyScales(const ModelSpec& model,
                                      const std::vector<ScaleGroup>& groups,
                                      const Eigen::Ref<const Eigen::VectorXd>& sizes);

}  // namespace gaitmill
