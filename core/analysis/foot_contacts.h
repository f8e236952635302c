#pragma once

#include <string>
#include <vector>

#include "core/analysis/foot_motion.h"
#include "core/data/gait.h"
#include "core/data/ground_reaction.h"
#include "core/math/events.h"

namespace gaitmill {

/// One contact of one force plate, or of one family of force columns, with the ground. Where both
/// feet use a plate without leaving it, each has a contact of its own, and the time between, when
/// both may stand on it, is a third one that is shared.
struct FootContact {
  std::string plate;  ///< ExternalForce::name
  Foot foot = Foot::kUnknown;
  Contact contact;
  double confidence = 0;    ///< that the foot is right, 0..1
  std::string reason = {};  ///< the evidence as a sentence
  /// Whose markers are where the force acts, whatever the columns or the settings say.
  Foot seen = Foot::kUnknown;
  bool is_stated = false;        ///< by the settings
  bool is_shared = false;        ///< by both feet: no force of a single foot
  bool is_foreign = false;       ///< the settings say that no foot of the subject stands there
  bool is_outside_sole = false;  ///< the centre of pressure lies beside the foot
  bool is_partial = false;       ///< the foot stands longer than the plate is loaded

  /// Whether the force acts on one foot.
  bool isUsable() const { return foot != Foot::kUnknown && !is_shared; }
  /// Whether the other foot is where the force acts although the columns name this one.
  bool isContradicted() const {
    return !is_stated && seen != Foot::kUnknown && seen == otherFoot(foot);
  }
};

/// What a person says about the contact of one plate that covers a time.
struct ContactStatement {
  std::string plate;           ///< ExternalForce::name
  double time = 0;             ///< [s]
  Foot foot = Foot::kUnknown;  ///< unknown: none of the subject's feet
};

/// A foot is told by the markers only if it is at least this sure.
inline constexpr double kLeastConfidence = 0.75;

/// Contacts of all forces in the order of time, each with its foot.
///
/// Evidence over the middle third of a contact, median of its samples: the distance d of the centre
/// of pressure from the line between heel and toe of each foot, and the foot's forward speed v
/// against the pelvis, which is negative for a foot on the ground, on a treadmill as well.
/// The nearer foot is believed with
///   confidence = plausibility(d) / (1 + exp(-((d' - d)/0.05 m + (v' - v)/(1 m/s))))
/// where primes are the other foot and plausibility falls from 1 at 0.1 m by e each 0.1 m; the foot
/// stays unknown below kLeastConfidence or beyond 0.25 m.
///
/// A plate that names no foot and whose centre of pressure lies under one foot for at least 0.08 s
/// and under the other as well is split; the time between is shared, from the strike of the next
/// foot to the toe-off of the last one as the markers tell them. One whose centre of pressure lies
/// between two feet most of the time is shared altogether.
///
/// @param named          one per force: the foot that its columns or the settings' plates name.
///                       It is believed; `seen` tells what the markers say.
/// @param motion         of the same recording; without markers nothing is guessed
/// @param marker_events  of findMarkerEvents(motion)
/// @param statements     win over all other evidence. @throws Error kSettingsValue naming
///                       trial.contacts[i] if its plate has no contact at that time
std::vector<FootContact> findFootContacts(const GroundReaction& reaction,
                                          const std::vector<Foot>& named,
                                          const GaitMotion& motion,
                                          const std::vector<GaitEvent>& marker_events = {},
                                          const std::vector<ContactStatement>& statements = {});

/// Strikes and toe-offs of the feet that are known, in the order of time. A foot that steps from
/// one plate to the next strikes once. Contacts that are shared, partial or contradicted tell none.
std::vector<GaitEvent> findGaitEvents(const std::vector<FootContact>& contacts);

/// From strike to next strike of one foot, where it leaves the ground exactly once in between: two
/// strikes of a foot that stepped beside the plates meanwhile are no cycle.
std::vector<GaitCycle> findGaitCycles(const std::vector<GaitEvent>& events, Foot foot);

}  // namespace gaitmill
