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
};

/// Lit triangles: bones, muscles, forces and markers as the options ask, in the subject's pose.
/// @param time  of the pose, for the tables of `data` [s]
/// @throws Error kTableUnknownLabel if ground reactions lack a column
void makeFigure(Subject& subject,
                const PictureData& data,
                double time,
                const PictureOptions& options,
                Surface& surface);

/// Triangles that are not lit but partly transparent, back to front: the floor with the subject's
/// soft shadow, then its grid.
void makeFloor(const Subject& subject, const FloorStyle& style, Surface& surface);

/// Half the thickness of a muscle's belly [m]: from its volume F0M l0M / specific tension, as a
/// share of the true radius that keeps neighbours apart.
double findBellyRadius(const MuscleSpec& muscle);

/// Rings of a muscle's tube along a path: through every vertex, thicker towards the middle.
std::vector<TubeRing> makeMuscleRings(const std::vector<PathVertex>& path,
                                      double belly_radius,
                                      const Rgb& color);

/// Points of the body's surface and of the forces for framing, from `follow`, ground axes [m].
void collectOutline(const Subject& subject,
                    const Eigen::Vector3d& follow,
                    std::vector<Eigen::Vector3f>& points);

}  // namespace gaitmill
