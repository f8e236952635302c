#include "core/render/font.h"

#include <algorithm>
#include <array>
#include <locale>
#include <sstream>
#include <string>

namespace gaitmill {

namespace {

constexpr float kSpacing = 2.1F;  // between the boxes of two glyphs
constexpr int kChordsPerPiece = 5;

// One glyph: its box's width and its strokes. L = straight pieces, S = a smooth curve through the
// points, O = a smooth closed curve; then x y pairs.
struct GlyphSource {
  char character;
  float width;
  const char* strokes;
};

constexpr GlyphSource kGlyphs[] = {
    {' ', 2.4F, ""},
    {'A', 7.6F, "L 0 0 3.8 10 7.6 0 L 1.35 3.4 6.25 3.4"},
    {'B',
     6.4F,
     "L 0 0 0 10 3.4 10 S 3.4 10 5.3 9.3 5.9 7.7 5.2 6 3.4 5.3 L 3.4 5.3 0 5.3 S 3.4 5.3 "
     "5.6 4.6 6.4 2.7 5.6 0.8 3.4 0 L 3.4 0 0 0"},
    {'C', 7.2F, "S 7.2 8.2 5.9 9.6 4 10.1 1.6 9.1 0.1 6.9 0.1 3.1 1.6 0.9 4 -0.1 5.9 0.4 7.2 1.8"},
    {'D', 7.2F, "L 0 0 0 10 3 10 S 3 10 5.6 9.2 7 6.9 7 3.1 5.6 0.8 3 0 L 3 0 0 0"},
    {'E', 5.6F, "L 5.6 10 0 10 0 0 5.6 0 L 0 5.2 4.8 5.2"},
    {'F', 5.4F, "L 5.4 10 0 10 0 0 L 0 5.1 4.6 5.1"},
    {'G',
     7.6F,
     "S 7.2 8.3 5.9 9.6 4 10.1 1.6 9.1 0.1 6.9 0.1 3.1 1.6 0.9 4 -0.1 6 0.3 7.4 1.5 L 7.4 1.5 7.4 "
     "4.6 4.4 4.6"},
    {'H', 7, "L 0 0 0 10 L 7 0 7 10 L 0 5.2 7 5.2"},
    {'I', 0, "L 0 0 0 10"},
    {'J', 4.6F, "L 4.6 10 4.6 3 S 4.6 3 4.1 0.8 2.2 -0.1 0.6 0.6 0 2.2"},
    {'K', 6.4F, "L 0 0 0 10 L 6 10 0 4 L 2.2 6.2 6.4 0"},
    {'L', 5, "L 0 10 0 0 5 0"},
    {'M', 8.6F, "L 0 0 0 10 4.3 2.6 8.6 10 8.6 0"},
    {'N', 7, "L 0 0 0 10 7 0 7 10"},
    {'O', 8, "O 4 10.1 6.6 9.1 8 6.5 8 3.5 6.6 0.9 4 -0.1 1.4 0.9 0 3.5 0 6.5 1.4 9.1"},
    {'P', 6.2F, "L 0 0 0 10 3.4 10 S 3.4 10 5.5 9.3 6.2 7.3 5.5 5.2 3.4 4.5 L 3.4 4.5 0 4.5"},
    {'Q',
     8,
     "O 4 10.1 6.6 9.1 8 6.5 8 3.5 6.6 0.9 4 -0.1 1.4 0.9 0 3.5 0 6.5 1.4 9.1 L 5 2.4 8 -1"},
    {'R',
     6.6F,
     "L 0 0 0 10 3.4 10 S 3.4 10 5.5 9.3 6.2 7.4 5.5 5.5 3.4 4.8 L 3.4 4.8 0 4.8 L 3.2 4.8 6.6 0"},
    {'S',
     6.2F,
     "S 5.9 8.4 4.9 9.7 3.1 10.1 1.1 9.5 0.3 7.7 1.1 6 3.1 5.2 5.2 4.4 6.2 2.6 5.3 0.6 3.1 -0.1 1 "
     "0.4 0 1.8"},
    {'T', 6.8F, "L 0 10 6.8 10 L 3.4 10 3.4 0"},
    {'U', 6.8F, "L 0 10 0 3.4 S 0 3.4 0.8 0.9 3.4 -0.1 6 0.9 6.8 3.4 L 6.8 3.4 6.8 10"},
    {'V', 7.4F, "L 0 10 3.7 0 7.4 10"},
    {'W', 10.4F, "L 0 10 2.6 0 5.2 9.4 7.8 0 10.4 10"},
    {'X', 6.8F, "L 0 0 6.8 10 L 0 10 6.8 0"},
    {'Y', 7, "L 0 10 3.5 4.7 7 10 L 3.5 4.7 3.5 0"},
    {'Z', 6.4F, "L 0 10 6.4 10 0 0 6.4 0"},
    {'a',
     5.2F,
     "S 0.5 5.7 1.3 6.8 2.7 7.1 4.5 6.5 5.2 4.8 L 5.2 4.8 5.2 0 S 5.2 3.9 2.6 3.9 0.7 3.2 0 1.8 "
     "0.6 0.4 2.2 -0.1 4.2 0.6 5.2 2.2"},
    {'b', 5.6F, "L 0 0 0 10.4 O 2.8 7.1 5 6 5.6 3.5 5 1 2.8 -0.1 0.6 1 0 3.5 0.6 6"},
    {'c', 5, "S 5 5.8 4.2 6.8 2.8 7.1 0.8 6.1 0 3.5 0.8 0.9 2.8 -0.1 4.2 0.2 5 1.2"},
    {'d', 5.6F, "L 5.6 0 5.6 10.4 O 2.8 7.1 5 6 5.6 3.5 5 1 2.8 -0.1 0.6 1 0 3.5 0.6 6"},
    {'e',
     5.5F,
     "L 0.05 3.6 5.5 3.6 S 5.5 3.6 4.8 6.1 2.8 7.1 0.7 6 0 3.5 0.7 1 2.9 -0.1 4.4 0.3 5.3 1.5"},
    {'f', 3.6F, "L 1.3 0 1.3 8.2 S 1.3 8.2 1.8 10 3.6 10.4 L 0 7 3.4 7"},
    {'g',
     5.6F,
     "O 2.8 7.1 5 6 5.6 3.5 5 1 2.8 -0.1 0.6 1 0 3.5 0.6 6 L 5.6 7 5.6 -0.2 S 5.6 -0.2 4.9 -2.3 "
     "2.8 -3.1 0.6 -2.3"},
    {'h', 5.2F, "L 0 0 0 10.4 S 0 4.2 0.8 6.3 2.8 7.1 4.6 6.3 5.2 4.2 L 5.2 4.2 5.2 0"},
    {'i', 0, "L 0 0 0 7 L 0 9.7 0 9.8"},
    {'j', 1.6F, "L 1.6 7 1.6 -1 S 1.6 -1 1.2 -2.7 -0.2 -3 L 1.6 9.7 1.6 9.8"},
    {'k', 4.9F, "L 0 0 0 10.4 L 4.5 7 0 2.7 L 1.7 4.3 4.9 0"},
    {'l', 0, "L 0 0 0 10.4"},
    {'m',
     8.8F,
     "L 0 0 0 7 S 0 4.4 0.7 6.4 2.4 7.1 3.9 6.4 4.4 4.4 L 4.4 4.4 4.4 0 S 4.4 4.4 5.1 6.4 6.8 7.1 "
     "8.3 6.4 8.8 4.4 L 8.8 4.4 8.8 0"},
    {'n', 5.2F, "L 0 0 0 7 S 0 4.2 0.8 6.3 2.8 7.1 4.6 6.3 5.2 4.2 L 5.2 4.2 5.2 0"},
    {'o', 5.8F, "O 2.9 7.1 5.1 6 5.8 3.5 5.1 1 2.9 -0.1 0.7 1 0 3.5 0.7 6"},
    {'p', 5.6F, "L 0 7 0 -3 O 2.8 7.1 5 6 5.6 3.5 5 1 2.8 -0.1 0.6 1 0 3.5 0.6 6"},
    {'q', 5.6F, "L 5.6 7 5.6 -3 O 2.8 7.1 5 6 5.6 3.5 5 1 2.8 -0.1 0.6 1 0 3.5 0.6 6"},
    {'r', 3.4F, "L 0 0 0 7 S 0 4 0.9 6.2 3.4 7"},
    {'s',
     4.6F,
     "S 4.4 5.7 3.7 6.8 2.3 7.1 0.8 6.6 0.3 5.3 0.9 4.2 2.3 3.7 3.9 3.1 4.6 1.8 3.8 0.4 2.3 -0.1 "
     "0.8 0.2 0 1.2"},
    {'t', 3.5F, "L 1.3 9.2 1.3 2 S 1.3 2 1.7 0.4 3.5 0 L 0 7 3.4 7"},
    {'u', 5.2F, "L 0 7 0 2.8 S 0 2.8 0.6 0.7 2.4 -0.1 4.4 0.7 5.2 2.8 L 5.2 7 5.2 0"},
    {'v', 5.4F, "L 0 7 2.7 0 5.4 7"},
    {'w', 8, "L 0 7 2 0 4 6.6 6 0 8 7"},
    {'x', 5, "L 0 0 5 7 L 0 7 5 0"},
    {'y', 5.4F, "L 0 7 2.8 0.2 L 5.4 7 2.4 -1 S 2.4 -1 1.6 -2.6 -0.1 -3"},
    {'z', 4.8F, "L 0 7 4.8 7 0 0 4.8 0"},
    {'0', 6, "O 3 10.1 5.2 8.6 6 5 5.2 1.4 3 -0.1 0.8 1.4 0 5 0.8 8.6"},
    {'1', 6, "L 1.2 8 3.6 10 3.6 0"},
    {'2', 6, "S 0.3 8 1.2 9.6 3 10.1 5 9.3 5.6 7.3 4.8 5.2 0 0 L 0 0 6 0"},
    {'3',
     6,
     "S 0.4 8.6 1.4 9.8 3 10.1 4.9 9.4 5.5 7.7 4.7 6 2.6 5.4 S 2.6 5.4 5 4.7 6 2.7 5.1 0.7 2.9 "
     "-0.1 1.1 0.4 0 1.7"},
    {'4', 6.2F, "L 4.6 0 4.6 10 0 3 6.2 3"},
    {'5',
     6,
     "L 5.4 10 1 10 0.6 5.4 S 0.6 5.4 1.6 6.3 3.1 6.6 5.2 5.6 6 3.3 5.1 0.9 2.9 -0.1 1.1 0.3 0 "
     "1.6"},
    {'6',
     6,
     "S 5.3 8.9 4.4 9.9 3.2 10.1 1.2 8.8 0.1 5.8 0 3.4 S 0 3.4 0.8 1 3 -0.1 5.2 0.9 6 3.2 "
     "5.2 5.4 3.1 6.4 1 5.5 0 3.4"},
    {'7', 5.8F, "L 0 10 5.8 10 1.8 0"},
    {'8',
     6,
     "O 3 10.1 4.9 9.4 5.5 7.7 4.8 6.1 3 5.4 1.2 6.1 0.5 7.7 1.1 9.4 O 3 5.4 5.1 4.6 6 2.6 5.1 0.7 "
     "3 -0.1 0.9 0.7 0 2.6 0.9 4.6"},
    {'9',
     6,
     "S 0.7 1.1 1.6 0.1 2.8 -0.1 4.8 1.2 5.9 4.2 6 6.6 S 6 6.6 5.2 9 3 10.1 0.8 9.1 0 6.8 0.8 4.6 "
     "2.9 3.6 5 4.5 6 6.6"},
    {'.', 0, "L 0 0.1 0 0.2"},
    {',', 0.8F, "L 0.8 0.2 0 -1.8"},
    {':', 0, "L 0 0.1 0 0.2 L 0 6.6 0 6.7"},
    {'-', 3.6F, "L 0 4 3.6 4"},
    {'+', 6, "L 0 4.6 6 4.6 L 3 1.6 3 7.6"},
    {'=', 6, "L 0 3.2 6 3.2 L 0 6.4 6 6.4"},
    {'/', 4, "L 0 -1 4 10.6"},
    {'(', 2.4F, "S 2.4 11 0.8 8.6 0 4.5 0.8 0.4 2.4 -2"},
    {')', 2.4F, "S 0 11 1.6 8.6 2.4 4.5 1.6 0.4 0 -2"},
    {'[', 2.2F, "L 2.2 11 0 11 0 -2 2.2 -2"},
    {']', 2.2F, "L 0 11 2.2 11 2.2 -2 0 -2"},
    {'%',
     9,
     "O 2 10.1 3.5 9.3 4 7.6 3.5 5.9 2 5.1 0.5 5.9 0 7.6 0.5 9.3 O 7 4.9 8.5 4.1 9 2.4 8.5 0.7 7 "
     "-0.1 5.5 0.7 5 2.4 5.5 4.1 L 7.3 10 1.7 0"},
    {'\'', 0, "L 0 10.2 0 7.6"},
    {'*', 4, "L 2 10 2 5.6 L 0 9 4 6.6 L 0 6.6 4 9"},
    {'<', 5.6F, "L 5.6 8 0 4.6 5.6 1.2"},
    {'>', 5.6F, "L 0 8 5.6 4.6 0 1.2"},
    {'_', 5.4F, "L 0 -1.6 5.4 -1.6"},
    {'!', 0, "L 0 10 0 3 L 0 0.1 0 0.2"},
    {'?', 5, "S 0.2 8 1 9.6 2.6 10.1 4.4 9.3 5 7.6 4.2 5.8 2.6 4.4 2.4 2.8 L 2.4 0.1 2.4 0.2"},
    {'#', 7, "L 1.6 0 2.8 10 L 4.4 0 5.6 10 L 0.2 6.6 7 6.6 L 0 3.4 6.8 3.4"},
    {'&',
     7.6F,
     "S 7.4 0 3.4 4.6 1.4 7 1.5 9 3.2 10.1 4.9 9 4.8 7.2 2.6 5.4 0.6 4 0 2.4 0.8 0.6 3 -0.1 5.4 "
     "0.8 7.2 4.4"},
};

// Catmull-Rom spline through the points, as chords.
Stroke smooth(const Stroke& points, bool closed) {
  const auto n = static_cast<int>(points.size());
  const auto point = [&](int i) {
    if (closed) return points[static_cast<std::size_t>((i + n) % n)];
    return points[static_cast<std::size_t>(std::max(0, std::min(i, n - 1)))];
  };
  Stroke curve;
  const int pieces = closed ? n : n - 1;
  for (int i = 0; i < pieces; ++i) {
    const Eigen::Vector2f a = point(i - 1), b = point(i), c = point(i + 1), d = point(i + 2);
    for (int k = 0; k < kChordsPerPiece; ++k) {
      const float t = static_cast<float>(k) / kChordsPerPiece;
      curve.push_back(0.5F * (2 * b + t * (c - a) + t * t * (2 * a - 5 * b + 4 * c - d) +
                              t * t * t * (3 * b - a - 3 * c + d)));
    }
  }
  curve.push_back(closed ? points.front() : points.back());
  return curve;
}

Glyph parseGlyph(const GlyphSource& source) {
  Glyph glyph;
  glyph.advance = source.width + kSpacing;
  std::istringstream tokens(source.strokes);
  tokens.imbue(std::locale::classic());
  char kind = 0;
  while (tokens >> kind) {
    Stroke points;
    Eigen::Vector2f p;
    while (tokens >> p.x() >> p.y()) points.push_back(p);
    tokens.clear();  // stopped at the next stroke's letter, or at the end
    glyph.strokes.push_back(kind == 'L' ? points : smooth(points, kind == 'O'));
  }
  return glyph;
}

std::array<Glyph, 128> makeGlyphs() {
  std::array<Glyph, 128> glyphs;
  const Glyph missing = parseGlyph({0, 5, "L 0 0 5 0 5 10 0 10 0 0"});
  glyphs.fill(missing);
  for (const GlyphSource& source : kGlyphs) {
    glyphs[static_cast<std::size_t>(source.character)] = parseGlyph(source);
  }
  return glyphs;
}

}  // namespace

const Glyph& getGlyph(char character) {
  static const std::array<Glyph, 128> glyphs = makeGlyphs();
  const auto code = static_cast<unsigned char>(character);
  return glyphs[code < glyphs.size() ? code : 0];
}

float measureText(std::string_view text) {
  float width = 0;
  for (const char c : text) width += getGlyph(c).advance;
  return text.empty() ? 0 : width - kSpacing;
}

}  // namespace gaitmill
