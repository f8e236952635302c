#include "core/render/scene.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/units.h"
#include "core/render/color_scale.h"

namespace gaitmill {

namespace {

constexpr Material kBone{{226, 218, 198}, 70};
constexpr std::uint8_t kMuscleGloss = 90;
constexpr std::uint8_t kMarkerGloss = 160;
constexpr double kMarkerRadius = 0.0105;  // [m] a little more than the usual 14 mm marker
constexpr double kArrowRadius = 0.011;    // [m]
constexpr double kMinimumForce = 10;      // [N] less shows nothing but the plate's noise

// Specific tension that turns force into cross section [N/m^2] (Rajagopal et al. 2016: 60 N/cm^2).
constexpr double kSpecificTension = 60e4;
constexpr double kTendonRadius = 0.0026;  // [m]
constexpr double kMinimumBelly = 0.0036;
constexpr double kMaximumBelly = 0.014;
constexpr double kRingStep = 0.02;  // [m] along a path
constexpr Rgb kTendonColor{236, 222, 196};
constexpr double kTendonPaleness = 0.7;

void addBones(const Subject& subject, Surface& surface) {
  for (const BodyMesh& bone : subject.bones()) {
    addMesh(bone.mesh, subject.pose(bone.body), kBone, surface);
  }
}

// Colours of all muscles in model order.
std::vector<Rgb> findMuscleColors(const ModelSpec& model,
                                  const TimeSeries& values,
                                  double time,
                                  MuscleColor color) {
  std::vector<Rgb> colors(model.muscles.size(),
                          color == MuscleColor::kNone ? kPlainMuscle : kUnknownMuscle);
  if (color == MuscleColor::kNone || values.rowCount() == 0) return colors;
  const Eigen::VectorXd row = values.interpolate(time);
  for (std::size_t m = 0; m < colors.size(); ++m) {
    const std::optional<int> column = values.findColumn(model.muscles[m].name);
    if (!column) continue;
    double value = row[*column];
    if (color == MuscleColor::kForce) value /= model.muscles[m].max_isometric_force;
    colors[m] = getColorScale(color).findColor(value);
  }
  return colors;
}

void addMuscles(Subject& subject,
                const std::vector<Rgb>& colors,
                double thinnest,
                Surface& surface) {
  const ModelSpec& model = subject.model().spec();
  std::vector<PathVertex> path;
  for (std::size_t m = 0; m < model.muscles.size(); ++m) {
    subject.tracePath(MuscleIndex(static_cast<int>(m)), path);
    addTube(makeMuscleRings(path, findMuscleShape(model.muscles[m]), colors[m], thinnest),
            kMuscleGloss,
            surface);
  }
}

Eigen::Vector3d pickVector(const TimeSeries& table,
                           const Eigen::VectorXd& row,
                           const std::string& stem,
                           const std::string& separator) {
  return {row[table.getColumn(stem + separator + "x")],
          row[table.getColumn(stem + separator + "y")],
          row[table.getColumn(stem + separator + "z")]};
}

void addForces(const TimeSeries& table, double time, Surface& surface) {
  if (table.rowCount() == 0) return;
  const Eigen::VectorXd row = table.interpolate(time);
  for (const char* foot : {"right_", "left_"}) {
    if (!table.findColumn(std::string(foot) + "fx")) continue;
    const Eigen::Vector3d force = pickVector(table, row, foot, "f");
    const Eigen::Vector3d point = pickVector(table, row, foot, "p");
    if (!force.allFinite() || !point.allFinite() || force.norm() < kMinimumForce) continue;
    addArrow(point,
             force.normalized(),
             kArrowLengthPerForce * force.norm(),
             kArrowRadius,
             {kForceColor, kMuscleGloss},
             surface);
  }
}

// Measured markers and their counterparts on the model; where nothing was measured, all of the
// model.
void addMarkers(const Subject& subject, const TimeSeries& table, double time, Surface& surface) {
  const ModelSpec& model = subject.model().spec();
  const bool any = table.rowCount() > 0;
  const Eigen::VectorXd row = any ? table.interpolate(time) : Eigen::VectorXd();
  for (std::size_t m = 0; m < model.markers.size(); ++m) {
    const std::string& name = model.markers[m].name;
    if (any && !table.findColumn(name + "_x")) continue;
    addSphere(subject.findMarker(static_cast<int>(m)),
              kMarkerRadius,
              {kModelMarkerColor, kMarkerGloss},
              surface);
    if (!any) continue;
    const Eigen::Vector3d measured = pickVector(table, row, name, "_");
    if (!measured.allFinite()) continue;
    addSphere(measured, kMarkerRadius, {kMeasuredMarkerColor, kMarkerGloss}, surface);
  }
}

}  // namespace

MuscleShape findMuscleShape(const MuscleSpec& muscle) {
  const double volume = muscle.max_isometric_force * muscle.optimal_fiber_length / kSpecificTension;
  const double fibers =
      muscle.optimal_fiber_length / (muscle.optimal_fiber_length + muscle.tendon_slack_length);
  // A spindle of a given slenderness: the radius goes with the third root of the volume. Pennate
  // bellies are longer than their fibers, hence the offset.
  return {std::clamp(0.0155 * std::cbrt(volume / 4e-4), kMinimumBelly, kMaximumBelly),
          std::clamp(0.45 + 0.9 * fibers, 0.5, 1.0)};
}

std::vector<TubeRing> makeMuscleRings(const std::vector<PathVertex>& path,
                                      const MuscleShape& shape,
                                      const Rgb& color,
                                      double thinnest) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i].p_G - path[i - 1].p_G).norm();
  std::vector<TubeRing> rings;
  const auto add = [&](const Eigen::Vector3d& p, double along) {
    const double share = std::clamp(along / (shape.belly_share * length), 0.0, 1.0);
    const double swell = std::pow(std::sin(kPi * share), 1.4);
    rings.push_back(
        {p,
         std::max(thinnest, kTendonRadius + (shape.belly_radius - kTendonRadius) * swell),
         blend(color, kTendonColor, kTendonPaleness * std::max(0.0, 1 - 4 * swell))});
  };
  double along = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    add(path[i].p_G, along);
    if (i + 1 == path.size()) break;
    const Eigen::Vector3d piece = path[i + 1].p_G - path[i].p_G;
    const int steps = std::max(1, static_cast<int>(std::ceil(piece.norm() / kRingStep)));
    for (int step = 1; step < steps; ++step) {
      const double t = static_cast<double>(step) / steps;
      add(path[i].p_G + t * piece, along + t * piece.norm());
    }
    along += piece.norm();
  }
  return rings;
}

void makeFigure(Subject& subject,
                const PictureData& data,
                double time,
                const PictureOptions& options,
                double thinnest,
                Surface& surface) {
  if (options.bones) addBones(subject, surface);
  if (options.muscles) {
    addMuscles(subject,
               findMuscleColors(subject.model().spec(), data.muscle_values, time, options.color),
               thinnest,
               surface);
  }
  if (options.forces) addForces(data.ground_reactions, time, surface);
  if (options.markers) addMarkers(subject, data.markers, time, surface);
}

void collectOutline(Subject& subject,
                    const Eigen::Vector3d& follow,
                    std::vector<Eigen::Vector3f>& points) {
  const Eigen::Vector3f origin = follow.cast<float>();
  for (const BodyMesh& bone : subject.bones()) {
    const Eigen::Matrix3f R = subject.pose(bone.body).R.cast<float>();
    const Eigen::Vector3f p = subject.pose(bone.body).p.cast<float>() - origin;
    for (const Eigen::Vector3f& vertex : bone.mesh.vertices) points.push_back(R * vertex + p);
  }
  const ModelSpec& model = subject.model().spec();
  std::vector<PathVertex> path;
  for (int m = 0; m < static_cast<int>(model.muscles.size()); ++m) {
    subject.tracePath(MuscleIndex(m), path);
    for (const PathVertex& vertex : path) points.push_back(vertex.p_G.cast<float>() - origin);
  }
  for (int m = 0; m < static_cast<int>(model.markers.size()); ++m) {
    points.push_back(subject.findMarker(m).cast<float>() - origin);
  }
}

}  // namespace gaitmill
