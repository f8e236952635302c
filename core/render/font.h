#pragma once

#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace gaitmill {

/// A line drawn with a round pen.
using Stroke = std::vector<Eigen::Vector2f>;

/// The project's own stroke font for the labels of pictures: ASCII letters, digits and the
/// punctuation that labels need. Units: capitals are 10 high, small letters 7; y points up from the
/// baseline, tails reach -3.
struct Glyph {
  float advance = 0;            ///< to the next glyph's origin
  std::vector<Stroke> strokes;  ///< curves as short chords
};

inline constexpr float kCapHeight = 10;
inline constexpr float kPenWidth = 1.25F;

/// Characters that the font lacks show as an empty box.
const Glyph& getGlyph(char character);

/// Sum of the advances, less the space after the last glyph.
float measureText(std::string_view text);

}  // namespace gaitmill
