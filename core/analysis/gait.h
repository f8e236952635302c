#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/analysis/foot_contacts.h"
#include "core/analysis/force_coverage.h"
#include "core/analysis/gait_window.h"
#include "core/data/gait.h"
#include "core/data/ground_reaction.h"
#include "core/data/marker_trajectories.h"

namespace gaitmill {

/// What the settings say about contacts and cycles.
struct GaitStatements {
  std::vector<ContactStatement> contacts;
  std::optional<CycleChoice> cycle;
  std::optional<TimeRange> cycle_range;  ///< strike and strike of the right foot [s]
};

/// Forces against markers over the events that both know [s]; markers later than forces count
/// positive.
struct EventComparison {
  int count = 0;
  double mean_difference = 0;
  double largest_difference = 0;  ///< in size
};

/// Who stood where and when, and what follows for the simulation.
struct Gait {
  GaitKind kind = GaitKind::kUnknown;
  double duty_factor = 0;  ///< stance part of the stride; NaN if no stride is seen
  std::string kind_evidence;
  std::vector<FootContact> contacts;  ///< by time
  std::vector<GaitEvent> events;      ///< by time, of forces where they know them, else of markers
  std::vector<Stance> stances;        ///< by the markers
  ForceCoverage coverage;
  std::vector<NumberedCycle> cycles;
  std::optional<SimulatedWindow> window;
  EventComparison strikes;
  EventComparison toe_offs;
  std::vector<std::string> warnings;
};

/// Contacts, events, cycles and the window of one recording. Forces or markers may be empty.
/// @param named    one per force: the foot that its columns or the settings' plates name
/// @param chosen   which markers show feet and pelvis
/// @throws Error kSettingsValue naming trial.contacts[i] or trial.cycle
Gait describeGait(const GroundReaction& reaction,
                  const std::vector<Foot>& named,
                  const MarkerTrajectories& markers,
                  const GaitMarkers& chosen,
                  const GaitStatements& statements = {});

/// Forces that act on one body each: a force whose contacts all belong to one foot becomes that
/// foot's, bit for bit; one that serves both feet is divided, each sample going to the nearest
/// contact. Shared contacts go to the foot in whose stance they begin, unusable ones to nobody.
/// Forces without any foot are left out.
/// @param named  as in describeGait: a force that names its foot stays whole unless the settings
///               state another foot for a contact
GroundReaction assignForces(const GroundReaction& reaction,
                            const std::vector<Foot>& named,
                            const std::vector<FootContact>& contacts,
                            const std::string& right_body,
                            const std::string& left_body);

}  // namespace gaitmill
