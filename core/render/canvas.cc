#include "core/render/canvas.h"

#include <algorithm>
#include <cmath>

namespace gaitmill {

namespace {

// Pixels whose centres lie within `margin` of a box, cut to the image.
struct PixelBox {
  int left, top, right, bottom;  // right and bottom exclusive
};

PixelBox findPixels(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const Image& image) {
  const auto pixel = [](double x, int limit) {
    return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(limit)));
  };
  return {pixel(std::floor(low.x()), image.width),
          pixel(std::floor(low.y()), image.height),
          pixel(std::ceil(high.x()) + 1, image.width),
          pixel(std::ceil(high.y()) + 1, image.height)};
}

double calcDistance(const Eigen::Vector2f& p, const Eigen::Vector2f& a, const Eigen::Vector2f& b) {
  const Eigen::Vector2f ab = b - a;
  const float length = ab.squaredNorm();
  const float t = length > 0 ? std::clamp((p - a).dot(ab) / length, 0.0F, 1.0F) : 0.0F;
  return static_cast<double>((p - a - t * ab).norm());
}

// How much of the pixel [i, i+1] lies in [low, high].
double calcOverlap(int i, double low, double high) {
  return std::clamp(std::min(high, i + 1.0) - std::max(low, static_cast<double>(i)), 0.0, 1.0);
}

// Twice the signed area of a triangle over the length of its side ab: distance of c from the side.
double calcSide(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d ab = b - a, ac = c - a;
  return (ab.x() * ac.y() - ab.y() * ac.x()) / ab.norm();
}

}  // namespace

void Canvas::blend(int x, int y, const Ink& ink, double coverage) {
  const double share = ink.opacity * std::clamp(coverage, 0.0, 1.0);
  if (share <= 0) return;
  std::uint8_t* pixel = image_.bytes.data() + image_.at(x, y);
  for (std::size_t c = 0; c < 3; ++c) {
    pixel[c] =
        static_cast<std::uint8_t>(std::lround((1 - share) * pixel[c] + share * ink.color[c]));
  }
}

void Canvas::fillRectangle(double left, double top, double right, double bottom, const Ink& ink) {
  const PixelBox box = findPixels({left, top}, {right, bottom}, image_);
  for (int y = box.top; y < box.bottom; ++y) {
    for (int x = box.left; x < box.right; ++x) {
      blend(x, y, ink, calcOverlap(x, left, right) * calcOverlap(y, top, bottom));
    }
  }
}

void Canvas::fillDisc(const Eigen::Vector2d& center, double radius, const Ink& ink) {
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(radius + 1);
  const PixelBox box = findPixels(center - reach, center + reach, image_);
  for (int y = box.top; y < box.bottom; ++y) {
    for (int x = box.left; x < box.right; ++x) {
      blend(x, y, ink, radius + 0.5 - (Eigen::Vector2d(x + 0.5, y + 0.5) - center).norm());
    }
  }
}

void Canvas::drawStrokes(const std::vector<Stroke>& strokes, double pen_width, const Ink& ink) {
  Eigen::Vector2f low = Eigen::Vector2f::Constant(1e9F), high = -low;
  for (const Stroke& stroke : strokes) {
    for (const Eigen::Vector2f& p : stroke) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(0.5 * pen_width + 1);
  const PixelBox box = findPixels(low.cast<double>() - reach, high.cast<double>() + reach, image_);
  for (int y = box.top; y < box.bottom; ++y) {
    for (int x = box.left; x < box.right; ++x) {
      const Eigen::Vector2f p(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      double distance = 1e9;
      for (const Stroke& stroke : strokes) {
        for (std::size_t i = 1; i < stroke.size(); ++i) {
          distance = std::min(distance, calcDistance(p, stroke[i - 1], stroke[i]));
        }
      }
      blend(x, y, ink, 0.5 * pen_width + 0.5 - distance);
    }
  }
}

void Canvas::fillTriangle(const Eigen::Vector2d& a,
                          const Eigen::Vector2d& b,
                          const Eigen::Vector2d& c,
                          const Ink& ink) {
  const PixelBox box = findPixels(
      a.cwiseMin(b).cwiseMin(c).array() - 1, a.cwiseMax(b).cwiseMax(c).array() + 1, image_);
  const double turn = calcSide(a, b, c) < 0 ? -1 : 1;
  for (int y = box.top; y < box.bottom; ++y) {
    for (int x = box.left; x < box.right; ++x) {
      const Eigen::Vector2d p(x + 0.5, y + 0.5);
      const double inside =
          std::min({turn * calcSide(a, b, p), turn * calcSide(b, c, p), turn * calcSide(c, a, p)});
      blend(x, y, ink, inside + 0.5);
    }
  }
}

void Canvas::drawText(std::string_view text,
                      const Eigen::Vector2d& baseline,
                      double cap_height,
                      TextAnchor anchor,
                      const Ink& ink) {
  const double share = anchor == TextAnchor::kLeft ? 0 : anchor == TextAnchor::kMiddle ? 0.5 : 1;
  const double scale = cap_height / static_cast<double>(kCapHeight);
  double x = baseline.x() - share * gaitmill::measureText(text, cap_height);
  std::vector<Stroke> strokes;
  for (const char character : text) {
    const Glyph& glyph = getGlyph(character);
    strokes = glyph.strokes;
    for (Stroke& stroke : strokes) {
      for (Eigen::Vector2f& p : stroke) {
        p = Eigen::Vector2f(static_cast<float>(x + scale * static_cast<double>(p.x())),
                            static_cast<float>(baseline.y() - scale * static_cast<double>(p.y())));
      }
    }
    if (!strokes.empty()) {
      drawStrokes(strokes, std::max(1.1, scale * static_cast<double>(kPenWidth)), ink);
    }
    x += scale * static_cast<double>(glyph.advance);
  }
}

double measureText(std::string_view text, double cap_height) {
  return static_cast<double>(measureText(text)) * cap_height / static_cast<double>(kCapHeight);
}

}  // namespace gaitmill
