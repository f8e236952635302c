#include "core/io/mesh_reader.h"

#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/mesh_builder.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/shared_data.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

// A cube of side 2 m around the origin, in each format. Its volume is 8, its area 24; each corner
// becomes three vertices, one for each face.
const std::string kCorners[8] = {
    "-1 -1 -1", "1 -1 -1", "1 1 -1", "-1 1 -1", "-1 -1 1", "1 -1 1", "1 1 1", "-1 1 1"};
constexpr int kFaces[6][4] = {
    {0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

std::string joinCorners() {
  std::string text;
  for (const std::string& corner : kCorners) {
    text += corner + "\n";
  }
  return text;
}

std::string makeVtp(const std::string& points,
                    const std::string& corners,
                    const std::string& ends) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" "
         "compressor=\"vtkZLibDataCompressor\">\n"
         "<PolyData><Piece NumberOfPoints=\"8\">\n<Points><DataArray type=\"Float32\" "
         "NumberOfComponents=\"3\" format=\"ascii\">" +
         points +
         "</DataArray></Points>\n<Polys><DataArray type=\"Int32\" Name=\"connectivity\" "
         "format=\"ascii\">" +
         corners + "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" +
         ends + "</DataArray></Polys></Piece></PolyData></VTKFile>\n";
}

std::string makeCubeVtp() {
  std::string corners, ends;
  for (int face = 0; face < 6; ++face) {
    for (const int corner : kFaces[face]) {
      corners += std::to_string(corner) + " ";
    }
    ends += std::to_string(4 * (face + 1)) + " ";
  }
  return makeVtp(joinCorners(), corners, ends);
}

std::string makeCubeObj(bool from_the_end) {
  std::string text = "# cube\nmtllib none.mtl\n";
  for (const std::string& corner : kCorners) {
    text += "v " + corner + "\n";
  }
  for (const auto& face : kFaces) {
    text += "f";
    for (const int corner : face) {
      text += " " + std::to_string(from_the_end ? corner - 8 : corner + 1) + "/1";
    }
    text += "\n";
  }
  return text;
}

std::vector<std::array<int, 3>> listCubeTriangles() {
  std::vector<std::array<int, 3>> triangles;
  for (const auto& f : kFaces) {
    triangles.push_back({f[0], f[1], f[2]});
    triangles.push_back({f[0], f[2], f[3]});
  }
  return triangles;
}

std::string makeCubeStlText() {
  std::string text = "solid cube\n";
  for (const auto& triangle : listCubeTriangles()) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const int corner : triangle) {
      text += "   vertex " + kCorners[corner] + "\n";
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid cube\n";
}

void appendBytes(std::string& bytes, const void* value, std::size_t size) {
  bytes.append(static_cast<const char*>(value), size);
}

Eigen::Vector3f findCorner(int i) {
  const int face = i % 4;
  return {face == 1 || face == 2 ? 1.0F : -1.0F, face > 1 ? 1.0F : -1.0F, i > 3 ? 1.0F : -1.0F};
}

std::string makeCubeStlBinary() {
  std::string bytes(80, ' ');
  bytes.replace(0, 5, "solid");  // as some writers begin even these
  const std::uint32_t count = 12;
  appendBytes(bytes, &count, 4);
  for (const auto& triangle : listCubeTriangles()) {
    bytes.append(12, '\0');
    for (const int corner : triangle) {
      const Eigen::Vector3f p = findCorner(corner);
      appendBytes(bytes, p.data(), 12);
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

void expectCube(const Mesh& cube) {
  EXPECT_EQ(cube.triangles.size(), 12u);
  EXPECT_EQ(cube.vertices.size(), 24u);
  ASSERT_EQ(cube.normals.size(), 24u);
  EXPECT_NEAR(calcVolume(cube), 8, tol(1e-12));
  EXPECT_NEAR(calcArea(cube), 24, tol(1e-12));
  for (std::size_t i = 0; i < cube.vertices.size(); ++i) {
    EXPECT_FLOAT_EQ(cube.normals[i].dot(cube.vertices[i]), 1) << "normal of a face";
  }
}

TEST(MeshReader, CubeIsTheSameInEveryFormat) {
  expectCube(readMesh("cube.vtp", makeCubeVtp()));
  expectCube(readMesh("CUBE.OBJ", makeCubeObj(false)));
  expectCube(readMesh("cube.obj", makeCubeObj(true)));
  expectCube(readMesh("cube.stl", makeCubeStlText()));
  expectCube(readMesh("cube.Stl", makeCubeStlBinary()));
}

TEST(MeshReader, ClosedMeshTurnedInsideOutIsTurnedBack) {
  std::string corners, ends;
  for (int face = 0; face < 6; ++face) {
    for (int k = 3; k >= 0; --k) {
      corners += std::to_string(kFaces[face][k]) + " ";
    }
    ends += std::to_string(4 * (face + 1)) + " ";
  }
  expectCube(readMesh("cube.vtp", makeVtp(joinCorners(), corners, ends)));
}

// The sides of a flat pyramid are 23 degrees apart at most: no crease, so no vertex is doubled.
TEST(MeshReader, SmoothSurfaceKeepsItsVertices) {
  constexpr int kSides = 16;
  std::string obj = "v 0 0 0.2\n";
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * M_PI * i / kSides;
    obj += "v " + std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " 0\n";
  }
  for (int i = 0; i < kSides; ++i) {
    obj += "f 1 " + std::to_string(2 + i) + " " + std::to_string(2 + (i + 1) % kSides) + "\n";
  }
  const Mesh mesh = readMesh("pyramid.obj", obj);
  EXPECT_EQ(mesh.vertices.size(), 17u);
  EXPECT_NEAR(static_cast<double>(mesh.normals[0].z()), 1, tol(1e-6));
}

TEST(MeshReader, NormalsOfTheFileAreKept) {
  const Mesh mesh = readMesh("tilted.obj",
                             "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 5\nvn 0 3 4\n"
                             "f 1//1 2//1 3//2\n");
  ASSERT_EQ(mesh.normals.size(), 3u);
  EXPECT_LT((mesh.normals[0] - Eigen::Vector3f(0, 0, 1)).norm(), 1e-6F);
  EXPECT_LT((mesh.normals[2] - Eigen::Vector3f(0, 0.6F, 0.8F)).norm(), 1e-6F);
}

// An L of area 3: a fan from its first corner would cover 4.
TEST(MeshReader, ConcavePolygonIsCutWithoutOverlap) {
  const Mesh mesh = readMesh("l.obj",
                             "v 0 1 0\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n"
                             "f 4 5 6 7 1 2 3\n");
  EXPECT_EQ(mesh.triangles.size(), 5u);
  EXPECT_NEAR(calcArea(mesh), 3, tol(1e-12));
  for (const auto& triangle : mesh.triangles) {
    EXPECT_GE(calcAreaVector(mesh, triangle).z(), 0);
  }
}

TEST(MeshReader, PolygonOfManyCornersIsRead) {
  std::string obj, face = "f";
  constexpr int kCount = 1000;
  for (int i = 0; i < kCount; ++i) {
    const double angle = 2 * M_PI * i / kCount;
    obj += "v " + std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " 0\n";
    face += " " + std::to_string(i + 1);
  }
  const Mesh mesh = readMesh("disc.obj", obj + face);
  EXPECT_EQ(mesh.triangles.size(), 998u);
  EXPECT_NEAR(calcArea(mesh), 0.5 * kCount * std::sin(2 * M_PI / kCount), tol(1e-5));
}

// One triangle as VTK writes it inline: a UInt32 count of bytes, then little-endian numbers.
TEST(MeshReader, InlineBinaryVtpIsRead) {
  const Mesh mesh = readMesh(
      "t.vtp",
      "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\"><PolyData><Piece><Points>"
      "<DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"binary\">"
      "JAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAABAAAAAAA==</DataArray></Points><Polys>"
      "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"binary\">"
      "DAAAAAAAAAABAAAAAgAAAA==</DataArray>"
      "<DataArray type=\"Int64\" Name=\"offsets\" format=\"binary\">CAAAAAMAAAAAAAAA</DataArray>"
      "</Polys></Piece></PolyData></VTKFile>");
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.vertices[1], Eigen::Vector3f(1, 0, 0));
  EXPECT_EQ(mesh.vertices[2], Eigen::Vector3f(0, 2, 0));
}

TEST(MeshReader, StripsBecomeTrianglesThatFaceOneWay) {
  const std::string vtp =
      "<VTKFile type=\"PolyData\"><PolyData><Piece><Points><DataArray NumberOfComponents=\"3\" "
      "format=\"ascii\">0 0 0 1 0 0 0 1 0 1 1 0</DataArray></Points><Strips>"
      "<DataArray Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray>"
      "<DataArray Name=\"offsets\" format=\"ascii\">4</DataArray></Strips></Piece></PolyData>"
      "</VTKFile>";
  const Mesh mesh = readMesh("strip.vtp", vtp);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  for (const auto& triangle : mesh.triangles) {
    EXPECT_EQ(calcAreaVector(mesh, triangle).z(), 0.5);
  }
}

void expectRefused(const std::string& name, const std::string& bytes, int line) {
  SCOPED_TRACE(name + ": " + bytes.substr(0, 60));
  try {
    readMesh(name, bytes);
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kMeshFormat) << error.what();
    EXPECT_EQ(error.where().file, name);
    EXPECT_EQ(error.where().line, line) << error.what();
  }
}

TEST(MeshReader, DamagedFilesAreRefusedByLine) {
  expectRefused("a.ply", "ply\n", 0);
  expectRefused("a.vtp", "<VTKFile><PolyData>", 1);
  expectRefused("a.vtp", "<VTKFile><ImageData/></VTKFile>", 1);
  expectRefused("a.vtp", makeVtp("0 0 0 1 0", "0 1 2", "3"), 4);
  expectRefused("a.vtp", makeVtp("0 0 0\n1 0 x\n0 1 0", "0 1 2", "3"), 5);
  expectRefused("a.vtp", makeVtp("0 0 0 1 0 nan 0 1 0", "0 1 2", "3"), 4);
  expectRefused("a.vtp", makeVtp("0 0 0 1 0 0 0 1 0", "0 1 3", "3"), 5);
  expectRefused("a.vtp", makeVtp("0 0 0 1 0 0 0 1 0", "0 1 -1", "3"), 5);
  expectRefused("a.vtp", makeVtp("0 0 0 1 0 0 0 1 0", "0 1 2", "4"), 6);
  expectRefused("a.vtp", makeVtp("0 0 0 1 0 0 0 1 0", "0 1 2", "3 1"), 6);
  expectRefused("a.vtp", makeVtp("", "", ""), 0);
  expectRefused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1\n", 3);
  expectRefused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", 4);
  expectRefused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", 4);
  expectRefused("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n", 3);
  expectRefused("a.obj", "v 0 0 1e30\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", 4);
  expectRefused("a.obj", "# nothing\n", 0);
  expectRefused("a.stl", "solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\n", 5);
  expectRefused("a.stl", "solid\nfacet\nvertex 0 0\n", 3);
  expectRefused("a.stl", "solid\nvertex 0 0 nan\n", 2);
  expectRefused("a.stl", makeCubeStlBinary().replace(0, 5, "cube ").substr(0, 200), 1);
}

class MeshReaderShared : public SharedDataTest {};

// data/README.md 4: 56 433 triangles, 9 376 quads, 152 polygons of 5 to 10 corners. The larger ones
// make sum(n - 2) triangles between 3 and 8 each.
TEST_F(MeshReaderShared, EveryMeshOfTheGeometryFolderIsRead) {
  const std::vector<std::string> files = listFiles(shared("data/geometry"), ".vtp");
  EXPECT_EQ(files.size(), 98u);
  std::size_t triangles = 0;
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    const Mesh mesh = readMesh(file, readFile(file));
    ASSERT_EQ(mesh.normals.size(), mesh.vertices.size());
    EXPECT_GT(mesh.triangles.size(), 0u);
    triangles += mesh.triangles.size();
  }
  EXPECT_GE(triangles, 56433u + 2 * 9376u + 3 * 152u);
  EXPECT_LE(triangles, 56433u + 2 * 9376u + 8 * 152u);
}

// The femur's head is a ball of some 23 mm around the hip's centre, its condyles 0.4 m below.
TEST_F(MeshReaderShared, FemurIsInItsBodysFrame) {
  const std::string file = shared("data/geometry/r_femur.vtp");
  const Eigen::AlignedBox3d box = findBox(readMesh(file, readFile(file)));
  EXPECT_NEAR(box.max().y(), 0.022, tol(0.001));
  EXPECT_NEAR(box.min().y(), -0.430, tol(0.001));
}

}  // namespace
}  // namespace gaitmill
