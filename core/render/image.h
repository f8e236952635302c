#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gaitmill {

/// A colour as screens show it (sRGB), each part 0..255.
using Rgb = std::array<std::uint8_t, 3>;

/// Pixels row by row from the top, three bytes each (sRGB).
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> bytes;  ///< (height x width x 3)

  Image() = default;
  Image(int w, int h)
      : width(w), height(h), bytes(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * 3) {}
  /// Offset of a pixel in `bytes`. Requires it to be inside.
  std::size_t at(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
            static_cast<std::size_t>(x)) *
           3;
  }
};

}  // namespace gaitmill
