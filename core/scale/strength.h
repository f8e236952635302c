#pragma once

#include "core/data/model_spec.h"

namespace gaitmill {

/// How maximal isometric forces follow the subject's size (spec/scale.md 5).
enum class StrengthLaw {
  kNone,
  /// Rajagopal et al. (2016), equations 2 and 3: leg muscle volume V = 47 m h + 1285 cm^3
  /// (Handsfield et al. 2014), each muscle keeps its share, so F0M ~ V / l0M.
  kAsIntended,
  /// The scripts published with the paper: V = 47.05 m h + 1289.6 with the subject's mass for both
  /// subjects and without the fiber lengths, so that only height acts, on all muscles alike.
  kAsPublished,
};

/// Size of a person.
struct BodySize {
  double mass = 0;    ///< [kg]
  double height = 0;  ///< [m]
};

/// The person whose strength the generic model has (Rajagopal et al. 2016, II-D).
inline constexpr BodySize kGenericBodySize{75.0, 1.70};

/// Factor on the whole muscle volume, before fiber lengths.
/// @throws Error kInputValue unless mass and height are positive
double calcVolumeRatio(StrengthLaw law, const BodySize& subject, const BodySize& generic);

/// Multiplies F0M of every muscle by the law, for the muscle of the same name in `generic` (whose
/// fiber lengths equation 3 needs). Meant for the model after residual reduction.
/// @throws Error kModelReference if a muscle has no counterpart
void scaleStrength(const ModelSpec& generic,
                   StrengthLaw law,
                   const BodySize& subject,
                   ModelSpec& model,
                   const BodySize& generic_size = kGenericBodySize);

}  // namespace gaitmill
