#include "core/model/free_coordinates.h"

#include <cstddef>

#include "core/base/error.h"
#include "core/math/scalar_function.h"

namespace gaitmill {

namespace {

/// Slope and offset of a coupler. Only linear ones are supported: all documents of this kind use
/// them, and a constant J needs no velocity-dependent term.
ScalarFunction::Sample calcLinearCoupler(const CouplerSpec& coupler) {
  const bool linear = coupler.function.kind == FunctionSpec::Kind::kLinear ||
                      coupler.function.kind == FunctionSpec::Kind::kConstant;
  require(linear,
          ErrorCode::kModelUnsupported,
          "coupler '" + coupler.name + "' is not linear",
          {{}, 0, 0, coupler.name});
  ScalarFunction::Sample sample = ScalarFunction(coupler.function).evaluate(0.0);
  sample.value *= coupler.scale;
  sample.first *= coupler.scale;
  return sample;
}

}  // namespace

FreeCoordinates::FreeCoordinates(const Model& model) {
  const int nq = model.coordinateCount();
  sources_.resize(static_cast<std::size_t>(nq));
  std::vector<const CouplerSpec*> coupler_of(static_cast<std::size_t>(nq), nullptr);
  for (const CouplerSpec& coupler : model.spec().couplers) {
    if (coupler.enforced) {
      coupler_of[static_cast<std::size_t>(model.getCoordinate(coupler.dependent).value())] =
          &coupler;
    }
  }
  for (int c = 0; c < nq; ++c) {
    Source& source = sources_[static_cast<std::size_t>(c)];
    const CoordinateSpec& coordinate = model.coordinate(CoordinateIndex(c));
    if (coordinate.locked) {
      source.offset = coordinate.default_value;
    } else if (coupler_of[static_cast<std::size_t>(c)] == nullptr) {
      source.free = count();
      indices_.emplace_back(c);
    }
  }
  for (int c = 0; c < nq; ++c) {
    const CouplerSpec* coupler = coupler_of[static_cast<std::size_t>(c)];
    Source& source = sources_[static_cast<std::size_t>(c)];
    if (coupler == nullptr || model.coordinate(CoordinateIndex(c)).locked) {
      continue;
    }
    const int independent = model.getCoordinate(coupler->independent).value();
    require(coupler_of[static_cast<std::size_t>(independent)] == nullptr,
            ErrorCode::kModelUnsupported,
            "coupler '" + coupler->name + "' depends on a coordinate that is itself dependent",
            {{}, 0, 0, coupler->name});
    const ScalarFunction::Sample line = calcLinearCoupler(*coupler);
    const Source& driver = sources_[static_cast<std::size_t>(independent)];
    source.free = driver.free;
    source.slope = line.first;
    source.offset = driver.free >= 0 ? line.value : line.value + line.first * driver.offset;
  }
}

int FreeCoordinates::findFree(CoordinateIndex c) const {
  for (std::size_t i = 0; i < indices_.size(); ++i) {
    if (indices_[i] == c) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

void FreeCoordinates::expandPose(const Eigen::Ref<const Eigen::VectorXd>& q_free,
                                 Eigen::Ref<Eigen::VectorXd> q) const {
  for (std::size_t c = 0; c < sources_.size(); ++c) {
    const Source& s = sources_[c];
    q[static_cast<int>(c)] = s.offset + (s.free >= 0 ? s.slope * q_free[s.free] : 0.0);
  }
}

void FreeCoordinates::expandRates(const Eigen::Ref<const Eigen::VectorXd>& u_free,
                                  Eigen::Ref<Eigen::VectorXd> u) const {
  for (std::size_t c = 0; c < sources_.size(); ++c) {
    const Source& s = sources_[c];
    u[static_cast<int>(c)] = s.free >= 0 ? s.slope * u_free[s.free] : 0.0;
  }
}

void FreeCoordinates::pick(const Eigen::Ref<const Eigen::VectorXd>& full,
                           Eigen::Ref<Eigen::VectorXd> free) const {
  for (std::size_t i = 0; i < indices_.size(); ++i) {
    free[static_cast<int>(i)] = full[indices_[i].value()];
  }
}

void FreeCoordinates::conformPose(Eigen::Ref<Eigen::VectorXd> q) const {
  for (std::size_t c = 0; c < sources_.size(); ++c) {
    const Source& s = sources_[c];
    q[static_cast<int>(c)] =
        s.offset +
        (s.free >= 0 ? s.slope * q[indices_[static_cast<std::size_t>(s.free)].value()] : 0.0);
  }
}

void FreeCoordinates::conformRates(Eigen::Ref<Eigen::VectorXd> u) const {
  for (std::size_t c = 0; c < sources_.size(); ++c) {
    const Source& s = sources_[c];
    u[static_cast<int>(c)] =
        s.free >= 0 ? s.slope * u[indices_[static_cast<std::size_t>(s.free)].value()] : 0.0;
  }
}

void FreeCoordinates::reduceForces(const Eigen::Ref<const Eigen::VectorXd>& tau,
                                   Eigen::Ref<Eigen::VectorXd> tau_free) const {
  tau_free.setZero();
  for (std::size_t c = 0; c < sources_.size(); ++c) {
    const Source& s = sources_[c];
    if (s.free >= 0) {
      tau_free[s.free] += s.slope * tau[static_cast<int>(c)];
    }
  }
}

void FreeCoordinates::reduceMassMatrix(const Eigen::Ref<const Eigen::MatrixXd>& M,
                                       Eigen::Ref<Eigen::MatrixXd> M_free) const {
  M_free.setZero();
  for (std::size_t j = 0; j < sources_.size(); ++j) {
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      const Source& row = sources_[i];
      const Source& column = sources_[j];
      if (row.free >= 0 && column.free >= 0) {
        M_free(row.free, column.free) +=
            row.slope * column.slope * M(static_cast<int>(i), static_cast<int>(j));
      }
    }
  }
}

void FreeCoordinates::reduceColumns(const Eigen::Ref<const RowMatrix>& full,
                                    Eigen::Ref<RowMatrix> reduced) const {
  reduced.setZero();
  for (std::size_t c = 0; c < sources_.size(); ++c) {
    const Source& s = sources_[c];
    if (s.free >= 0) {
      reduced.col(s.free) += s.slope * full.col(static_cast<int>(c));
    }
  }
}

}  // namespace gaitmill
