#pragma once

#include "core/data/marker_set.h"
#include "core/math/nonlinear_program.h"
#include "core/scale/strength.h"

namespace gaitmill {

/// How sizes are fitted to a motion (beside ScaleOptions: marker set, mass, muscles). Standard
/// deviations are beliefs; what they are weighed against is marker_deviation.
struct MotionScaleOptions {
  double subject_height = 0;                        ///< [m] > 0
  double generic_height = kGenericBodySize.height;  ///< [m] of the generic model
  TimeRange range;                                  ///< frames that may be taken

  /// Frames fitted together, spread over the range. More cost time and change little: a stride has
  /// no more postures to show.
  int frame_count = 20;
  /// Frames that count as independent: the skin moves with the posture (Leardini et al. 2005, Gait
  /// Posture 21:212), so that the errors of one marker repeat from frame to frame.
  double independent_frames = 6;
  /// Distance of a marker from where the skeleton would have it, along one axis [m].
  double marker_deviation = 0.01;

  /// Place of a palpated landmark on the generic model, along one axis [m]: palpation varies by 5
  /// to 20 mm between examiners (Della Croce et al. 2005, Gait Posture 21:226), and bones differ.
  double landmark_deviation = 0.015;
  /// The same for markers of a cluster, which sit anywhere on their segment [m].
  double tracking_deviation = 0.08;
  /// Rotation of a joint about its default [rad]: decides only what no marker sees.
  double rotation_deviation = 2.0;

  /// Sizes beyond these multiples of height / generic height are not tried.
  double min_relative_size = 0.7;
  double max_relative_size = 1.4;

  // Beyond these the result carries a warning.
  double warn_deviations = 3.0;  ///< of a size or an offset
  double warn_rms = 0.02;        ///< [m] over the motion

  NlpOptions solver{1e-6, 200, 1e-3, 1e-4};

  /// @throws Error kInputValue naming the first option out of range
  void validate() const;
};

}  // namespace gaitmill
