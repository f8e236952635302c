#include "core/render/bones.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <Eigen/Geometry>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/mesh_reader.h"
#include "core/io/number_text.h"
#include "core/render/mesh_kit.h"

namespace gaitmill {

namespace {

std::string takeFileName(const std::string& path) {
  const std::size_t slash = path.find_last_of("/\\");
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

/// The meshes of one folder. Only what a listing of the folder shows can be opened, whatever path a
/// model names.
class GeometryFolder {
 public:
  GeometryFolder(const std::string& folder, std::vector<std::string>& warnings)
      : warnings_(warnings) {
    for (const std::string& path : listFiles(folder, "")) {
      paths_[takeFileName(path)] = path;
    }
    if (paths_.empty()) {
      warnings.push_back("The geometry folder '" + folder + "' is empty or not there.");
    }
  }

  /// The mesh, or nothing and a warning.
  std::optional<Mesh> read(const std::string& mesh_file) {
    const std::string name = takeFileName(mesh_file);
    const std::string* path = find(name);
    if (path == nullptr) {
      warnings_.push_back("The mesh '" + name + "' is not in the geometry folder.");
      return std::nullopt;
    }
    try {
      return readMesh(name, readFile(*path));
    } catch (const Error& error) {
      warnings_.push_back(
          "The mesh '" + name + "' cannot be read: " + error.what() +
          (error.where().line > 0 ? " (line " + std::to_string(error.where().line) + ")." : "."));
      return std::nullopt;
    }
  }

 private:
  // Models made on other systems write names in other case.
  const std::string* find(const std::string& name) const {
    const auto exact = paths_.find(name);
    if (exact != paths_.end()) {
      return &exact->second;
    }
    const auto other = std::find_if(paths_.begin(), paths_.end(), [&](const auto& one) {
      return equalsIgnoringCase(one.first, name);
    });
    return other == paths_.end() ? nullptr : &other->second;
  }

  std::map<std::string, std::string> paths_;  ///< by file name
  std::vector<std::string>& warnings_;
};

bool canScale(const Eigen::Vector3d& factors) {
  return factors.allFinite() && (factors.array() != 0).all();
}

Eigen::Matrix3d makeRotation(const Eigen::Vector3d& angles) {
  return (Eigen::AngleAxisd(angles[0], Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(angles[1], Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(angles[2], Eigen::Vector3d::UnitZ()))
      .toRotationMatrix();
}

/// Bones of one body; empty if none of its meshes can be had.
Mesh readBody(const BodySpec& body, GeometryFolder& folder) {
  Mesh bones;
  for (const MeshSpec& spec : body.meshes) {
    std::optional<Mesh> mesh = folder.read(spec.file);
    if (mesh && canScale(spec.scale_factors)) {
      scaleMesh(*mesh, spec.scale_factors);
      moveMesh(*mesh, makeRotation(spec.orientation), spec.translation);
      appendMesh(bones, *mesh);
    }
  }
  return bones;
}

}  // namespace

std::vector<BodyMesh> readBones(const ModelSpec& model,
                                const std::string& folder,
                                std::vector<std::string>& warnings) {
  GeometryFolder geometry(folder, warnings);
  std::vector<BodyMesh> bones;
  std::vector<bool> has_mesh(model.bodies.size(), false);
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    Mesh mesh = readBody(model.bodies[i], geometry);
    if (!mesh.triangles.empty()) {
      bones.push_back({BodyIndex(static_cast<int>(i)), std::move(mesh)});
      has_mesh[i] = true;
    }
  }
  if (std::all_of(has_mesh.begin(), has_mesh.end(), [](bool has) { return has; })) {
    return bones;  // without the time that stylised bones take to make
  }
  for (BodyMesh& bone : makeStylizedBones(model)) {
    if (!has_mesh[static_cast<std::size_t>(bone.body.value())]) {
      bones.push_back(std::move(bone));
    }
  }
  return bones;
}

}  // namespace gaitmill
