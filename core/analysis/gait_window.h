#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/data/gait.h"
#include "core/data/marker_set.h"
#include "core/math/events.h"

namespace gaitmill {

/// A cycle of one foot, strike to strike, numbered by time from 1.
struct NumberedCycle {
  Foot foot = Foot::kUnknown;
  int number = 0;
  GaitCycle cycle;
  bool has_complete_forces = false;
  GaitEvent::Source source = GaitEvent::Source::kForces;  ///< markers if one strike is theirs
};

/// The cycle that the settings ask for.
struct CycleChoice {
  Foot foot = Foot::kRight;
  int number = 1;
};

/// What is simulated unless the settings state a range.
struct SimulatedWindow {
  TimeRange range;                     ///< [s]
  std::optional<NumberedCycle> cycle;  ///< that it covers; none = there is no usable one
  /// Starts inside the cycle and ends inside the next one: tables over the cycle are realigned.
  bool is_realigned = false;
  std::string reason;
  std::string warning;  ///< empty unless something better was to be expected
};

/// Computed muscle control starts up over 30 ms, and muscles that start from rest in the middle of a
/// push-off settle later: this much is simulated before a cycle counts [s]. With 35 ms a reserve of
/// the sample trial's left ankle carried 17 % in the swing that followed, with 85 ms below 10 %.
inline constexpr double kLeadIn = 0.1;
/// Residual reduction and control windows of 10 ms lose up to 12 ms at the end [s].
inline constexpr double kLeadOut = 0.025;

/// All cycles of the right, then of the left foot, each by time. @param complete  of ForceCoverage
std::vector<NumberedCycle> listCycles(const std::vector<GaitEvent>& events,
                                      const std::vector<TimeRange>& complete);

/// The window by the first of these that exists, for the right foot before the left:
///   the first cycle with complete forces from kLeadIn before it to kLeadOut behind it;
///   the first cycle of which a later start leaves a whole cycle length of complete forces: the
///     window then runs into the next cycle, and tables over the cycle are realigned
///     (spec/signal.md 8);
///   the first cycle with complete forces, its lead-in cut short;
///   the longest interval of complete forces, with a warning;
///   none.
/// @param chosen  the only cycle looked at, and taken with a warning even if forces are missing.
///                @throws Error kSettingsValue (trial.cycle) if there is no such cycle
/// @param record  what can be simulated at all
std::optional<SimulatedWindow> findWindow(const std::vector<NumberedCycle>& cycles,
                                          const std::vector<TimeRange>& complete,
                                          const TimeRange& record,
                                          const std::optional<CycleChoice>& chosen);

/// The same around a cycle that the settings state in seconds.
SimulatedWindow findWindowOfCycle(const NumberedCycle& cycle,
                                  const std::vector<TimeRange>& complete,
                                  const TimeRange& record);

}  // namespace gaitmill
