#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include "core/data/time_series.h"

namespace gaitmill {

/// Values as bytes and back, bit for bit, the same bytes on every machine: numbers little-endian,
/// lengths as 64 bits in front of what they count. Structs are taken apart by functions
///   template <class Archive>
///   void visitFields(Archive& archive, Access<Archive, BodySpec>& value)
/// which serve both directions, so that neither can forget a field that the other knows.
template <class Archive, class Value>
using Access = std::conditional_t<Archive::kReads, Value, const Value>;

class ArchiveWriter {
 public:
  static constexpr bool kReads = false;

  template <class... Values>
  void operator()(const Values&... values) {
    (write(values), ...);
  }

  const std::string& bytes() const { return bytes_; }

 private:
  void writeBits(std::uint64_t bits, int byte_count);

  template <class Value>
  void write(const Value& value) {
    if constexpr (std::is_enum_v<Value> || std::is_integral_v<Value>) {
      writeBits(static_cast<std::uint64_t>(static_cast<std::int64_t>(value)), 8);
    } else {
      visitFields(*this, value);
    }
  }
  void write(const std::uint64_t& value) { writeBits(value, 8); }
  void write(const bool& value) { writeBits(value ? 1 : 0, 1); }
  void write(const double& value);
  void write(const std::string& value);
  void write(const Eigen::Vector3d& value) { (*this)(value.x(), value.y(), value.z()); }
  void write(const RowMatrix& value);
  template <class Value>
  void write(const std::optional<Value>& value) {
    write(value.has_value());
    if (value) {
      write(*value);
    }
  }
  template <class Value>
  void write(const std::vector<Value>& values) {
    writeBits(values.size(), 8);
    for (const Value& value : values) {
      write(value);
    }
  }
  template <class Value, std::size_t kCount>
  void write(const std::array<Value, kCount>& values) {
    for (const Value& value : values) {
      write(value);
    }
  }

  std::string bytes_;
};

/// Reads what ArchiveWriter wrote. Never allocates more than the bytes that are left can fill,
/// whatever a length claims. @throws Error kCheckpointUnusable where the bytes do not fit
class ArchiveReader {
 public:
  static constexpr bool kReads = true;

  /// Keeps a reference to the bytes.
  explicit ArchiveReader(std::string_view bytes) : bytes_(bytes) {}

  template <class... Values>
  void operator()(Values&... values) {
    (read(values), ...);
  }

  /// @throws Error kCheckpointUnusable if bytes are left over
  void finish() const;

 private:
  std::uint64_t readBits(int byte_count);
  /// A count of things that take at least `least_bytes` each.
  std::size_t readCount(std::size_t least_bytes);

  template <class Value>
  void read(Value& value) {
    if constexpr (std::is_enum_v<Value> || std::is_integral_v<Value>) {
      value = static_cast<Value>(static_cast<std::int64_t>(readBits(8)));
    } else {
      visitFields(*this, value);
    }
  }
  void read(std::uint64_t& value) { value = readBits(8); }
  void read(bool& value) { value = readBits(1) != 0; }
  void read(double& value);
  void read(std::string& value);
  void read(Eigen::Vector3d& value) { (*this)(value.x(), value.y(), value.z()); }
  void read(RowMatrix& value);
  template <class Value>
  void read(std::optional<Value>& value) {
    bool present = false;
    read(present);
    value.reset();
    if (present) {
      read(value.emplace());
    }
  }
  template <class Value>
  void read(std::vector<Value>& values) {
    values.clear();
    // One by one: a false count then runs out of bytes instead of memory.
    for (std::size_t left = readCount(1); left > 0; --left) {
      read(values.emplace_back());
    }
  }
  template <class Value, std::size_t kCount>
  void read(std::array<Value, kCount>& values) {
    for (Value& value : values) {
      read(value);
    }
  }

  std::string_view bytes_;
};

/// CRC-64 (ECMA-182, reflected) of bytes, going on from the sum of what came before.
std::uint64_t calcChecksum(std::string_view bytes, std::uint64_t before = 0);

}  // namespace gaitmill
