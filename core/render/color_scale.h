#pragma once

#include <string>
#include <vector>

#include "core/render/image.h"
#include "core/render/picture.h"

namespace gaitmill {

/// How a quantity of muscles becomes a colour, and how the legend names it.
struct ColorScale {
  std::string title;  ///< "Activation"
  std::string below;  ///< said after the lowest tick, "" = nothing
  std::string above;  ///< said after the highest tick
  double lowest = 0;  ///< values beyond the ends get the end's colour
  double highest = 1;
  std::vector<double> ticks;
  std::vector<Rgb> stops;  ///< evenly from lowest to highest, blended in CIELAB

  /// NaN (not known) is grey.
  Rgb findColor(double value) const;
};

/// @param color  not kNone
const ColorScale& getColorScale(MuscleColor color);

/// Muscles whose value nobody knows, and muscles that are not coloured by anything.
inline constexpr Rgb kUnknownMuscle{150, 152, 158};
inline constexpr Rgb kPlainMuscle{170, 84, 76};

/// `a` at t = 0, `b` at t = 1.
Rgb blend(const Rgb& a, const Rgb& b, double t);

/// CIELAB of an sRGB colour (D65).
std::array<double, 3> toLab(const Rgb& color);
Rgb fromLab(const std::array<double, 3>& lab);  ///< clipped to what screens show

}  // namespace gaitmill
