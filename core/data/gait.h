#pragma once

#include <limits>

#include "core/data/ground_reaction.h"

namespace gaitmill {

/// What the subject does. Walking: each foot stands longer than half of its stride, so that both
/// feet stand at the same time; running: shorter, so that neither does.
enum class GaitKind { kUnknown, kWalking, kRunning };

/// "right", "left", or "" for an unknown foot.
inline const char* footName(Foot foot) {
  return foot == Foot::kRight ? "right" : foot == Foot::kLeft ? "left" : "";
}

inline Foot otherFoot(Foot foot) {
  return foot == Foot::kRight ? Foot::kLeft : foot == Foot::kLeft ? Foot::kRight : Foot::kUnknown;
}

/// "walking", "running", "unknown"
inline const char* gaitKindName(GaitKind kind) {
  return kind == GaitKind::kWalking   ? "walking"
         : kind == GaitKind::kRunning ? "running"
                                      : "unknown";
}

struct GaitEvent {
  enum class Kind { kFootStrike, kToeOff };
  enum class Source { kForces, kMarkers };
  Kind kind = Kind::kFootStrike;
  Foot foot = Foot::kUnknown;
  double time = 0;  ///< [s]
  Source source = Source::kForces;
  /// Time by the markers minus time by the forces [s]; NaN unless both know the event.
  double marker_difference = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace gaitmill
