#include "core/pipeline/archive.h"

#include <algorithm>
#include <limits>

#include "core/base/error.h"

namespace gaitmill {

namespace {

[[noreturn]] void refuse(const char* message) {
  throw Error(ErrorCode::kCheckpointUnusable, message);
}

constexpr std::array<std::uint64_t, 256> makeChecksumTable() {
  constexpr std::uint64_t kPolynomial = 0xC96C5795D7870F42;  // ECMA-182, reflected
  std::array<std::uint64_t, 256> table{};
  for (std::uint64_t byte = 0; byte < table.size(); ++byte) {
    std::uint64_t sum = byte;
    for (int bit = 0; bit < 8; ++bit) {
      sum = (sum & 1) != 0 ? (sum >> 1) ^ kPolynomial : sum >> 1;
    }
    table[byte] = sum;
  }
  return table;
}

}  // namespace

std::uint64_t calcChecksum(std::string_view bytes, std::uint64_t before) {
  static constexpr std::array<std::uint64_t, 256> kTable = makeChecksumTable();
  std::uint64_t sum = ~before;
  for (const char byte : bytes) {
    sum = kTable[(sum ^ static_cast<unsigned char>(byte)) & 0xFF] ^ (sum >> 8);
  }
  return ~sum;
}

void ArchiveWriter::writeBits(std::uint64_t bits, int byte_count) {
  for (int i = 0; i < byte_count; ++i) {
    bytes_.push_back(static_cast<char>(bits >> (8 * i) & 0xFF));
  }
}

void ArchiveWriter::write(const double& value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  writeBits(bits, 8);
}

void ArchiveWriter::write(const std::string& value) {
  writeBits(value.size(), 8);
  bytes_ += value;
}

void ArchiveWriter::write(const RowMatrix& value) {
  writeBits(static_cast<std::uint64_t>(value.rows()), 8);
  writeBits(static_cast<std::uint64_t>(value.cols()), 8);
  for (Eigen::Index i = 0; i < value.size(); ++i) {
    write(value.data()[i]);
  }
}

std::uint64_t ArchiveReader::readBits(int byte_count) {
  const auto count = static_cast<std::size_t>(byte_count);
  if (bytes_.size() < count) {
    refuse("the bytes of a checkpoint end too early");
  }
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < count; ++i) {
    bits |= std::uint64_t{static_cast<unsigned char>(bytes_[i])} << (8 * i);
  }
  bytes_.remove_prefix(count);
  return bits;
}

std::size_t ArchiveReader::readCount(std::size_t least_bytes) {
  const std::uint64_t count = readBits(8);
  if (count > bytes_.size() / least_bytes) {
    refuse("a checkpoint announces more values than it has bytes");
  }
  return static_cast<std::size_t>(count);
}

void ArchiveReader::read(double& value) {
  const std::uint64_t bits = readBits(8);
  std::memcpy(&value, &bits, sizeof value);
}

void ArchiveReader::read(std::string& value) {
  const std::size_t size = readCount(1);
  value.assign(bytes_.substr(0, size));
  bytes_.remove_prefix(size);
}

void ArchiveReader::read(RowMatrix& value) {
  constexpr std::uint64_t kMost = std::numeric_limits<int>::max();
  const std::uint64_t rows = readBits(8);
  const std::uint64_t columns = readBits(8);
  if (rows > kMost || columns > kMost || rows * columns > bytes_.size() / sizeof(double)) {
    refuse("a checkpoint announces a table that is larger than its bytes");
  }
  value.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  for (Eigen::Index i = 0; i < value.size(); ++i) {
    read(value.data()[i]);
  }
}

void ArchiveReader::finish() const {
  if (!bytes_.empty()) {
    refuse("a checkpoint has bytes behind its end");
  }
}

}  // namespace gaitmill
