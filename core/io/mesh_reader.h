#pragma once

#include <string>
#include <string_view>

#include "core/data/mesh.h"

namespace gaitmill {

/// Reads a surface: VTK XML PolyData (.vtp; data arrays as text or as uncompressed base64), STL
/// (text or binary) or Wavefront OBJ, told apart by the ending of the name. Polygons of any size
/// and triangle strips become triangles; points, lines, textures and materials are ignored. Units
/// are those of the file: metres, as model documents mean them.
///
/// Normals are the file's where each vertex has one; else each corner's is the mean of the
/// triangles around it that are less than 60° apart from its own, weighted by area, so that
/// vertices on a crease are doubled. Triangles of a closed surface that are all turned inside out
/// are turned back.
///
/// @param name  of the file; its ending decides, and errors name it; nothing is opened
/// Files beyond 32 MiB and meshes beyond two million triangles or vertices are refused.
/// @throws Error kMeshFormat with the line where there is one, kFileEmpty, kFileNotTheData,
/// kFileTooLarge
Mesh readMesh(const std::string& name, std::string_view bytes);

}  // namespace gaitmill
