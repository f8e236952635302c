#pragma once

#include <string>
#include <vector>

#include "core/data/ground_reaction.h"
#include "core/data/marker_trajectories.h"
#include "core/math/events.h"

namespace gaitmill {

/// The foot that a marker sits on, by the field's usual names: heel, calcaneus, toe, metatarsal,
/// ankle or malleolus with the side in front or behind ("RHEE", "R.Heel", "LMT5", "toe_l"). Unknown
/// for all others.
Foot findFootOfMarker(const std::string& marker);

/// One contact of one force plate, or of one family of force columns, with the ground.
struct FootContact {
  std::string plate;  ///< ExternalForce::name
  Foot foot = Foot::kUnknown;
  Contact contact;
};

/// Contacts of all forces in the order of time. A force whose foot is not known gets, contact by
/// contact, the foot whose markers are nearer to the centre of pressure: mean horizontal distance
/// over the contact to the nearest marker of the foot that is seen. The foot stays unknown where
/// that distance exceeds 0.25 m, or the other foot is not 0.05 m further away.
/// @param feet     one per force
/// @param markers  of the same recording; without markers nothing is guessed
std::vector<FootContact> findFootContacts(const GroundReaction& reaction,
                                          const std::vector<Foot>& feet,
                                          const MarkerTrajectories& markers);

struct GaitEvent {
  enum class Kind { kFootStrike, kToeOff };
  Kind kind = Kind::kFootStrike;
  Foot foot = Foot::kUnknown;
  double time = 0;  ///< [s]
};

/// Strikes and toe-offs of the feet that are known, in the order of time. A foot that steps from
/// one plate to the next strikes once.
std::vector<GaitEvent> findGaitEvents(const std::vector<FootContact>& contacts);

/// From strike to next strike of one foot, where it leaves the ground exactly once in between: two
/// strikes of a foot that stepped beside the plates meanwhile are no cycle.
std::vector<GaitCycle> findGaitCycles(const std::vector<GaitEvent>& events, Foot foot);

}  // namespace gaitmill
