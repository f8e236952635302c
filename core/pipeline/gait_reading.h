#pragma once

#include <string>
#include <vector>

#include "core/analysis/gait.h"
#include "core/data/decision.h"
#include "core/data/ground_reaction.h"

namespace gaitmill {

// What uploads and jobs share on the way from files to feet, events and cycles.

/// The markers of feet and pelvis by their landmarks, whatever set of names a laboratory uses.
GaitMarkers findGaitMarkersByLandmark(const std::vector<std::string>& names);

/// Which foot stands on each plate, what kind of gait it is and what is simulated.
/// @param named   foot that each force's columns name
/// @param plates  the forces that were looked at
void addGaitDecisions(const Gait& gait,
                      const std::vector<Foot>& named,
                      const GroundReaction& plates,
                      Decisions& decisions);

/// "stated", "shared", "partial", "outside_sole", "wrong_foot": what is to be known of a contact.
std::vector<std::string> listFlags(const FootContact& contact);

/// {"kind", "duty_factor", "evidence", "contacts", "complete_forces_s", "missing_forces",
/// "marker_events", "cycles", "window"} as summary.json shows it, as JSON text.
std::string describeAsJson(const Gait& gait);

}  // namespace gaitmill
