#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "core/render/bones.h"
#include "core/scale/apply_scale.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

using Vector3d = Eigen::Vector3d;

const ModelSpec& getModel() {
  static const std::string document = "models/rajagopal2016/rajagopal2016.osim";
  static const ModelSpec spec = readOsim(readFile(document), document);
  return spec;
}

const std::vector<BodyMesh>& getBones() {
  static const std::vector<BodyMesh> bones = makeStylizedBones(getModel());
  return bones;
}

const Mesh& findMesh(const std::vector<BodyMesh>& bones, const std::string& body) {
  return std::find_if(
             bones.begin(),
             bones.end(),
             [&](const BodyMesh& bone) { return bone.body.value() == getModel().findBody(body); })
      ->mesh;
}

TEST(StylizedBones, EveryBodyOfTheModelHasSome) {
  EXPECT_EQ(getBones().size(), getModel().bodies.size());
}

TEST(StylizedBones, AreClosedAndLookOutward) {
  for (const BodyMesh& bone : getBones()) {
    SCOPED_TRACE(getModel().bodies[static_cast<std::size_t>(bone.body.value())].name);
    EXPECT_TRUE(isClosed(bone.mesh));
    EXPECT_GT(calcVolume(bone.mesh), 0);
    ASSERT_EQ(bone.mesh.normals.size(), bone.mesh.vertices.size());
    std::size_t against = 0;
    for (const auto& triangle : bone.mesh.triangles) {
      const Eigen::Vector3f normal = bone.mesh.normals[triangle[0]] +
                                     bone.mesh.normals[triangle[1]] +
                                     bone.mesh.normals[triangle[2]];
      against += calcAreaVector(bone.mesh, triangle).dot(normal.cast<double>()) < 0 ? 1u : 0u;
    }
    // Where details are finer than the grid a few triangles fold over.
    EXPECT_LE(against, bone.mesh.triangles.size() / 100);
  }
}

// What the renderer can draw in its time.
TEST(StylizedBones, AreNotTooManyTriangles) {
  std::size_t triangles = 0;
  for (const BodyMesh& bone : getBones()) {
    triangles += bone.mesh.triangles.size();
  }
  EXPECT_LT(triangles, 65000u);
}

/// Outermost places of a body's bones in its frame [m].
struct Extent {
  const char* body;
  Vector3d low, high;
};

// From the model: between the joints, with room for the ends. Adult bones, widths to a centimetre.
TEST(StylizedBones, HaveTheSizeOfTheModelsBones) {
  const Extent extents[] = {
      {"pelvis", {-0.18, -0.135, -0.14}, {0.01, 0.10, 0.14}},
      {"femur_r", {-0.04, -0.43, -0.045}, {0.04, 0.025, 0.075}},
      {"tibia_r", {-0.04, -0.43, -0.04}, {0.04, -0.015, 0.05}},
      {"patella_r", {-0.015, 0.0, -0.025}, {0.018, 0.053, 0.025}},
      {"talus_r", {-0.03, -0.025, -0.03}, {0.04, 0.02, 0.03}},
      {"calcn_r", {-0.02, -0.012, -0.045}, {0.195, 0.05, 0.05}},
      {"toes_r", {-0.04, -0.02, -0.045}, {0.085, 0.02, 0.06}},
      {"torso", {-0.11, -0.03, -0.185}, {0.115, 0.66, 0.185}},
      {"humerus_r", {-0.03, -0.305, -0.04}, {0.035, 0.025, 0.03}},
      {"ulna_r", {-0.04, -0.255, -0.02}, {0.01, 0.02, 0.035}},
      {"radius_r", {-0.025, -0.245, -0.015}, {0.015, 0.01, 0.04}},
      {"hand_r", {-0.02, -0.165, -0.045}, {0.065, 0.01, 0.065}},
  };
  constexpr double kSlack = 0.025;  // of each bound: the smallest dimension that is meant
  for (const Extent& extent : extents) {
    SCOPED_TRACE(extent.body);
    const Eigen::AlignedBox3d box = findBox(findMesh(getBones(), extent.body));
    EXPECT_TRUE(Eigen::AlignedBox3d(extent.low, extent.high).contains(box))
        << box.min().transpose() << " to " << box.max().transpose();
    EXPECT_LT((box.min() - extent.low).maxCoeff(), kSlack);
    EXPECT_LT((extent.high - box.max()).maxCoeff(), kSlack);
  }
}

TEST(StylizedBones, LeftIsTheMirrorImageOfRight) {
  for (const char* stem :
       {"femur", "tibia", "patella", "talus", "calcn", "toes", "humerus", "hand"}) {
    const Mesh& right = findMesh(getBones(), std::string(stem) + "_r");
    const Mesh& left = findMesh(getBones(), std::string(stem) + "_l");
    ASSERT_EQ(right.vertices.size(), left.vertices.size());
    EXPECT_NEAR(calcVolume(right), calcVolume(left), tol(1e-9));
    for (std::size_t i = 0; i < right.vertices.size(); ++i) {
      const Eigen::Vector3f mirrored = right.vertices[i].cwiseProduct(Eigen::Vector3f(1, 1, -1));
      ASSERT_EQ(left.vertices[i], mirrored) << stem;
    }
  }
}

TEST(StylizedBones, StretchWithTheSubject) {
  const ModelSpec scaled =
      applyScaleFactors(getModel(),
                        {{"femur_r", {1.1, 1.2, 1.3}}, {"hand_r", {1.5, 1.5, 1.5}}},
                        MassDistribution::kPreserved);
  const std::vector<BodyMesh> bones = makeStylizedBones(scaled);
  const auto expectStretched = [&](const char* body, const Vector3d& factors) {
    const Eigen::AlignedBox3d before = findBox(findMesh(getBones(), body));
    const Eigen::AlignedBox3d after = findBox(findMesh(bones, body));
    EXPECT_LT((after.sizes() - before.sizes().cwiseProduct(factors)).norm(), tol(1e-6)) << body;
  };
  expectStretched("femur_r", {1.1, 1.2, 1.3});
  expectStretched("hand_r", {1.5, 1.5, 1.5});
  expectStretched("femur_l", {1, 1, 1});
}

double findDistance(const Mesh& mesh, const Vector3d& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    nearest = std::min(nearest, (vertex.cast<double>() - p).norm());
  }
  return nearest;
}

// Origins and insertions are on the bone; the model states them on bones of another person than
// ours, which are simplified too. The psoas begins on the lumbar spine, which is the torso's here.
TEST(StylizedBones, MusclesBeginAndEndOnThem) {
  double sum = 0;
  for (const MuscleSpec& muscle : getModel().muscles) {
    for (const PathPointSpec* end : {&muscle.path.front(), &muscle.path.back()}) {
      const double distance = findDistance(findMesh(getBones(), end->body), end->location);
      const bool on_spine = muscle.name.substr(0, 5) == "psoas" && end == &muscle.path.front();
      EXPECT_LT(distance, tol(on_spine ? 0.050 : 0.030)) << muscle.name << " on " << end->body;
      sum += distance;
    }
  }
  const double ends = 2.0 * static_cast<double>(getModel().muscles.size());
  EXPECT_LT(sum / ends, tol(0.010));
}

/// Two links in a row: "femur" and another body.
ModelSpec makeChain() {
  ModelSpec spec;
  spec.bodies.resize(3);
  spec.bodies[0].name = "femur";
  spec.bodies[1].name = "link";
  spec.bodies[2].name = "tip";
  JointSpec joint;
  joint.parent.body = "link";
  joint.parent.translation = {0, -0.3, 0};
  joint.child.body = "tip";
  spec.joints.push_back(joint);
  return spec;
}

TEST(StylizedBones, UnknownBodiesGetAShaftToTheNextJoint) {
  const std::vector<BodyMesh> bones = makeStylizedBones(makeChain());
  ASSERT_EQ(bones.size(), 2u) << "a body at the end of a chain has none";
  EXPECT_EQ(bones[0].mesh.vertices.size(), findMesh(getBones(), "femur_r").vertices.size());
  const Eigen::AlignedBox3d box = findBox(bones[1].mesh);
  EXPECT_TRUE(isClosed(bones[1].mesh));
  EXPECT_NEAR(box.sizes().y(), 0.3, tol(0.05));
  EXPECT_LT(box.sizes().x(), 0.05);
}

}  // namespace
}  // namespace gaitmill
