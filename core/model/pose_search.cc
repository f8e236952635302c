#include "core/model/pose_search.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/base/error.h"
#include "core/base/units.h"

namespace gaitmill {

namespace {

/// A body whose own markers are fewer does not show all three rotations.
constexpr int kMarkersOfABody = 3;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

}  // namespace

PoseSearch::PoseSearch(const Model& model, MarkerFit& fit) : model_(model), fit_(fit) {
  findLimbs();
}

void PoseSearch::findLimbs() {
  std::vector<std::pair<int, Limb>> by_depth;
  for (const JointSpec& joint : model_.spec().joints) {
    Limb limb = makeLimb(joint);
    if (limb.first.isValid()) {
      const BodyIndex child = model_.getBody(joint.child.body);
      int depth = 0;
      for (int c = 0; c < model_.coordinateCount(); ++c) {
        depth += model_.isDistal(CoordinateIndex(c), child) ? 1 : 0;
      }
      by_depth.emplace_back(depth, std::move(limb));
    }
  }
  std::stable_sort(by_depth.begin(), by_depth.end(), [](const auto& a, const auto& b) {
    return a.first < b.first;
  });
  for (auto& [depth, limb] : by_depth) {
    limbs_.push_back(std::move(limb));
  }
}

PoseSearch::Limb PoseSearch::makeLimb(const JointSpec& joint) const {
  const FreeCoordinates& free = fit_.freeCoordinates();
  Limb limb;
  limb.is_root = joint.parent.body == "ground";
  limb.own.coordinates.assign(at(free.count()), false);
  for (const CoordinateSpec& spec : joint.coordinates) {
    const CoordinateIndex c = model_.getCoordinate(spec.name);
    const int f = free.findFree(c);
    if (f < 0) {
      continue;
    }
    limb.first = limb.first.isValid() ? limb.first : c;
    limb.own.coordinates[at(f)] = true;
    if (model_.motionKind(c) == MotionKind::kRotational) {
      limb.rotations.push_back(c.value());
    }
  }
  if (limb.first.isValid()) {
    addOutward(joint, limb);
  }
  return limb;
}

// The markers that the joint moves, and the coordinates of the joints whose parent it moves.
void PoseSearch::addOutward(const JointSpec& joint, Limb& limb) const {
  const FreeCoordinates& free = fit_.freeCoordinates();
  const BodyIndex child = model_.getBody(joint.child.body);
  for (std::size_t m = 0; m < fit_.markers().size(); ++m) {
    const BodyIndex body = fit_.body(static_cast<int>(m));
    limb.own.markers.push_back(body == child);
    limb.outward.markers.push_back(model_.isDistal(limb.first, body));
  }
  limb.outward.coordinates = limb.own.coordinates;
  for (const JointSpec& other : model_.spec().joints) {
    if (!model_.isDistal(limb.first, model_.getBody(other.parent.body))) {
      continue;
    }
    for (const CoordinateSpec& spec : other.coordinates) {
      const int f = free.findFree(model_.getCoordinate(spec.name));
      if (f >= 0) {
        limb.outward.coordinates[at(f)] = true;
      }
    }
  }
}

bool PoseSearch::isWellSeen(const FitScope& scope,
                            const Eigen::Ref<const Eigen::Matrix3Xd>& measured) const {
  int visible = 0;
  for (std::size_t m = 0; m < scope.markers.size(); ++m) {
    const bool seen = measured.col(static_cast<Eigen::Index>(m)).allFinite();
    visible += scope.markers[m] && seen ? 1 : 0;
  }
  return visible >= kMarkersOfABody;
}

std::vector<Eigen::VectorXd> PoseSearch::makeStarts(const Limb& limb,
                                                    const Eigen::VectorXd& q) const {
  std::vector<Eigen::VectorXd> starts = {q};
  // A hinge has no trap worth a search; the root may face any way.
  if (limb.rotations.size() < 3) {
    return starts;
  }
  for (const int c : limb.rotations) {
    for (const double turn : {-0.5 * kPi, 0.5 * kPi, kPi}) {
      if (turn == kPi && !limb.is_root) {
        continue;
      }
      starts.push_back(q);
      starts.back()[c] += turn;
    }
  }
  return starts;
}

MarkerFitSummary PoseSearch::fitFromBestStart(const Eigen::Ref<const Eigen::Matrix3Xd>& measured,
                                              const Limb& limb,
                                              const FitScope& scope,
                                              Eigen::Ref<Eigen::VectorXd> q) {
  MarkerFitSummary best;
  best.objective = std::numeric_limits<double>::infinity();
  Eigen::VectorXd best_q = q;
  for (Eigen::VectorXd& start : makeStarts(limb, q)) {
    const MarkerFitSummary summary = fit_.solve(measured, scope, start);
    // Equal up to rounding means the same minimum: keep the first.
    if (summary.objective < best.objective * (1 - 1e-9)) {
      best = summary;
      best_q = start;
    }
  }
  q = best_q;
  return best;
}

MarkerFitSummary PoseSearch::solve(const Eigen::Ref<const Eigen::Matrix3Xd>& measured,
                                   Eigen::Ref<Eigen::VectorXd> q) {
  q = model_.defaultPose();
  for (const Limb& limb : limbs_) {
    if (isWellSeen(limb.own, measured)) {
      fitFromBestStart(measured, limb, limb.own, q);
    } else if (isWellSeen(limb.outward, measured)) {
      fitFromBestStart(measured, limb, limb.outward, q);
    }
  }
  MarkerFitSummary best = fit_.solve(measured, q);
  // Once more around every ball joint, now that its surroundings are in place.
  for (const Limb& limb : limbs_) {
    if (limb.rotations.size() < 3 || limb.is_root || !isWellSeen(limb.outward, measured)) {
      continue;
    }
    Eigen::VectorXd candidate = q;
    fitFromBestStart(measured, limb, limb.outward, candidate);
    const MarkerFitSummary summary = fit_.solve(measured, candidate);
    if (summary.objective < best.objective * (1 - 1e-9)) {
      best = summary;
      q = candidate;
    }
  }
  return fit_.solve(measured, q);
}

}  // namespace gaitmill
