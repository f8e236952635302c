// STL, as text and as binary.

#include <array>
#include <cstring>
#include <map>
#include <vector>

#include "core/io/mesh_builder.h"
#include "core/io/number_text.h"
#include "core/io/text_cells.h"

namespace gaitmill {

namespace {

constexpr std::size_t kHeader = 84;  // [bytes] text and number of triangles
constexpr std::size_t kFacet = 50;   // [bytes] normal, three corners, attributes

std::uint32_t readWord(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 4; i-- > 0;) {
    word = word << 8 | static_cast<unsigned char>(bytes[at + i]);
  }
  return word;
}

float readFloat(std::string_view bytes, std::size_t at) {
  const std::uint32_t word = readWord(bytes, at);
  float value = 0;
  std::memcpy(&value, &word, sizeof value);
  return value;
}

/// Facets repeat their corners: equal ones become one vertex, so that normals can be smooth.
class Welder {
 public:
  explicit Welder(MeshBuilder& mesh) : mesh_(mesh) {}

  void addCorner(const std::array<double, 3>& p, int line) {
    const auto next = static_cast<std::uint32_t>(mesh_.vertexCount());
    const auto [known, is_new] = vertices_.try_emplace(p, next);
    if (is_new) {
      mesh_.addVertex(p[0], p[1], p[2], line);
    }
    corners_.push_back(known->second);
    if (corners_.size() == 3) {
      mesh_.addTriangle(corners_[0], corners_[1], corners_[2], line);
      corners_.clear();
    }
  }

 private:
  MeshBuilder& mesh_;
  std::map<std::array<double, 3>, std::uint32_t> vertices_;
  std::vector<std::uint32_t> corners_;
};

// A value that is not a number would break the order of the welder's map.
void requireNumbers(const std::array<double, 3>& p, const MeshBuilder& mesh, int line) {
  for (const double value : p) {
    if (value != value) {
      mesh.fail("a vertex has a coordinate that is not finite", line);
    }
  }
}

void readBinary(std::string_view bytes, MeshBuilder& mesh) {
  Welder welder(mesh);
  for (std::size_t at = kHeader; at + kFacet <= bytes.size(); at += kFacet) {
    for (std::size_t corner = 1; corner <= 3; ++corner) {
      std::array<double, 3> p = {};
      for (std::size_t i = 0; i < 3; ++i) {
        p[i] = static_cast<double>(readFloat(bytes, at + 12 * corner + 4 * i));
      }
      requireNumbers(p, mesh, 0);
      welder.addCorner(p, 0);
    }
  }
}

std::array<double, 3> readCorner(const std::vector<Cell>& words,
                                 const MeshBuilder& mesh,
                                 int line) {
  std::array<double, 3> p = {};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto value = words.size() == 4 ? parseNumber(words[i + 1].text) : std::nullopt;
    if (!value) {
      mesh.fail("'vertex' is not followed by three numbers", line);
    }
    p[i] = *value;
  }
  requireNumbers(p, mesh, line);
  return p;
}

void readText(std::string_view bytes, MeshBuilder& mesh) {
  Welder welder(mesh);
  LineReader lines(bytes);
  std::vector<Cell> words;
  int corners = 0;
  while (lines.next()) {
    splitAtBlanks(lines.line(), words);
    const std::string_view word = words.empty() ? "" : words.front().text;
    if (equalsIgnoringCase(word, "vertex")) {
      if (++corners > 3) {
        mesh.fail("a facet has more than three corners", lines.number());
      }
      welder.addCorner(readCorner(words, mesh, lines.number()), lines.number());
    } else if (equalsIgnoringCase(word, "endfacet")) {
      if (corners != 3) {
        mesh.fail("a facet has " + std::to_string(corners) + " corners, not three", lines.number());
      }
      corners = 0;
    }
  }
  if (corners != 0) {
    mesh.fail("the file ends within a facet", lines.number());
  }
}

}  // namespace

void readStl(std::string_view bytes, MeshBuilder& mesh) {
  // Binary files may begin with "solid", too: their size tells.
  const bool binary = bytes.size() >= kHeader &&
                      bytes.size() == kHeader + kFacet * std::size_t{readWord(bytes, kHeader - 4)};
  if (binary) {
    readBinary(bytes, mesh);
  } else if (bytes.substr(0, 5) == "solid") {
    readText(bytes, mesh);
  } else {
    mesh.fail("neither a text that begins with 'solid' nor as many bytes as the binary header says",
              1);
  }
}

}  // namespace gaitmill
