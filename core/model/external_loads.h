#pragma once

#include <vector>

#include "core/data/ground_reaction.h"
#include "core/model/model.h"

namespace gaitmill {

/// Ground reactions as wrenches on bodies at any time. Interpolates the force and the moment about
/// the ground origin (p x F + T, smooth and zero in swing) with natural cubic splines, so that the
/// centre of pressure of an unloaded plate, which means nothing, is never touched
/// (spec/formats.md 3.3). Beyond the record the loads are zero. Immutable, may be shared between
/// threads.
class ExternalLoads {
 public:
  /// @throws Error kModelReference if a body is unknown, kTableShape if there are fewer than 4 rows
  ExternalLoads(const Model& model, const GroundReaction& reaction);
  ~ExternalLoads();
  ExternalLoads(ExternalLoads&&) noexcept;
  ExternalLoads(const ExternalLoads&) = delete;
  ExternalLoads& operator=(const ExternalLoads&) = delete;

  int count() const;
  /// Wrenches at time t [s], one per force, in the order of the ground reaction. `wrenches` is
  /// resized on first use only.
  void calc(double t, std::vector<BodyWrench>& wrenches) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gaitmill
