#include "core/render/legend.h"

#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/render/canvas.h"
#include "core/render/scene.h"

namespace gaitmill {

namespace {

constexpr Ink kText{{38, 46, 58}, 1};
constexpr Ink kSoftText{{84, 94, 108}, 1};

// Lengths in cap heights.
constexpr double kLine = 2.1;
constexpr double kGap = 1.6;      // between blocks that stand on each other
constexpr double kSideGap = 4.5;  // between blocks side by side
constexpr double kBarWidth = 15;
constexpr double kBarHeight = 1.1;
constexpr double kArrowRoom = 9;
constexpr double kDotRadius = 0.55;

constexpr double kBodyShare = 0.3;  // of the picture, each way; a legend that leaves less goes

// One part of a legend: its size in cap heights, and how it is drawn at its upper left corner.
struct Block {
  enum class Kind { kInstant, kScale, kForces, kMarkers };
  Kind kind = Kind::kInstant;
  double width = 0;
  double height = 0;
};

double widest(const std::vector<std::string>& lines) {
  double width = 0;
  for (const std::string& line : lines) width = std::max(width, measureText(line, 1));
  return width;
}

std::vector<std::string> listMarkers(const LegendContent& content) {
  std::vector<std::string> lines;
  if (content.measured_markers) lines.push_back("Measured marker");
  if (content.model_markers) lines.push_back("Model marker");
  return lines;
}

std::vector<Block> makeBlocks(const LegendContent& content) {
  std::vector<Block> blocks;
  if (!content.instant.empty()) {
    const auto lines = static_cast<double>(content.instant.size());
    blocks.push_back({Block::Kind::kInstant, widest(content.instant), lines * kLine});
  }
  if (content.scale != nullptr) {
    const double width = std::max(kBarWidth, measureText(content.scale->title, 1));
    blocks.push_back({Block::Kind::kScale, width, 2 * kLine + kBarHeight + 0.4});
  }
  if (content.forces) {
    const double sample = kArrowRoom + 1 + measureText("1000 N", 1);
    const double width = std::max(sample, measureText("Ground reaction", 1));
    blocks.push_back({Block::Kind::kForces, width, 2 * kLine});
  }
  const std::vector<std::string> markers = listMarkers(content);
  if (!markers.empty()) {
    const auto lines = static_cast<double>(markers.size());
    blocks.push_back({Block::Kind::kMarkers, widest(markers) + 4 * kDotRadius, lines * kLine});
  }
  return blocks;
}

std::string formatTick(double value) {
  return formatFixed(value, value == std::round(value) ? 0 : 1);
}

// Draws blocks; positions in pixels.
class LegendPainter {
 public:
  LegendPainter(const LegendContent& content, double cap, double pixels_per_newton, Image& image)
      : content_(content), cap_(cap), pixels_per_newton_(pixels_per_newton), canvas_(image) {}

  void draw(const Block& block, double left, double top) {
    switch (block.kind) {
      case Block::Kind::kInstant:
        return drawInstant(left, top);
      case Block::Kind::kScale:
        return drawScale(left, top);
      case Block::Kind::kForces:
        return drawForces(left, top);
      case Block::Kind::kMarkers:
        return drawMarkers(left, top);
    }
  }

 private:
  void drawLine(const std::string& text, double left, double top, int line, const Ink& ink) {
    canvas_.drawText(text, {left, top + (line * kLine + 1.2) * cap_}, cap_, TextAnchor::kLeft, ink);
  }

  void drawInstant(double left, double top) {
    int line = 0;
    for (const std::string& text : content_.instant) {
      drawLine(text, left, top, line, line == 0 ? kText : kSoftText);
      ++line;
    }
  }

  void drawScale(double left, double top) {
    const ColorScale& scale = *content_.scale;
    drawLine(scale.title, left, top, 0, kText);
    const double bar_top = top + (kLine - 0.1) * cap_;
    const double width = std::round(kBarWidth * cap_);
    const double x0 = std::round(left);
    for (int x = 0; x < static_cast<int>(width); ++x) {
      const double value = scale.lowest + (x + 0.5) / width * (scale.highest - scale.lowest);
      canvas_.fillRectangle(
          x0 + x, bar_top, x0 + x + 1, bar_top + kBarHeight * cap_, {scale.findColor(value), 1});
    }
    for (const double tick : scale.ticks) {
      const double share = (tick - scale.lowest) / (scale.highest - scale.lowest);
      const TextAnchor anchor = share < 0.01   ? TextAnchor::kLeft
                                : share > 0.99 ? TextAnchor::kRight
                                               : TextAnchor::kMiddle;
      const std::string end = share < 0.01 ? scale.below : share > 0.99 ? scale.above : "";
      canvas_.drawText(formatTick(tick) + end,
                       {x0 + share * width, bar_top + (kBarHeight + 1.6) * cap_},
                       cap_,
                       anchor,
                       kSoftText);
    }
  }

  // A sample of the arrows: the largest round force whose arrow has room.
  void drawForces(double left, double top) {
    drawLine("Ground reaction", left, top, 0, kText);
    double force = 1000;
    for (const double next : {500.0, 200.0, 100.0, 50.0, 20.0, 10.0}) {
      if (force * pixels_per_newton_ > kArrowRoom * cap_) force = next;
    }
    const double length = force * pixels_per_newton_;
    const double y = top + (kLine + 0.75) * cap_;
    const double head = std::min(1.1 * cap_, 0.6 * length);
    const Ink ink{kForceColor, 1};
    canvas_.fillRectangle(left, y - 0.16 * cap_, left + length - head, y + 0.16 * cap_, ink);
    canvas_.fillTriangle({left + length, y},
                         {left + length - head, y - 0.45 * cap_},
                         {left + length - head, y + 0.45 * cap_},
                         ink);
    drawLine(formatFixed(force, 0) + " N", left + length + cap_, top, 1, kSoftText);
  }

  void drawMarkers(double left, double top) {
    int line = 0;
    for (const std::string& text : listMarkers(content_)) {
      const Rgb color = text[1] == 'e' ? kMeasuredMarkerColor : kModelMarkerColor;
      const double y = top + (line * kLine + 0.7) * cap_;
      canvas_.fillDisc({left + kDotRadius * cap_, y}, kDotRadius * cap_, {color, 1});
      drawLine(text, left + 4 * kDotRadius * cap_, top, line, kSoftText);
      ++line;
    }
  }

  const LegendContent& content_;
  double cap_;
  double pixels_per_newton_;
  Canvas canvas_;
};

// Where blocks stand when they flow from left to right in a room `width` wide, in cap heights.
struct Flow {
  std::vector<Eigen::Vector2d> places;
  double height = 0;
};

Flow flowBlocks(const std::vector<Block>& blocks, double width) {
  Flow flow;
  double x = 0, top = 0, bottom = 0;
  for (const Block& block : blocks) {
    if (x > 0 && x + block.width > width) {
      x = 0;
      top = bottom + 0.5 * kGap;
    }
    flow.places.push_back({x, top});
    x += block.width + kSideGap;
    bottom = std::max(bottom, top + block.height);
  }
  flow.height = bottom;
  return flow;
}

}  // namespace

Layout makeLayout(int width, int height, const LegendContent& content, bool strip) {
  const std::vector<Block> blocks = makeBlocks(content);
  Layout layout;
  layout.beside = !strip && width >= 1.2 * height;
  layout.cap_height = std::clamp(0.0168 * std::min(height, width), 6.6, 40.0);
  const double cap = layout.cap_height;
  const double margin = std::max(3.0, 0.03 * std::min(width, height));
  layout.body = {margin, margin, width - margin, height - margin};
  layout.legend = layout.body;
  if (blocks.empty()) return layout;
  if (layout.beside) {
    double column = 0;
    for (const Block& block : blocks) column = std::max(column, block.width * cap);
    layout.legend.right = margin + column;
    layout.body.left = margin + column + cap;
    // The body stands in the middle of the picture if that leaves it room enough.
    const double centered = width - 2 * layout.body.left;
    if (centered > 0.75 * height) layout.body.right = width - layout.body.left;
  } else {
    const double room = layout.legend.right - layout.legend.left;
    layout.legend.top = layout.legend.bottom - flowBlocks(blocks, room / cap).height * cap;
    layout.body.bottom = layout.legend.top - 1.5 * cap;
  }
  const double width_left = layout.body.right - layout.body.left;
  const double height_left = layout.body.bottom - layout.body.top;
  if (width_left < kBodyShare * width || height_left < kBodyShare * height) {
    layout.legend = {};
    layout.body = {margin, margin, width - margin, height - margin};
  }
  return layout;
}

void drawLegend(const LegendContent& content,
                const Layout& layout,
                double pixels_per_newton,
                Image& image) {
  const std::vector<Block> blocks = makeBlocks(content);
  const double cap = layout.cap_height;
  const Frame& frame = layout.legend;
  if (frame.right <= frame.left) return;
  LegendPainter painter(content, cap, pixels_per_newton, image);
  if (!layout.beside) {
    const Flow flow = flowBlocks(blocks, (frame.right - frame.left) / cap);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      painter.draw(
          blocks[b], frame.left + flow.places[b].x() * cap, frame.top + flow.places[b].y() * cap);
    }
    return;
  }
  // The instant at the top, the rest standing on the bottom.
  double bottom = frame.bottom;
  for (std::size_t b = blocks.size(); b-- > 0;) {
    if (blocks[b].kind == Block::Kind::kInstant) {
      painter.draw(blocks[b], frame.left, frame.top);
    } else {
      painter.draw(blocks[b], frame.left, bottom - blocks[b].height * cap);
      bottom -= (blocks[b].height + kGap) * cap;
    }
  }
}

void drawLabel(const std::string& text,
               const Eigen::Vector2d& middle,
               double cap_height,
               Image& image) {
  Canvas(image).drawText(text, middle, cap_height, TextAnchor::kMiddle, kText);
}

}  // namespace gaitmill
