#pragma once

#include <vector>

#include "core/render/picture.h"
#include "core/render/subject.h"
#include "core/render/surface.h"

namespace gaitmill {

// What a picture shows, as values: triangles in ground with their colours. Nothing here knows how
// they are drawn.

/// Colours that the scene and its legend share.
inline constexpr Rgb kForceColor{14, 140, 104};
inline constexpr Rgb kMeasuredMarkerColor{40, 170, 222};
inline constexpr Rgb kModelMarkerColor{240, 96, 168};

/// Length of a ground reaction's arrow [m/N]: that of a 70 kg body at rest is half a metre.
inline constexpr double kArrowLengthPerForce = 0.5 / 687;

/// Floor around the subject, fading into the background.
struct FloorStyle {
  double radius = 2.2;        ///< where it has faded [m]
  double grid_spacing = 0.5;  ///< 0 = no grid [m]
  /// Half of a line through the middle, which joins the poses of a strip; zero = none [m].
  Eigen::Vector3d half_line = Eigen::Vector3d::Zero();
};

/// Lit triangles: bones, muscles, forces and markers as the options ask, in the subject's pose.
/// @param time  of the pose, for the tables of `data` [s]
/// @param thinnest  radius that no muscle goes below, so that tendons of small pictures stay lines
/// [m]
/// @throws Error kTableUnknownLabel if ground reactions lack a column
void makeFigure(Subject& subject,
                const PictureData& data,
                double time,
                const PictureOptions& options,
                double thinnest,
                Surface& surface);

/// Triangles that are not lit but partly transparent, back to front: the floor with the subject's
/// soft shadow, then its grid.
void makeFloor(const Subject& subject, const FloorStyle& style, Surface& surface);

/// How a muscle's tube swells.
struct MuscleShape {
  double belly_radius = 0;  ///< where it is thickest [m]
  double belly_share = 1;   ///< of the path, from the origin on; the rest is tendon
};

/// The belly's radius from the muscle's volume F0M l0M / specific tension, as a share of the true
/// one that keeps neighbours apart; its length from the fibers' share of fiber and tendon.
MuscleShape findMuscleShape(const MuscleSpec& muscle);

/// Rings of a muscle's tube along a path: through every vertex, thick and coloured at the belly,
/// thin and paler towards the tendons.
std::vector<TubeRing> makeMuscleRings(const std::vector<PathVertex>& path,
                                      const MuscleShape& shape,
                                      const Rgb& color,
                                      double thinnest = 0);

/// Points of bones, muscle paths and markers in the current pose, from `follow`, ground axes [m].
void collectOutline(Subject& subject,
                    const Eigen::Vector3d& follow,
                    std::vector<Eigen::Vector3f>& points);

}  // namespace gaitmill
