#pragma once

#include <string>
#include <vector>

#include "core/data/marker_trajectories.h"

namespace gaitmill {

/// Something wrong with one marker over some frames, and what was done about it.
struct MarkerFault {
  enum class Kind {
    kGap,    ///< not seen
    kSwap,   ///< two markers carry each other's name
    kSpike,  ///< a few frames somewhere else
    kDrift,  ///< slides against the markers around it
  };
  enum class Action {
    kReported,   ///< left as it is
    kFilled,     ///< positions put in
    kCorrected,  ///< names exchanged
    kRemoved,    ///< positions set to missing
    kWeighed,    ///< the marker's weight is lowered
  };
  Kind kind = Kind::kGap;
  Action action = Action::kReported;
  std::string marker;
  std::string other;    ///< the second marker of a swap
  int first_frame = 0;  ///< from 0
  int last_frame = 0;   ///< inclusive
  double start = 0;     ///< [s]
  double end = 0;       ///< [s]
  /// [m] how far a spike is off, a drift goes, swapped markers are apart; NaN for gaps
  double size = 0;
};

struct MarkerFaultOptions {
  double max_gap = 0.1;  ///< [s] longest gap that is filled; 0 = none
};

struct MarkerRepair {
  std::vector<MarkerFault> faults;  ///< swaps, spikes, drifts, gaps; each in the order of markers
  /// One per marker: factor of its weight in inverse kinematics, in (0, 1]. Least squares weighs by
  /// 1 / variance: with an error of sigma = 10 mm for any marker, a drift that ends D away adds
  /// D^2 / 3, so the factor is sigma^2 / (sigma^2 + D^2 / 3). Likewise for swaps that could not be
  /// corrected, with their distance as D.
  std::vector<double> weights;
};

/// Finds and repairs faults of a recording, from the data alone (see MarkerCompanions):
///  - swaps: two markers are at least 15 mm off their places among their companions and within
///    40 % of that on each other's, or both jump to where the other was about to be; names are
///    exchanged. A jump that never returns near the middle of the recording leaves open which half
///    is wrong: it is reported and the weights are lowered.
///  - spikes: up to 0.05 s far off a smooth way through the frames around and off the companions;
///    set to missing, and filled as gaps are.
///  - gaps up to max_gap between seen frames: filled by the rigid motion of three or more
///    companions, else by a cubic spline through up to twelve frames at either side. Longer ones,
///    and those at the ends, stay.
///  - drifts: distances to two or more markers that change steadily by more than 12 mm; not where
///    the body stands, whose changes of posture look alike.
/// Positions of frames without fault stay to the bit.
MarkerRepair repairMarkers(const MarkerFaultOptions& options, MarkerTrajectories& markers);

/// "gap", "swap", "spike", "drift"
const char* faultName(MarkerFault::Kind kind);
/// "reported", "filled", "corrected", "removed", "weight_lowered"
const char* actionName(MarkerFault::Action action);
/// One sentence for people: "markers L.Heel and R.Heel carry each other's name from 0.41 s to 0.52
/// s (0.12 m apart); corrected".
std::string describeFault(const MarkerFault& fault);

}  // namespace gaitmill
