#pragma once

#include <png.h>

#include <cmath>
#include <string>

#include "core/base/error.h"
#include "core/render/color_scale.h"
#include "core/render/image.h"

namespace gaitmill {

/// Pixels of a PNG file, by libpng's simplified reader.
inline Image decodePng(const std::string& bytes) {
  png_image reader{};
  reader.version = PNG_IMAGE_VERSION;
  check(png_image_begin_read_from_memory(&reader, bytes.data(), bytes.size()) != 0, "not a PNG");
  reader.format = PNG_FORMAT_RGB;
  Image image(static_cast<int>(reader.width), static_cast<int>(reader.height));
  check(png_image_finish_read(&reader, nullptr, image.bytes.data(), 0, nullptr) != 0, "broken PNG");
  return image;
}

inline Rgb pixelOf(const Image& image, int x, int y) {
  const std::size_t i = image.at(x, y);
  return {image.bytes[i], image.bytes[i + 1], image.bytes[i + 2]};
}

/// How different two pictures look.
struct Difference {
  double mean = 0;   ///< CIELAB distance over all pixels
  double share = 0;  ///< of pixels that differ by more than 12: a muscle in the wrong place
};

inline Difference compareImages(const Image& a, const Image& b) {
  check(a.width == b.width && a.height == b.height, "images of different sizes");
  Difference difference;
  const double count = a.width * a.height;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const auto p = toLab(pixelOf(a, x, y)), q = toLab(pixelOf(b, x, y));
      const double distance = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      difference.mean += distance / count;
      if (distance > 12) difference.share += 1 / count;
    }
  }
  return difference;
}

}  // namespace gaitmill
