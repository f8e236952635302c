#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/base/index.h"
#include "core/model/free_coordinates.h"
#include "core/model/model.h"

namespace gaitmill {

/// Cosine and sine coefficients of one Fourier term.
struct HarmonicTerm {
  double cosine = 0;
  double sine = 0;
};

/// Walking as a Fourier series, left and right alike half a cycle apart:
///   q_j(t) = a_j0 + sum_n a_jn cos(n w t) + b_jn sin(n w t),     w = 2 pi / period,  n = 1..5
/// fitted to the published walking trial (models/sample/SOURCE.md); t = 0 is a right heel strike.
/// Five harmonics reach 4.4 Hz, below the pass band's edge of a 6 Hz low-pass, so that filtering
/// the truth gives the truth.
struct GaitPattern {
  double period = 1.1445;    ///< [s] of the fitted trial
  double speed = 1.2475;     ///< [m/s] mean forward speed of the fitted trial
  double length_scale = 1;   ///< multiplies pelvis translations and speed
  double pelvis_height = 0;  ///< [m] added to pelvis_ty
};

/// The pattern on the coordinates of one model, with exact derivatives. Coordinates that the
/// pattern does not know keep their default value. Keeps a reference to the model.
class GaitMotion {
 public:
  static constexpr int kHarmonics = 5;

  /// @throws Error kInputCoordinates if the model lacks a coordinate of the pattern
  GaitMotion(const Model& model, const GaitPattern& pattern);

  /// Coordinates [rad|m], speeds and accelerations at time t [s], each (n_coordinates). Locked and
  /// dependent coordinates are consistent.
  void calc(double t,
            Eigen::Ref<Eigen::VectorXd> q,
            Eigen::Ref<Eigen::VectorXd> u,
            Eigen::Ref<Eigen::VectorXd> udot) const;

  /// Adds to one term of a coordinate of the middle (pelvis, lumbar) [rad|m].
  /// @param harmonic  1..kHarmonics
  /// @throws Error kInputCoordinates if the pattern has no such coordinate
  void addTerm(const std::string& coordinate, int harmonic, const HarmonicTerm& term);

  const Model& model() const { return model_; }
  const GaitPattern& pattern() const { return pattern_; }

 private:
  struct Column {
    CoordinateIndex coordinate;
    double mean = 0;
    double slope = 0;  ///< [m/s]
    double delay = 0;  ///< [s] half a period on the left side
    std::array<HarmonicTerm, kHarmonics> terms;
  };
  const Model& model_;
  FreeCoordinates free_;
  GaitPattern pattern_;
  std::vector<Column> columns_;
};

}  // namespace gaitmill
