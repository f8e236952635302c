#include "core/render/bones.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/shared_data.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

using Vector3d = Eigen::Vector3d;

/// A model of one free body "stone" that names the meshes.
ModelSpec makeStone(const std::vector<MeshSpec>& meshes) {
  ModelSpec spec;
  BodySpec body;
  body.name = "stone";
  body.meshes = meshes;
  spec.bodies.push_back(body);
  return spec;
}

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

MeshSpec makeMeshSpec(const std::string& file) {
  MeshSpec mesh;
  mesh.file = file;
  return mesh;
}

TEST(ReadBones, MeshIsScaledThenPlaced) {
  const TemporaryFolder folder;
  writeFile(folder / "t.obj", kTriangle);
  MeshSpec mesh = makeMeshSpec("t.obj");
  mesh.scale_factors = {2, 3, 4};
  mesh.orientation = {0, 0, M_PI / 2};
  mesh.translation = {10, 0, 0};
  std::vector<std::string> warnings;
  const auto bones = readBones(makeStone({mesh}), folder.path(), warnings);
  EXPECT_TRUE(warnings.empty());
  ASSERT_EQ(bones.size(), 1u);
  EXPECT_EQ(bones[0].body, BodyIndex(0));
  EXPECT_LT((bones[0].mesh.vertices[1].cast<double>() - Vector3d(10, 2, 0)).norm(), tol(1e-6));
  EXPECT_LT((bones[0].mesh.vertices[2].cast<double>() - Vector3d(7, 0, 0)).norm(), tol(1e-6));
}

TEST(ReadBones, NegativeFactorMirrorsWithoutTurningInsideOut) {
  const TemporaryFolder folder;
  writeFile(folder / "t.obj", kTriangle);
  MeshSpec mesh = makeMeshSpec("t.obj");
  mesh.scale_factors = {-1, 1, 1};
  std::vector<std::string> warnings;
  const auto bones = readBones(makeStone({mesh}), folder.path(), warnings);
  ASSERT_EQ(bones.size(), 1u);
  const Mesh& mirrored = bones[0].mesh;
  EXPECT_EQ(calcAreaVector(mirrored, mirrored.triangles[0]).z(), 0.5);
  EXPECT_EQ(mirrored.normals[0].z(), 1.0F);
}

TEST(ReadBones, NamesMayDifferInCase) {
  const TemporaryFolder folder;
  writeFile(folder / "R_Femur.OBJ", kTriangle);
  std::vector<std::string> warnings;
  EXPECT_EQ(readBones(makeStone({makeMeshSpec("r_femur.obj")}), folder.path(), warnings).size(),
            1u);
  EXPECT_TRUE(warnings.empty());
}

// The file exists where the path points, but only the folder's own files are opened.
TEST(ReadBones, PathsOutOfTheFolderAreNotFollowed) {
  const TemporaryFolder folder;
  writeFile(folder / "secret.obj", kTriangle);
  writeFile(folder / "geometry/t.obj", kTriangle);
  for (const std::string& name :
       {std::string("../secret.obj"), folder / "secret.obj", std::string("..\\secret.obj")}) {
    std::vector<std::string> warnings;
    EXPECT_TRUE(readBones(makeStone({makeMeshSpec(name)}), folder / "geometry", warnings).empty());
    ASSERT_EQ(warnings.size(), 1u) << name;
    EXPECT_NE(warnings[0].find("secret.obj"), std::string::npos);
  }
}

TEST(ReadBones, MissingAndDamagedFilesBecomeWarnings) {
  const TemporaryFolder folder;
  writeFile(folder / "bad.obj", "v 0 0 0\nv 1\n");
  writeFile(folder / "t.obj", kTriangle);
  std::vector<std::string> warnings;
  const auto bones = readBones(
      makeStone({makeMeshSpec("none.vtp"), makeMeshSpec("bad.obj"), makeMeshSpec("t.obj")}),
      folder.path(),
      warnings);
  EXPECT_EQ(bones.size(), 1u);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find("none.vtp"), std::string::npos);
  EXPECT_NE(warnings[1].find("line 2"), std::string::npos) << warnings[1];
}

TEST(ReadBones, BodiesWithoutFilesGetStylizedBones) {
  const std::string document = "models/rajagopal2016/rajagopal2016.osim";
  const TemporaryFolder folder;
  writeFile(folder / "r_femur.vtp", "no mesh at all");
  std::vector<std::string> warnings;
  const ModelSpec model = readOsim(readFile(document), document);
  EXPECT_EQ(readBones(model, folder.path(), warnings).size(), model.bodies.size());
  EXPECT_EQ(warnings.size(), 81u);
}

class ReadBonesShared : public SharedDataTest {};

TEST_F(ReadBonesShared, GeometryFolderServesTheWholeModel) {
  const std::string document = "models/rajagopal2016/rajagopal2016.osim";
  std::vector<std::string> warnings;
  const ModelSpec model = readOsim(readFile(document), document);
  const auto bones = readBones(model, shared("data/geometry"), warnings);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(bones.size(), model.bodies.size());
}

}  // namespace
}  // namespace gaitmill
