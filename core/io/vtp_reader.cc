// VTK XML PolyData, with data as text or as uncompressed base64 within the elements.

#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <pugixml.hpp>
#include <vector>

#include "core/io/file_content.h"
#include "core/io/mesh_builder.h"
#include "core/io/number_text.h"

namespace gaitmill {

namespace {

constexpr std::size_t kMaximumNumbers = 8000000;  // of one data array

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// Bytes of base64 text; nothing if it is not such text.
std::optional<std::string> decodeBase64(std::string_view text) {
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t digit = kDigits.find(c);
    if (digit == kDigits.npos) {
      if (isBlank(c) || c == '=') {
        continue;
      }
      return std::nullopt;
    }
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    if (++count == 4) {
      bytes +=
          {static_cast<char>(bits >> 16), static_cast<char>(bits >> 8), static_cast<char>(bits)};
      bits = 0;
      count = 0;
    }
  }
  if (count == 2) {
    bytes += static_cast<char>(bits >> 4);
  } else if (count == 3) {
    bytes += {static_cast<char>(bits >> 10), static_cast<char>(bits >> 2)};
  }
  return bytes;
}

/// A number type of a data array.
struct Scalar {
  std::string_view name;
  std::size_t size;
  enum class Kind { kFloat, kSigned, kUnsigned } kind;
};
constexpr std::array<Scalar, 10> kScalars = {{
    {"Float32", 4, Scalar::Kind::kFloat},
    {"Float64", 8, Scalar::Kind::kFloat},
    {"Int8", 1, Scalar::Kind::kSigned},
    {"Int16", 2, Scalar::Kind::kSigned},
    {"Int32", 4, Scalar::Kind::kSigned},
    {"Int64", 8, Scalar::Kind::kSigned},
    {"UInt8", 1, Scalar::Kind::kUnsigned},
    {"UInt16", 2, Scalar::Kind::kUnsigned},
    {"UInt32", 4, Scalar::Kind::kUnsigned},
    {"UInt64", 8, Scalar::Kind::kUnsigned},
}};

std::uint64_t readWord(std::string_view bytes, bool big_endian) {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::size_t at = big_endian ? i : bytes.size() - 1 - i;
    word = word << 8 | static_cast<unsigned char>(bytes[at]);
  }
  return word;
}

double toNumber(std::uint64_t word, const Scalar& type) {
  if (type.kind == Scalar::Kind::kFloat && type.size == 4) {
    const auto half = static_cast<std::uint32_t>(word);
    float value = 0;
    std::memcpy(&value, &half, sizeof value);
    return static_cast<double>(value);
  }
  if (type.kind == Scalar::Kind::kFloat) {
    double value = 0;
    std::memcpy(&value, &word, sizeof value);
    return value;
  }
  const std::uint64_t sign = std::uint64_t{1} << (8 * type.size - 1);
  if (type.kind == Scalar::Kind::kSigned && (word & sign) != 0) {
    return -static_cast<double>(((~word) & (sign - 1)) + 1);
  }
  return static_cast<double>(word);
}

class VtpReader {
 public:
  VtpReader(std::string_view bytes, const std::string& file_name, MeshBuilder& mesh)
      : bytes_(bytes), file_name_(file_name), mesh_(mesh) {}

  void read() {
    const pugi::xml_parse_result result = xml_.load_buffer(bytes_.data(), bytes_.size());
    if (!result) {
      fail(result.offset, std::string("the XML cannot be read: ") + result.description());
    }
    const pugi::xml_node root = xml_.child("VTKFile");
    const pugi::xml_node data = root.child("PolyData");
    if (!data) {
      fail(0, "there is no <PolyData> in a <VTKFile>");
    }
    big_endian_ = std::string_view(root.attribute("byte_order").as_string()) == "BigEndian";
    wide_header_ = std::string_view(root.attribute("header_type").as_string()) == "UInt64";
    compressed_ = root.attribute("compressor");
    for (const pugi::xml_node& piece : data.children("Piece")) {
      readPiece(piece);
    }
  }

 private:
  [[noreturn]] void fail(std::ptrdiff_t offset, const std::string& message) const {
    const Where place = offset < 0
                            ? Where{file_name_, 0, 0, {}}
                            : findWhere(bytes_, static_cast<std::size_t>(offset), file_name_);
    throw Error(ErrorCode::kMeshFormat, message, place);
  }
  // Elements are asked for in the order of the file: one walk through it serves them all.
  int lineOf(const pugi::xml_node& node) {
    const auto offset = static_cast<std::size_t>(node.offset_debug());
    for (; walked_ < offset; ++walked_) {
      line_ += bytes_[walked_] == '\n' ? 1 : 0;
    }
    return line_;
  }

  void readPiece(const pugi::xml_node& piece) {
    const std::size_t first = mesh_.vertexCount();
    const pugi::xml_node points = piece.child("Points").child("DataArray");
    if (!points) {
      return;  // a piece without points has no polygons
    }
    const std::vector<double> numbers = readNumbers(points);
    if (numbers.size() % 3 != 0 || points.attribute("NumberOfComponents").as_int(3) != 3) {
      fail(points.offset_debug(),
           "the points are " + std::to_string(numbers.size()) + " numbers, not three for each");
    }
    const int line = lineOf(points);
    for (std::size_t i = 0; i < numbers.size(); i += 3) {
      mesh_.addVertex(numbers[i], numbers[i + 1], numbers[i + 2], line);
    }
    readNormals(piece.child("PointData"), numbers.size());
    readCells(piece.child("Polys"), first, false);
    readCells(piece.child("Strips"), first, true);
  }

  void readNormals(const pugi::xml_node& data, std::size_t size) {
    const pugi::xml_attribute wanted = data.attribute("Normals");
    const pugi::xml_node array =
        wanted ? data.find_child_by_attribute("DataArray", "Name", wanted.as_string())
               : pugi::xml_node();
    if (!array) {
      return;
    }
    const std::vector<double> numbers = readNumbers(array);
    if (numbers.size() != size) {
      fail(array.offset_debug(),
           std::to_string(numbers.size()) + " numbers of normals for " + std::to_string(size) +
               " of points");
    }
    for (std::size_t i = 0; i < size; i += 3) {
      mesh_.addNormal(Eigen::Vector3d(numbers[i], numbers[i + 1], numbers[i + 2]).cast<float>());
    }
  }

  void readCells(const pugi::xml_node& cells, std::size_t first, bool strips) {
    const pugi::xml_node corner_array =
        cells.find_child_by_attribute("DataArray", "Name", "connectivity");
    const pugi::xml_node end_array = cells.find_child_by_attribute("DataArray", "Name", "offsets");
    if (!corner_array || !end_array) {
      return;
    }
    const std::vector<double> corners = readNumbers(corner_array);
    const std::vector<double> ends = readNumbers(end_array);
    const int line = lineOf(corner_array);
    std::size_t begin = 0;
    for (const double end : ends) {
      if (!(end >= static_cast<double>(begin)) || end > static_cast<double>(corners.size())) {
        fail(end_array.offset_debug(),
             "the offsets do not rise from 0 to " + std::to_string(corners.size()) +
                 ", the number of corners");
      }
      const auto stop = static_cast<std::size_t>(end);
      std::vector<std::uint32_t> cell;
      for (std::size_t i = begin; i < stop; ++i) {
        cell.push_back(toVertex(corners[i], first, corner_array));
      }
      addCell(cell, strips, line);
      begin = stop;
    }
  }

  std::uint32_t toVertex(double corner, std::size_t first, const pugi::xml_node& array) const {
    const auto count = static_cast<double>(mesh_.vertexCount() - first);
    if (!(corner >= 0) || corner >= count) {
      fail(array.offset_debug(),
           "a polygon names vertex " + formatNumber(corner) + "; there are " + formatNumber(count));
    }
    return static_cast<std::uint32_t>(first + static_cast<std::size_t>(corner));
  }

  void addCell(const std::vector<std::uint32_t>& cell, bool strip, int line) {
    if (!strip) {
      mesh_.addPolygon(cell, line);
      return;
    }
    for (std::size_t i = 0; i + 2 < cell.size(); ++i) {
      const std::size_t odd = i % 2;  // every other triangle of a strip is turned
      mesh_.addTriangle(cell[i], cell[i + 1 + odd], cell[i + 2 - odd], line);
    }
  }

  std::vector<double> readNumbers(const pugi::xml_node& array) const {
    const std::string_view format = array.attribute("format").as_string("ascii");
    if (format == "ascii") {
      return readText(array);
    }
    if (format != "binary") {
      fail(array.offset_debug(),
           "data of format '" + std::string(format) + "'; 'ascii' and inline 'binary' can be read");
    }
    if (compressed_) {
      fail(array.offset_debug(), "compressed data cannot be read");
    }
    return readBinary(array);
  }

  std::vector<double> readText(const pugi::xml_node& array) const {
    const std::string_view text = array.text().get();
    std::vector<double> numbers;
    std::size_t at = 0;
    while (true) {
      while (at < text.size() && isBlank(text[at])) {
        ++at;
      }
      std::size_t end = at;
      while (end < text.size() && !isBlank(text[end])) {
        ++end;
      }
      if (end == at) {
        return numbers;
      }
      const std::optional<double> number = parseNumber(text.substr(at, end - at));
      if (!number) {
        fail(array.first_child().offset_debug() + static_cast<std::ptrdiff_t>(at),
             "'" + std::string(text.substr(at, std::min<std::size_t>(end - at, 20))) +
                 "' is not a number");
      }
      if (numbers.size() == kMaximumNumbers) {
        fail(array.offset_debug(), "more than " + std::to_string(kMaximumNumbers) + " numbers");
      }
      numbers.push_back(*number);
      at = end;
    }
  }

  // The number of bytes, then the bytes.
  std::vector<double> readBinary(const pugi::xml_node& array) const {
    const std::optional<std::string> bytes = decodeBase64(array.text().get());
    const std::size_t header = wide_header_ ? 8 : 4;
    const Scalar* type = findScalar(array.attribute("type").as_string());
    if (!bytes || type == nullptr || bytes->size() < header) {
      fail(array.offset_debug(), "the binary data cannot be decoded");
    }
    const std::string_view all = *bytes;
    const std::uint64_t size = readWord(all.substr(0, header), big_endian_);
    if (size > all.size() - header || size % type->size != 0) {
      fail(array.offset_debug(),
           "the binary data says it has " + std::to_string(size) + " bytes, but " +
               std::to_string(all.size() - header) + " follow");
    }
    std::vector<double> numbers;
    for (std::size_t at = header; at < header + size; at += type->size) {
      numbers.push_back(toNumber(readWord(all.substr(at, type->size), big_endian_), *type));
    }
    return numbers;
  }

  static const Scalar* findScalar(std::string_view name) {
    for (const Scalar& scalar : kScalars) {
      if (scalar.name == name) {
        return &scalar;
      }
    }
    return nullptr;
  }

  std::string_view bytes_;
  const std::string& file_name_;
  MeshBuilder& mesh_;
  pugi::xml_document xml_;
  bool big_endian_ = false;
  bool wide_header_ = false;
  bool compressed_ = false;
  std::size_t walked_ = 0;
  int line_ = 1;
};

}  // namespace

void readVtp(std::string_view bytes, const std::string& file_name, MeshBuilder& mesh) {
  VtpReader(bytes, file_name, mesh).read();
}

}  // namespace gaitmill
