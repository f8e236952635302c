#include "core/render/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/render/color_scale.h"
#include "tests/support/stride_picture.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

class Scene : public ::testing::Test {
 protected:
  Scene() { subject.setPose(data.kinematics, 0.5); }
  const ModelSpec& spec() const { return subject.model().spec(); }

  Surface draw(const PictureOptions& options) {
    Surface surface;
    makeFigure(subject, data, 0.5, options, 0, surface);
    return surface;
  }
  // Only one kind of thing.
  static PictureOptions makeNothing() {
    PictureOptions options;
    options.bones = options.muscles = options.markers = options.forces = options.ground = false;
    return options;
  }

  PictureData data = makeStridePicture();
  Subject subject{data.model_osim, ""};
};

double findNearest(const Surface& surface, const Eigen::Vector3d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const SurfaceVertex& v : surface.vertices) {
    nearest = std::min(nearest, (v.position.cast<double>() - point).norm());
  }
  return nearest;
}

TEST_F(Scene, TubesRunThroughEveryVertexOfTheirPaths) {
  int bent = 0;
  std::vector<PathVertex> path;
  for (int m = 0; m < subject.model().muscleCount(); ++m) {
    subject.tracePath(MuscleIndex(m), path);
    const std::vector<TubeRing> rings =
        makeMuscleRings(path, findMuscleShape(spec().muscles[static_cast<std::size_t>(m)]), {});
    std::size_t at = 0;
    for (const PathVertex& vertex : path) {
      while (at < rings.size() && (rings[at].center - vertex.p_G).norm() > 1e-12) ++at;
      ASSERT_LT(at, rings.size()) << spec().muscles[static_cast<std::size_t>(m)].name;
    }
    if (path.size() > spec().muscles[static_cast<std::size_t>(m)].path.size()) ++bent;
  }
  EXPECT_GT(bent, 10);  // arcs over cylinders were among them
}

// Distance of a point in ground from the axis of a cylinder on a body.
double findAxisDistance(const Subject& subject,
                        BodyIndex body,
                        const WrapObjectSpec& cylinder,
                        const Eigen::Vector3d& p_G) {
  const Eigen::Matrix3d R_BW = (Eigen::AngleAxisd(cylinder.rotation.x(), Eigen::Vector3d::UnitX()) *
                                Eigen::AngleAxisd(cylinder.rotation.y(), Eigen::Vector3d::UnitY()) *
                                Eigen::AngleAxisd(cylinder.rotation.z(), Eigen::Vector3d::UnitZ()))
                                   .toRotationMatrix();
  const Pose& X_GB = subject.pose(body);
  const Eigen::Vector3d p_B = X_GB.R.transpose() * (p_G - X_GB.p);
  return (R_BW.transpose() * (p_B - cylinder.translation)).head<2>().norm();
}

// Between the first and the last point on its cylinder a tube lies on the surface, less the sagitta
// of chords of 8 degrees.
TEST_F(Scene, WrappedTubesFollowTheirCylinders) {
  int wrapped = 0;
  for (std::size_t b = 0; b < spec().bodies.size(); ++b) {
    const BodyIndex body(static_cast<int>(b));
    for (const WrapObjectSpec& cylinder : spec().bodies[b].wrap_objects) {
      for (std::size_t m = 0; m < spec().muscles.size(); ++m) {
        const MuscleSpec& muscle = spec().muscles[m];
        if (muscle.wraps.size() != 1 || muscle.wraps[0].wrap_object != cylinder.name) continue;
        std::vector<PathVertex> path;
        subject.tracePath(MuscleIndex(static_cast<int>(m)), path);
        if (path.size() < muscle.path.size() + 2) continue;
        std::vector<double> on;  // of rings from touching to leaving
        std::vector<double> pending;
        for (const TubeRing& ring : makeMuscleRings(path, findMuscleShape(muscle), {})) {
          const double distance = findAxisDistance(subject, body, cylinder, ring.center);
          pending.push_back(distance);
          if (std::abs(distance - cylinder.radius) > 1e-9) continue;
          if (!on.empty()) on.insert(on.end(), pending.begin(), pending.end());
          if (on.empty()) on.push_back(distance);
          pending.clear();
        }
        ASSERT_GE(on.size(), 2U) << muscle.name;
        for (const double distance : on) {
          EXPECT_GT(distance, cylinder.radius * std::cos(toRadians(4.01))) << muscle.name;
          EXPECT_LT(distance, cylinder.radius + 1e-9) << muscle.name;
        }
        ++wrapped;
      }
    }
  }
  EXPECT_GT(wrapped, 4);
}

TEST_F(Scene, BelliesAreThickerThanTendons) {
  for (const MuscleSpec& muscle : spec().muscles) {
    const MuscleShape shape = findMuscleShape(muscle);
    std::vector<PathVertex> path(2);
    path[1].p_G = {0, 0.4, 0};
    const std::vector<TubeRing> rings = makeMuscleRings(path, shape, {});
    const auto thicker = [](const TubeRing& a, const TubeRing& b) {
      return a.radius < b.radius;
    };
    const TubeRing& belly = *std::max_element(rings.begin(), rings.end(), thicker);
    EXPECT_NEAR(belly.radius, shape.belly_radius, tol(0.03 * shape.belly_radius));
    EXPECT_GT(belly.radius, 1.3 * rings.back().radius) << muscle.name;
  }
}

TEST_F(Scene, StrongLongFiberedMusclesAreThickest) {
  const auto find = [&](const char* name) {
    return findMuscleShape(spec().muscles[static_cast<std::size_t>(spec().findMuscle(name))])
        .belly_radius;
  };
  EXPECT_GT(find("soleus_r"), find("tibpost_r"));
  EXPECT_GT(find("tibpost_r"), find("fhl_r"));
  EXPECT_EQ(find("vaslat_r"), find("vaslat_l"));
}

TEST_F(Scene, MusclesHaveTheColorOfTheirActivation) {
  activateSoleus(spec(), data);
  PictureOptions options = makeNothing();
  options.muscles = true;
  const Surface surface = draw(options);
  const Rgb red = getColorScale(MuscleColor::kActivation).findColor(1);
  std::vector<PathVertex> path;
  subject.tracePath(MuscleIndex(spec().findMuscle("soleus_r")), path);
  int count = 0;
  for (const SurfaceVertex& v : surface.vertices) {
    if (v.color != red) continue;
    ++count;
    double nearest = 1;
    for (std::size_t i = 1; i < path.size(); ++i) {
      const Eigen::Vector3d a = path[i - 1].p_G, ab = path[i].p_G - a;
      const double t = (v.position.cast<double>() - a).dot(ab) / ab.squaredNorm();
      const Eigen::Vector3d foot = a + std::clamp(t, 0.0, 1.0) * ab;
      nearest = std::min(nearest, (v.position.cast<double>() - foot).norm());
    }
    EXPECT_LT(nearest, 0.0145);  // no other muscle is red
  }
  EXPECT_GT(count, 50);
}

TEST_F(Scene, ForceIsShownAsShareOfTheMaximum) {
  data.muscle_values = makeConstantTable({{"soleus_r", 0.5 * 6195}});
  data.muscle_values.values.setConstant(
      0.5 *
      spec().muscles[static_cast<std::size_t>(spec().findMuscle("soleus_r"))].max_isometric_force);
  PictureOptions options = makeNothing();
  options.muscles = true;
  options.color = MuscleColor::kForce;
  const Surface surface = draw(options);
  const Rgb half = getColorScale(MuscleColor::kForce).findColor(0.5);
  const auto has = [&](const Rgb& color) {
    return std::any_of(surface.vertices.begin(), surface.vertices.end(), [&](const auto& v) {
      return v.color == color;
    });
  };
  EXPECT_TRUE(has(half));
  EXPECT_TRUE(has(kUnknownMuscle));  // the other 79
}

TEST_F(Scene, ForceStandsOnItsCenterOfPressure) {
  PictureOptions options = makeNothing();
  options.forces = true;
  const Surface surface = draw(options);
  const Eigen::Vector3d force(-90, 700, 20), point(0.68, 0, 0.09);
  EXPECT_LT(findNearest(surface, point + kArrowLengthPerForce * force), 1e-6);  // the tip
  EXPECT_LT(findNearest(surface, point), 0.0111);                               // the tail's rim
  for (const SurfaceVertex& v : surface.vertices) EXPECT_EQ(v.color, kForceColor);
}

TEST_F(Scene, UnloadedFootHasNoArrow) {
  data.ground_reactions.values.rightCols(3).setConstant(std::numeric_limits<double>::quiet_NaN());
  PictureOptions options = makeNothing();
  options.forces = true;
  EXPECT_TRUE(draw(options).vertices.empty());
}

TEST_F(Scene, MarkersAreWhereTheyWereMeasuredAndWhereTheModelHasThem) {
  const MarkerSpec& marker = spec().markers.front();
  const Eigen::Vector3d model = subject.findMarker(0),
                        measured = model + Eigen::Vector3d(0.05, 0, 0);
  data.markers = makeConstantTable({{marker.name + "_x", measured.x()},
                                    {marker.name + "_y", measured.y()},
                                    {marker.name + "_z", measured.z()}});
  PictureOptions options = makeNothing();
  options.markers = true;
  const Surface surface = draw(options);
  Eigen::Vector3d means[2] = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  int counts[2] = {0, 0};
  for (const SurfaceVertex& v : surface.vertices) {
    const int kind = v.color == kMeasuredMarkerColor ? 1 : 0;
    means[kind] += v.position.cast<double>();
    ++counts[kind];
  }
  ASSERT_EQ(counts[0], counts[1]);  // one of each: the others were not measured
  EXPECT_NEAR((means[0] / counts[0] - model).norm(), 0, tol(1e-5));
  EXPECT_NEAR((means[1] / counts[1] - measured).norm(), 0, tol(1e-5));
}

TEST_F(Scene, FloorIsFlatAndFadesOut) {
  Surface surface;
  const FloorStyle style{1.5, 0.5};
  makeFloor(subject, style, surface);
  const Eigen::Vector3d middle = subject.findFollowPoint();
  int opaque = 0;
  for (const SurfaceVertex& v : surface.vertices) {
    EXPECT_EQ(v.position.y(), 0);
    const double distance = (v.position.cast<double>() - middle).norm();
    EXPECT_LT(distance, 1.51);
    if (distance > 1.499) {
      EXPECT_EQ(v.weight, 0);
    }
    if (v.weight > 200) ++opaque;
  }
  EXPECT_GT(opaque, 100);
}

TEST_F(Scene, OutlineHoldsBonesPathsAndMarkers) {
  std::vector<Eigen::Vector3f> points;
  collectOutline(subject, {0, 0, 0}, points);
  std::size_t vertices = spec().markers.size();
  for (const BodyMesh& bone : subject.bones()) vertices += bone.mesh.vertices.size();
  EXPECT_GT(points.size(), vertices + 2 * spec().muscles.size() - 1);
}

TEST_F(Scene, MotionWithoutAValueIsRefusedByName) {
  data.kinematics.values.col(3).setConstant(std::numeric_limits<double>::quiet_NaN());
  try {
    subject.setPose(data.kinematics, 0.5);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInputCoordinates);
    EXPECT_EQ(error.where().coordinate, data.kinematics.labels[3]);
  }
}

TEST_F(Scene, WithoutMotionTheSubjectStandsInTheDefaultPose) {
  subject.setPose({}, 0);
  ModelState state(subject.model());
  state.setPose(subject.model().defaultPose());
  const BodyIndex foot = subject.model().getBody("calcn_r");
  EXPECT_EQ(subject.pose(foot).p, state.pose(foot).p);
}

}  // namespace
}  // namespace gaitmill
