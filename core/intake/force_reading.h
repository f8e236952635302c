#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/data/decision.h"
#include "core/data/ground_reaction.h"
#include "core/data/marker_trajectories.h"
#include "core/intake/laboratory.h"

namespace gaitmill {

/// What the settings say of the force files; nothing = it is read out of the data.
struct ForceReadingOptions {
  std::optional<SignedAxis> vertical;     ///< axis of the force file that points up
  std::optional<SignedAxis> forward;      ///< and the one that is forward in ground
  std::optional<double> metres_per_unit;  ///< of the points of application
  std::optional<double> moment_factor;    ///< N.m per unit of the torques
  std::optional<bool> on_subject;         ///< forces act on the subject, else on the plate
};

/// Brings the forces of all plates into ground axes, metres and N.m, as acting on the subject:
///  - the vertical axis is the one that the loaded force lies along; a file whose vertical axis is
///    the markers' is turned as they are, one that is Y up stays,
///  - forces that press down act on the plate and are reversed,
///  - units of points and, if the markers tell that the usual reading is wrong, the turn about the
///    vertical: the centre of pressure of a loaded plate lies under a foot,
///  - free torques in gait stay below some 60 N.m.
/// What is right already is not changed by a bit.
/// @param markers  the movement in ground, or without frames
/// @param frame    of the movement, or null
/// @throws Error kInputAmbiguous naming both readings and the field that decides
void decideForces(const MarkerTrajectories& markers,
                  const BodyMarkers& body,
                  const LaboratoryFrame* frame,
                  const ForceReadingOptions& options,
                  GroundReaction& reaction,
                  Decisions& decisions,
                  std::vector<std::string>& warnings);

}  // namespace gaitmill
