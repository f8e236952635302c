#pragma once

#include <variant>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/data/mesh.h"
#include "core/render/mesh_kit.h"

namespace gaitmill {

/// A body put together from simple ones that melt into each other: a signed distance function
/// (negative inside), part after part in the order in which they were added. The distances are
/// exact for round parts and close near the surface for the others. Lengths [m].
class Solid {
 public:
  /// Tube along a smooth curve. @param blend  width of the fillet to what is there
  Solid& addStroke(const std::vector<StrokePoint>& points,
                   double blend,
                   const CrossSection& section = {});
  Solid& carveStroke(const std::vector<StrokePoint>& points, double blend);
  /// @param axes  columns: directions of the three radii
  Solid& addEllipsoid(const Eigen::Vector3d& center,
                      const Eigen::Vector3d& radii,
                      double blend,
                      const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity());
  Solid& carveEllipsoid(const Eigen::Vector3d& center,
                        const Eigen::Vector3d& radii,
                        double blend,
                        const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity());
  /// Plate over a smooth net of points (rows of equal length), whose radius is half its thickness.
  Solid& addSheet(const std::vector<std::vector<StrokePoint>>& net, double blend);
  /// Takes away what lies on the side of the plane that `normal` points to.
  Solid& cut(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, double blend);

  bool isEmpty() const { return parts_.empty(); }
  double calcDistance(const Eigen::Vector3d& p) const;
  /// The surface as a closed mesh whose normals are the function's gradient.
  /// @param cell  size of the grid's cells, to which details are resolved
  Mesh makeMesh(const Eigen::Vector3d& cell) const;

 private:
  friend class SolidMesher;

  struct Segment {
    Eigen::Vector3d from, to;
    double from_radius, to_radius;
  };
  struct Stroke {
    std::vector<Segment> segments;
    CrossSection section;
  };
  struct Ellipsoid {
    Eigen::Vector3d center, radii;
    Eigen::Matrix3d axes;
  };
  struct Triangle {
    Eigen::Vector3d corner, first_side, second_side;
    Eigen::Vector3d radii;  ///< at the three corners
    Eigen::Matrix2d inverse_gram;
  };
  struct Sheet {
    std::vector<Triangle> triangles;
  };
  struct HalfSpace {
    Eigen::Vector3d point, normal;
  };
  struct Part {
    std::variant<Stroke, Ellipsoid, Sheet, HalfSpace> shape;
    bool carves = false;
    double blend = 0;
    Eigen::AlignedBox3d box;  ///< around the shape
  };

  static double calcDistance(const Segment& segment,
                             const CrossSection& section,
                             const Eigen::Vector3d& p);
  static double calcDistance(const Triangle& triangle, const Eigen::Vector3d& p);
  static double calcDistance(const Stroke& stroke, const Eigen::Vector3d& p);
  static double calcDistance(const Ellipsoid& ellipsoid, const Eigen::Vector3d& p);
  static double calcDistance(const Sheet& sheet, const Eigen::Vector3d& p);
  static double calcDistance(const HalfSpace& space, const Eigen::Vector3d& p);
  static double calcDistance(const Part& part, const Eigen::Vector3d& p);
  static double combine(double distance, const Part& part, double part_distance);
  static Part makeStroke(const std::vector<StrokePoint>& points, const CrossSection& section);
  static Part makeEllipsoid(const Eigen::Vector3d& center,
                            const Eigen::Vector3d& radii,
                            const Eigen::Matrix3d& axes);
  static void addTriangle(Part& part,
                          const StrokePoint& a,
                          const StrokePoint& b,
                          const StrokePoint& c);
  Solid& add(Part part, bool carves, double blend);
  Eigen::AlignedBox3d findBox() const;
  /// What decides where the surface runs within `radius` of `center`.
  Solid selectNear(const Eigen::Vector3d& center, double radius) const;

  std::vector<Part> parts_;
};

}  // namespace gaitmill
