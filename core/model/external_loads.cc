#include "core/model/external_loads.h"

#include <cstddef>
#include <memory>

#include <Eigen/Geometry>

#include "core/base/error.h"
#include "core/math/natural_spline.h"

namespace gaitmill {

namespace {

/// More plates than a laboratory has; keeps the evaluation off the heap.
constexpr int kMaxForces = 16;
constexpr int kMaxColumns = 6 * kMaxForces;

}  // namespace

struct ExternalLoads::Impl {
  std::vector<BodyIndex> bodies;
  double start = 0;
  double end = 0;
  /// 6 columns per force: moment about the ground origin, force.
  std::unique_ptr<NaturalSpline> spline;
};

namespace {

/// (n x 6) moment about the ground origin and force; rows without force are exactly zero, so that
/// the meaningless centre of pressure of an unloaded plate drops out.
RowMatrix calcWrenchRows(const ExternalForce& force) {
  const int n = static_cast<int>(force.force.cols());
  RowMatrix rows = RowMatrix::Zero(n, 6);
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d F = force.force.col(i);
    const Eigen::Vector3d T = force.torque.col(i);
    if (F.isZero(0.0) && T.isZero(0.0)) {
      continue;
    }
    const Eigen::Vector3d p = force.point.col(i);
    rows.row(i) << (p.cross(F) + T).transpose(), F.transpose();
  }
  return rows;
}

}  // namespace

ExternalLoads::ExternalLoads(const Model& model, const GroundReaction& reaction)
    : impl_(std::make_unique<Impl>()) {
  if (reaction.forces.empty()) {
    return;
  }
  const int n = static_cast<int>(reaction.time.size());
  const int count = static_cast<int>(reaction.forces.size());
  require(n >= 4,
          ErrorCode::kTableShape,
          "ground reactions need at least 4 rows, found " + std::to_string(n));
  require(count <= kMaxForces,
          ErrorCode::kTableShape,
          "at most " + std::to_string(kMaxForces) + " ground reactions can act, found " +
              std::to_string(count));
  RowMatrix rows(n, 6 * count);
  for (int k = 0; k < count; ++k) {
    const ExternalForce& force = reaction.forces[static_cast<std::size_t>(k)];
    require(force.force.cols() == n && force.point.cols() == n && force.torque.cols() == n,
            ErrorCode::kTableShape,
            "ground reaction '" + force.name + "' has not as many samples as the time axis");
    impl_->bodies.push_back(model.getBody(force.body));
    rows.middleCols(6 * k, 6) = calcWrenchRows(force);
  }
  impl_->start = reaction.time.front();
  impl_->end = reaction.time.back();
  impl_->spline = std::make_unique<NaturalSpline>(reaction.time, rows, 3);
}

ExternalLoads::~ExternalLoads() = default;
ExternalLoads::ExternalLoads(ExternalLoads&&) noexcept = default;

int ExternalLoads::count() const {
  return static_cast<int>(impl_->bodies.size());
}

void ExternalLoads::calc(double t, std::vector<BodyWrench>& wrenches) const {
  wrenches.resize(impl_->bodies.size());
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxColumns, 1> values(6 * count());
  values.setZero();
  if (impl_->spline != nullptr && t >= impl_->start && t <= impl_->end) {
    impl_->spline->evaluate(t, values);
  }
  for (std::size_t k = 0; k < wrenches.size(); ++k) {
    wrenches[k].body = impl_->bodies[k];
    wrenches[k].wrench = values.segment<6>(6 * static_cast<int>(k));
  }
}

}  // namespace gaitmill
