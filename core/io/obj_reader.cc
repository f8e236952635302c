// Wavefront OBJ: vertices, normals and faces.

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/io/mesh_builder.h"
#include "core/io/number_text.h"
#include "core/io/text_cells.h"

namespace gaitmill {

namespace {

using Vector3f = Eigen::Vector3f;

constexpr long kNone = -1;

/// A corner of a face: positions in the lists of vertices and normals.
using Corner = std::pair<long, long>;

class ObjReader {
 public:
  ObjReader(std::string_view bytes, MeshBuilder& mesh) : lines_(bytes), mesh_(mesh) {}

  void read() {
    while (lines_.next()) {
      splitAtBlanks(lines_.line(), words_);
      const std::string_view word = words_.empty() ? "" : words_.front().text;
      if (word == "v") {
        points_.push_back(readPoint());
      } else if (word == "vn") {
        normals_.push_back(readPoint());
      } else if (word == "f") {
        readFace();
      }
    }
    build();
  }

 private:
  struct Face {
    std::vector<Corner> corners;
    int line = 0;
  };

  // A vertex may carry a weight or a colour behind its place.
  Vector3f readPoint() {
    Vector3f p;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto value = i + 1 < words_.size() ? parseNumber(words_[i + 1].text) : std::nullopt;
      if (!value) {
        fail("'" + std::string(words_.front().text) + "' is not followed by three numbers");
      }
      p[static_cast<Eigen::Index>(i)] = static_cast<float>(*value);
    }
    if (points_.size() + normals_.size() > kMaximumPoints) {
      fail("the file has more than " + std::to_string(kMaximumPoints) + " vertices and normals");
    }
    return p;
  }

  // "7", "7/2", "7//3" or "7/2/3", from 1; negative ones count back from the last.
  Corner readCorner(std::string_view text) const {
    const std::size_t first = text.find('/');
    const std::size_t second = first == text.npos ? text.npos : text.find('/', first + 1);
    return {readIndex(text.substr(0, first), points_.size()),
            second == text.npos ? kNone : readIndex(text.substr(second + 1), normals_.size())};
  }

  long readIndex(std::string_view text, std::size_t count) const {
    const std::optional<long> number = parseInteger(text);
    const auto size = static_cast<long>(count);
    if (!number || *number == 0 || *number > size || *number < -size) {
      fail("'" + std::string(text.substr(0, 20)) + "' names none of the " + std::to_string(count) +
           " that are there so far");
    }
    return *number > 0 ? *number - 1 : size + *number;
  }

  void readFace() {
    if (words_.size() < 4) {
      fail("a face has fewer than three corners");
    }
    Face face;
    face.line = lines_.number();
    for (std::size_t i = 1; i < words_.size(); ++i) {
      face.corners.push_back(readCorner(words_[i].text));
      all_have_normals_ = all_have_normals_ && face.corners.back().second != kNone;
    }
    corner_count_ += face.corners.size();
    if (corner_count_ > kMaximumCorners) {
      fail("the file has more than " + std::to_string(kMaximumCorners) + " corners of faces");
    }
    faces_.push_back(std::move(face));
  }

  // A vertex of the mesh for each pair of place and normal.
  void build() {
    std::map<Corner, std::uint32_t> vertices;
    for (const Face& face : faces_) {
      std::vector<std::uint32_t> polygon;
      for (Corner corner : face.corners) {
        corner.second = all_have_normals_ ? corner.second : kNone;
        const auto next = static_cast<std::uint32_t>(mesh_.vertexCount());
        const auto [known, is_new] = vertices.try_emplace(corner, next);
        if (is_new) {
          addVertex(corner, face.line);
        }
        polygon.push_back(known->second);
      }
      mesh_.addPolygon(polygon, face.line);
    }
  }

  void addVertex(const Corner& corner, int line) {
    const Vector3f& p = points_[static_cast<std::size_t>(corner.first)];
    mesh_.addVertex(
        static_cast<double>(p.x()), static_cast<double>(p.y()), static_cast<double>(p.z()), line);
    if (all_have_normals_) {
      mesh_.addNormal(normals_[static_cast<std::size_t>(corner.second)]);
    }
  }

  [[noreturn]] void fail(const std::string& message) const { mesh_.fail(message, lines_.number()); }

  static constexpr std::size_t kMaximumPoints = 4000000;
  static constexpr std::size_t kMaximumCorners = 8000000;

  LineReader lines_;
  MeshBuilder& mesh_;
  std::vector<Cell> words_;
  std::vector<Vector3f> points_, normals_;
  std::vector<Face> faces_;
  std::size_t corner_count_ = 0;
  bool all_have_normals_ = true;
};

}  // namespace

void readObj(std::string_view bytes, MeshBuilder& mesh) {
  ObjReader(bytes, mesh).read();
}

}  // namespace gaitmill
