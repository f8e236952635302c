#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/data/mesh.h"

namespace gaitmill {

// Closed meshes of simple shapes, and what is done to meshes. Lengths [m]. Every mesh made here is
// closed, and its corners run counter-clockwise seen from outside.

/// A point of a curve with the radius of the tube around it [m].
struct StrokePoint {
  Eigen::Vector3d position;
  double radius;
};

/// Smooth curve through the points (Catmull-Rom), `per_span` pieces between two of them.
std::vector<StrokePoint> refineStroke(const std::vector<StrokePoint>& points, int per_span);

/// Cross-section of a tube: a circle, or an ellipse that is `flatness` times as thick along
/// `thin_direction` (unit length) as across.
struct CrossSection {
  Eigen::Vector3d thin_direction = Eigen::Vector3d::UnitX();
  double flatness = 1;
};

/// Further choices of makeTube.
struct TubeForm {
  int sides = 8;     ///< corners of a cross-section, >= 3
  int per_span = 3;  ///< rings between two points, >= 1
  double cap = 1;    ///< height of the rounded ends over their radius
  CrossSection section;
  bool thin_from_axis = false;  ///< the thin direction points away from the y axis, at each ring
};

/// Tube along the refined curve with rounded ends.
Mesh makeTube(const std::vector<StrokePoint>& points, const TubeForm& form = {});

/// @param rings  between the poles; the poles lie on the axis of the third radius
Mesh makeEllipsoid(const Eigen::Vector3d& center,
                   const Eigen::Vector3d& radii,
                   const Eigen::Matrix3d& axes,
                   int sides,
                   int rings);

void appendMesh(Mesh& mesh, const Mesh& other);
/// p -> diag(factors) p; normals stay normal. An odd number of negative factors mirrors, and turns
/// the triangles so that outside stays outside.
void scaleMesh(Mesh& mesh, const Eigen::Vector3d& factors);
/// p -> R p + translation.
void moveMesh(Mesh& mesh, const Eigen::Matrix3d& R, const Eigen::Vector3d& translation);

/// Normals of a smooth surface: the mean of the triangles around each vertex, weighted by area.
void calcSmoothNormals(Mesh& mesh);

}  // namespace gaitmill
