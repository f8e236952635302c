#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/osim_reader.h"
#include "tests/core/io/osim_samples.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

using Vector3d = Eigen::Vector3d;

std::vector<MeshSpec> readThighMeshes(const std::string& version, const std::string& geometry) {
  OsimPieces pieces;
  pieces.version = version;
  pieces.thigh = geometry;
  return readOsim(makeOsim(pieces), "leg.osim").bodies[0].meshes;
}

TEST(OsimGeometry, AttachedMeshesAreReadInOrder) {
  const auto meshes = readThighMeshes(
      "40000",
      "<attached_geometry><Mesh name=\"a\"><mesh_file>bone.vtp</mesh_file></Mesh>"
      "<Sphere name=\"s\"><radius>1</radius></Sphere>"
      "<Mesh name=\"b\"><scale_factors>1 2 3</scale_factors><mesh_file>cap.stl</mesh_file></Mesh>"
      "</attached_geometry>");
  ASSERT_EQ(meshes.size(), 2u);
  EXPECT_EQ(meshes[0].file, "bone.vtp");
  EXPECT_EQ(meshes[0].scale_factors, Vector3d::Ones());
  EXPECT_EQ(meshes[1].file, "cap.stl");
  EXPECT_EQ(meshes[1].scale_factors, Vector3d(1, 2, 3));
}

TEST(OsimGeometry, HiddenMeshesAreLeftOut) {
  EXPECT_TRUE(readThighMeshes("40000",
                              "<attached_geometry><Mesh name=\"a\"><mesh_file>bone.vtp</mesh_file>"
                              "<Appearance><visible>false</visible></Appearance></Mesh>"
                              "</attached_geometry>")
                  .empty());
}

// R = Rx(90 deg) turns y to z: the outer frame carries the mesh's frame to (1, 0, 2).
TEST(OsimGeometry, FramesOfABodyCarryMeshes) {
  const auto meshes = readThighMeshes(
      "40000",
      "<components><PhysicalOffsetFrame name=\"outer\"><socket_parent>..</socket_parent>"
      "<translation>1 0 0</translation><orientation>1.5707963267948966 0 0</orientation>"
      "</PhysicalOffsetFrame><PhysicalOffsetFrame name=\"inner\">"
      "<socket_parent>/bodyset/thigh/outer</socket_parent><translation>0 2 0</translation>"
      "<attached_geometry><Mesh name=\"a\"><mesh_file>bone.vtp</mesh_file></Mesh>"
      "</attached_geometry></PhysicalOffsetFrame></components>");
  ASSERT_EQ(meshes.size(), 1u);
  EXPECT_LT((meshes[0].translation - Vector3d(1, 0, 2)).norm(), tol(1e-15));
  EXPECT_LT((meshes[0].orientation - Vector3d(1.5707963267948966, 0, 0)).norm(), tol(1e-15));
}

TEST(OsimGeometry, VisibleObjectsMultiplyTheirFactors) {
  const auto meshes = readThighMeshes(
      "30000",
      "<VisibleObject><GeometrySet><objects><DisplayGeometry>"
      "<geometry_file>bone.vtp</geometry_file><transform>0.1 0.2 0.3 4 5 6</transform>"
      "<scale_factors>2 3 4</scale_factors></DisplayGeometry>"
      "<DisplayGeometry><geometry_file>hidden.vtp</geometry_file>"
      "<display_preference>0</display_preference></DisplayGeometry></objects></GeometrySet>"
      "<scale_factors>0.5 0.5 1</scale_factors><transform>-0 0 -0 0 0 0</transform>"
      "</VisibleObject>");
  ASSERT_EQ(meshes.size(), 1u);
  EXPECT_EQ(meshes[0].file, "bone.vtp");
  EXPECT_EQ(meshes[0].scale_factors, Vector3d(1, 1.5, 4));
  EXPECT_EQ(meshes[0].translation, Vector3d(4, 5, 6));
  EXPECT_EQ(meshes[0].orientation, Vector3d(0.1, 0.2, 0.3));
}

TEST(OsimGeometry, FactorsThatAreNoNumbersAreRefused) {
  try {
    readThighMeshes("40000",
                    "<attached_geometry><Mesh name=\"a\"><scale_factors>1 x 1</scale_factors>"
                    "<mesh_file>bone.vtp</mesh_file></Mesh></attached_geometry>");
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kModelValue);
    EXPECT_EQ(error.where().line, 1);
  }
}

}  // namespace
}  // namespace gaitmill
