#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "core/data/model_spec.h"
#include "core/model/model.h"
#include "core/model/topology.h"

namespace gaitmill {

/// The Simbody side of a Model: the only place that knows Simbody. Private to core/model. Constant
/// after construction; what changes is in a State.
class MultibodyTree {
 public:
  class State {
   public:
    ~State();

   private:
    friend class MultibodyTree;
    State();
    struct Impl;
    std::unique_ptr<Impl> impl_;
  };

  MultibodyTree(const ModelSpec& spec, const Topology& topology);
  ~MultibodyTree();

  std::unique_ptr<State> makeState() const;

  /// Realizes positions. @param poses (n_bodies) X_GB @param screws (6 x n_coordinates), at ground
  /// origin
  void calcPositions(State& state,
                     const Eigen::Ref<const Eigen::VectorXd>& q,
                     std::vector<Pose>& poses,
                     Matrix6X& screws) const;
  /// Realizes velocities at the last positions.
  void calcVelocities(State& state, const Eigen::Ref<const Eigen::VectorXd>& u) const;
  /// tau = M udot + C, without gravity and external forces. Needs velocities.
  void calcInertialForces(State& state,
                          const Eigen::Ref<const Eigen::VectorXd>& udot,
                          Eigen::Ref<Eigen::VectorXd> tau) const;
  /// Accelerations of all bodies, (6 x n_bodies): angular, then of the body's origin, in ground.
  /// Needs velocities.
  void calcAccelerations(State& state,
                         const Eigen::Ref<const Eigen::VectorXd>& udot,
                         Matrix6X& accelerations) const;

 private:
  struct Impl;
  static void addJoint(Impl& impl, const ModelSpec& spec, const Topology& topology, std::size_t j);

  std::unique_ptr<Impl> impl_;
};

}  // namespace gaitmill
