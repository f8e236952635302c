#include "core/io/mesh_reader.h"

#include "core/io/file_content.h"
#include "core/io/mesh_builder.h"
#include "core/io/number_text.h"

namespace gaitmill {

namespace {

constexpr std::size_t kMaximumBytes = std::size_t{32} << 20;

bool hasEnding(const std::string& name, std::string_view ending) {
  return name.size() >= ending.size() &&
         equalsIgnoringCase(std::string_view(name).substr(name.size() - ending.size()), ending);
}

}  // namespace

Mesh readMesh(const std::string& name, std::string_view bytes) {
  requireData(bytes, name);
  require(bytes.size() <= kMaximumBytes,
          ErrorCode::kFileTooLarge,
          "a mesh of " + std::to_string(bytes.size()) + " bytes; up to " +
              std::to_string(kMaximumBytes) + " are read",
          {name, 0, 0, {}});
  MeshBuilder mesh(name);
  if (hasEnding(name, ".vtp")) {
    readVtp(skipByteOrderMark(bytes), name, mesh);
  } else if (hasEnding(name, ".stl")) {
    readStl(bytes, mesh);
  } else if (hasEnding(name, ".obj")) {
    readObj(skipByteOrderMark(bytes), mesh);
  } else {
    mesh.fail("the name of a mesh ends in .vtp, .stl or .obj", 0);
  }
  return mesh.finish();
}

}  // namespace gaitmill
