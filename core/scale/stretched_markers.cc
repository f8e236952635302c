#include "core/scale/stretched_markers.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/base/error.h"
#include "core/base/where.h"
#include "core/scale/apply_scale.h"

namespace gaitmill {

namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// The model with each group at the given size.
ModelSpec stretch(const ModelSpec& kinematic,
                  const std::vector<ScaleGroup>& groups,
                  const Eigen::VectorXd& sizes) {
  return applyScaleFactors(
      kinematic, calcBodyScales(kinematic, groups, sizes), MassDistribution::kPreserved);
}

/// The body and all bodies between it and ground.
std::set<std::string> findChain(const ModelSpec& model, std::string body) {
  std::map<std::string, std::string> parents;
  for (const JointSpec& joint : model.joints) {
    parents[joint.child.body] = joint.parent.body;
  }
  std::set<std::string> chain;
  while (parents.count(body) > 0 && chain.insert(body).second) {
    body = parents.at(body);
  }
  return chain;
}

}  // namespace

ModelSpec makeKinematicModel(const ModelSpec& model) {
  ModelSpec kinematic;
  kinematic.name = model.name;
  for (const BodySpec& body : model.bodies) {
    BodySpec bare;
    bare.name = body.name;
    kinematic.bodies.push_back(bare);
  }
  kinematic.joints = model.joints;
  kinematic.couplers = model.couplers;
  kinematic.markers = model.markers;
  return kinematic;
}

StretchedMarkers::StretchedMarkers(const ModelSpec& generic,
                                   const std::vector<ScaleGroup>& groups,
                                   const std::vector<std::string>& markers) {
  const ModelSpec kinematic = makeKinematicModel(generic);
  const auto n = static_cast<Eigen::Index>(groups.size());
  for (Eigen::Index g = -1; g < n; ++g) {
    Eigen::VectorXd sizes = Eigen::VectorXd::Zero(n);
    if (g >= 0) {
      sizes[g] = 1;
    }
    models_.emplace_back(stretch(kinematic, groups, sizes));
  }
  for (const Model& model : models_) {
    states_.emplace_back(model);
    locations_.emplace_back();
    for (const std::string& name : markers) {
      const int index = model.spec().findMarker(name);
      require(index >= 0,
              ErrorCode::kModelReference,
              "the model has no marker of this name",
              atMarker(name));
      locations_.back().push_back(model.spec().markers[at(index)].location);
    }
  }
  for (const std::string& name : markers) {
    const MarkerSpec& marker = generic.markers[at(generic.findMarker(name))];
    bodies_.push_back(models_.front().getBody(marker.body));
  }
  findGroups(generic, groups);
}

void StretchedMarkers::findGroups(const ModelSpec& generic, const std::vector<ScaleGroup>& groups) {
  for (const BodyIndex body : bodies_) {
    std::vector<int> moving;
    if (body != kGround) {
      const std::set<std::string> chain = findChain(generic, generic.bodies[at(body.value())].name);
      for (std::size_t g = 0; g < groups.size(); ++g) {
        const bool moves = std::any_of(
            groups[g].shares.begin(), groups[g].shares.end(), [&](const BodyScale& share) {
              return chain.count(share.body) > 0;
            });
        if (moves) {
          moving.push_back(static_cast<int>(g));
        }
      }
    }
    groups_.push_back(std::move(moving));
  }
}

const std::vector<int>& StretchedMarkers::groups(int marker) const {
  return groups_[at(marker)];
}

void StretchedMarkers::setPose(const Eigen::Ref<const Eigen::VectorXd>& q) {
  for (ModelState& state : states_) {
    state.setPose(q);
  }
}

Eigen::Vector3d StretchedMarkers::base(int marker) const {
  return states_.front().pose(bodies_[at(marker)]) * locations_.front()[at(marker)];
}

Eigen::Vector3d StretchedMarkers::column(int group, int marker) const {
  const std::size_t model = at(group) + 1;
  return states_[model].pose(bodies_[at(marker)]) * locations_[model][at(marker)] - base(marker);
}

Eigen::Vector3d StretchedMarkers::screwColumn(int group, int coordinate) const {
  return states_[at(group) + 1].screws().col(coordinate).tail<3>() -
         states_.front().screws().col(coordinate).tail<3>();
}

}  // namespace gaitmill
