#include "core/model/coordinate_movers.h"

#include <string>

#include "core/base/error.h"

namespace gaitmill {

namespace {

/// Place of a coordinate inside its joint: translations come before rotations, rotations in the
/// order of their axes (spec/model.md 4.1). -1 if it moves several axes and has no single place.
int findRank(const JointSpec& joint, const std::string& coordinate) {
  if (joint.kind == JointSpec::Kind::kPlanar) {
    return joint.coordinates.front().name == coordinate ? 1 : 0;
  }
  if (joint.kind != JointSpec::Kind::kCustom) {
    int place = 1;
    for (const CoordinateSpec& candidate : joint.coordinates) {
      if (candidate.name == coordinate) {
        return place;
      }
      ++place;
    }
  }
  int rank = -1;
  for (std::size_t i = 0; i < joint.axes.size(); ++i) {
    if (joint.axes[i].coordinate == coordinate) {
      if (rank >= 0) {
        return -1;
      }
      rank = i < 3 ? static_cast<int>(i) + 1 : 0;
    }
  }
  return rank;
}

struct JointPlace {
  BodyIndex parent;
  int joint = -1;
  int rank = -1;
};

JointPlace findJointPlace(const Model& model, int coordinate) {
  const std::string& name = model.coordinateNames()[static_cast<std::size_t>(coordinate)];
  const std::vector<JointSpec>& joints = model.spec().joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    for (const CoordinateSpec& candidate : joints[j].coordinates) {
      if (candidate.name == name) {
        return {
            model.getBody(joints[j].parent.body), static_cast<int>(j), findRank(joints[j], name)};
      }
    }
  }
  check(false, "CoordinateMovers: a coordinate belongs to no joint");
  return {};
}

}  // namespace

CoordinateMovers::CoordinateMovers(const Model& model, const FreeCoordinates& free) {
  // Slope of each model coordinate against the free one it follows: columns of the constant J.
  Eigen::VectorXd rates = Eigen::VectorXd::Zero(free.count());
  Eigen::VectorXd full(model.coordinateCount());
  for (int f = 0; f < free.count(); ++f) {
    rates.setZero();
    rates[f] = 1;
    free.expandRates(rates, full);
    for (int c = 0; c < model.coordinateCount(); ++c) {
      if (full[c] != 0) {
        all_.push_back({c, f, full[c]});
      }
    }
  }
  of_body_.resize(static_cast<std::size_t>(model.bodyCount()));
  for (int b = 0; b < model.bodyCount(); ++b) {
    for (const Mover& mover : all_) {
      if (model.isDistal(CoordinateIndex(mover.coordinate), BodyIndex(b))) {
        of_body_[static_cast<std::size_t>(b)].push_back(mover);
      }
    }
  }
  findProximalPairs(model);
}

const std::vector<CoordinateMovers::Mover>& CoordinateMovers::of(BodyIndex body) const {
  return body == kGround ? none_ : of_body_[static_cast<std::size_t>(body.value())];
}

void CoordinateMovers::findProximalPairs(const Model& model) {
  std::vector<JointPlace> places;
  for (const Mover& mover : all_) {
    places.push_back(findJointPlace(model, mover.coordinate));
  }
  for (std::size_t j = 0; j < places.size(); ++j) {
    for (std::size_t k = 0; k < places.size(); ++k) {
      const bool same_joint = places[j].joint == places[k].joint;
      const bool upstream = model.isDistal(CoordinateIndex(all_[j].coordinate), places[k].parent);
      const bool earlier = places[j].rank >= 0 && places[j].rank < places[k].rank;
      if (j == k || (same_joint && earlier) || (!same_joint && upstream)) {
        proximal_pairs_.emplace_back(j, k);
      }
    }
  }
}

}  // namespace gaitmill
