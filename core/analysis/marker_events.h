#pragma once

#include <vector>

#include "core/analysis/foot_motion.h"
#include "core/data/gait.h"

namespace gaitmill {

/// A foot on the ground, as the markers show it.
struct Stance {
  Foot foot = Foot::kUnknown;
  double start = 0;          ///< [s] foot strike, or the record's start
  double end = 0;            ///< [s] toe-off, or the record's end
  bool has_strike = false;   ///< the strike was seen
  bool has_toe_off = false;  ///< the toe-off was seen
};

/// Strikes and toe-offs of both feet from markers alone, in the order of time (spec/signal.md 7.2).
///   strike   the heel is farthest in front of the pelvis (Zeni et al. 2008, Gait Posture
///            27:710): its forward speed against the pelvis changes sign
///   toe-off  the largest upward acceleration of the toe (low-pass 10 Hz) in the last 0.2 s before
///            the toe is farthest behind the pelvis
/// One rule serves walking and running. Zeni's own toe-off (the toe farthest behind) agrees in
/// walking but comes 80 to 120 ms late in running; the vertical speed of the foot's centre
/// (O'Connor et al. 2007) came 160 to 200 ms early for strikes and 50 ms late for toe-offs of the
/// runs at 4 m/s. Against forces this rule is within 35 ms for strikes, always early, and within
/// 20 ms for toe-offs, on walking and three runs at 60 and 100 Hz.
/// Times lie between frames (parabola through three). A foot whose heel moves less than 0.2 m
/// against the pelvis, or whose markers are not known, has no events. Strikes with no toe-off in
/// between, or the reverse, stay as they are found.
std::vector<GaitEvent> findMarkerEvents(const GaitMotion& motion);

/// Times on the ground between a foot's events: from a strike to the next event, and from the
/// record's start to a first toe-off. A foot without events has none.
std::vector<Stance> findStances(const std::vector<GaitEvent>& events, double start, double end);

/// Median of the stance's part of the stride over both feet, of strides with one strike, one
/// toe-off and the next strike; NaN without any.
double calcDutyFactor(const std::vector<GaitEvent>& events);

}  // namespace gaitmill
