#pragma once

#include <string>
#include <vector>

#include "core/analysis/foot_contacts.h"
#include "core/analysis/marker_events.h"
#include "core/data/marker_set.h"

namespace gaitmill {

/// Times at which a foot stands without a force of its own.
struct MissingForce {
  Foot foot = Foot::kUnknown;  ///< unknown where it cannot be told, or where both are concerned
  TimeRange range;             ///< [s]
  std::string reason;
};

struct ForceCoverage {
  std::vector<TimeRange> complete;    ///< every foot on the ground has its force, by time
  std::vector<MissingForce> missing;  ///< by time
};

/// Where all forces of the subject are known. Markers tell when each foot stands, the plates when
/// it is measured. Not complete are, each with kEventMargin to both sides:
///   a stance without any contact of its foot, and the part of a stance that a contact misses by
///   more than kLargestEventError (the contact is then marked partial and all of it left out:
///   a part of the foot stood beside the plate);
///   contacts that two feet share or whose foot is not known.
/// Where no stance is known (no markers of the feet), times with no load at all are missing in
/// walking; nothing else can be told then.
/// @param contacts  in: with their feet; out: is_partial set
/// @param stances   of findStances, empty if the feet are not seen
/// @param kind      of gait, for recordings without stances
/// @param record    what forces and, if there are any, markers cover
ForceCoverage findForceCoverage(const std::vector<Stance>& stances,
                                GaitKind kind,
                                const TimeRange& record,
                                std::vector<FootContact>& contacts);

inline constexpr double kEventMargin = 0.02;        ///< [s]
inline constexpr double kLargestEventError = 0.08;  ///< [s] of strikes and toe-offs by markers

}  // namespace gaitmill
