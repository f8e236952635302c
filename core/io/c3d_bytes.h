#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace gaitmill {

// Numbers in the bytes of a C3D file. Internal to core/io.

/// How the machine that wrote a C3D file stored numbers; the value is the processor byte of the
/// parameter section.
enum class C3dProcessor : unsigned char {
  kIntel = 84,  ///< little endian, IEEE
  kDec = 85,    ///< little endian integers, VAX F floats
  kMips = 86,   ///< big endian, IEEE
};

inline constexpr std::size_t kC3dBlock = 512;  ///< [bytes]

namespace c3d {

inline std::uint16_t joinBytes(char low, char high) {
  return static_cast<std::uint16_t>(static_cast<unsigned char>(low) |
                                    static_cast<unsigned char>(high) << 8);
}

template <C3dProcessor kProcessor>
std::uint16_t readWord(const char* at) {
  return kProcessor == C3dProcessor::kMips ? joinBytes(at[1], at[0]) : joinBytes(at[0], at[1]);
}

template <C3dProcessor kProcessor>
float readReal(const char* at) {
  const std::uint32_t first = readWord<kProcessor>(at);
  const std::uint32_t second = readWord<kProcessor>(at + 2);
  // The half with the exponent comes first in big endian and in VAX order.
  const std::uint32_t bits =
      kProcessor == C3dProcessor::kIntel ? second << 16 | first : first << 16 | second;
  float value;
  std::memcpy(&value, &bits, sizeof value);
  // The VAX counts its exponent from 128 and its mantissa from 1/2: a factor of four. Its zero is
  // every pattern of exponent 0.
  if (kProcessor == C3dProcessor::kDec) {
    return (bits & 0x7F800000U) == 0 ? 0.0F : value / 4.0F;
  }
  return value;
}

}  // namespace c3d

/// A file with its processor; reading beyond the end gives 0.
class C3dBytes {
 public:
  C3dBytes(std::string_view bytes, C3dProcessor processor) : bytes_(bytes), processor_(processor) {}

  std::string_view all() const { return bytes_; }
  C3dProcessor processor() const { return processor_; }
  std::uint16_t word(std::size_t offset) const;
  float real(std::size_t offset) const;

 private:
  std::string_view bytes_;
  C3dProcessor processor_;
};

}  // namespace gaitmill
