#include "core/render/color_scale.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace gaitmill {

namespace {

// White of D65, in CIE XYZ.
constexpr std::array<double, 3> kWhite = {0.95047, 1.0, 1.08883};

double toLinear(double s) {
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

double fromLinear(double s) {
  return s <= 0.0031308 ? 12.92 * s : 1.055 * std::pow(s, 1 / 2.4) - 0.055;
}

double labCurve(double t) {
  return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
}

double labInverse(double f) {
  return f > 6.0 / 29 ? f * f * f : (116 * f - 16) * 27 / 24389;
}

}  // namespace

std::array<double, 3> toLab(const Rgb& color) {
  const double r = toLinear(color[0] / 255.0);
  const double g = toLinear(color[1] / 255.0);
  const double b = toLinear(color[2] / 255.0);
  const double fx = labCurve((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / kWhite[0]);
  const double fy = labCurve((0.2126729 * r + 0.7151522 * g + 0.0721750 * b) / kWhite[1]);
  const double fz = labCurve((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / kWhite[2]);
  return {116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)};
}

Rgb fromLab(const std::array<double, 3>& lab) {
  const double fy = (lab[0] + 16) / 116;
  const double x = kWhite[0] * labInverse(fy + lab[1] / 500);
  const double y = kWhite[1] * labInverse(fy);
  const double z = kWhite[2] * labInverse(fy - lab[2] / 200);
  const auto byte = [](double linear) {
    const double s = fromLinear(std::clamp(linear, 0.0, 1.0));
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(s, 0.0, 1.0)));
  };
  return {byte(3.2404542 * x - 1.5371385 * y - 0.4985314 * z),
          byte(-0.9692660 * x + 1.8760108 * y + 0.0415560 * z),
          byte(0.0556434 * x - 0.2040259 * y + 1.0572252 * z)};
}

Rgb blend(const Rgb& a, const Rgb& b, double t) {
  Rgb result{};
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = static_cast<std::uint8_t>(std::lround((1 - t) * a[i] + t * b[i]));
  }
  return result;
}

Rgb ColorScale::findColor(double value) const {
  if (std::isnan(value)) return kUnknownMuscle;
  const double share = std::clamp((value - lowest) / (highest - lowest), 0.0, 1.0);
  const double position = share * static_cast<double>(stops.size() - 1);
  const std::size_t first = std::min(static_cast<std::size_t>(position), stops.size() - 2);
  const double t = position - static_cast<double>(first);
  const std::array<double, 3> a = toLab(stops[first]), b = toLab(stops[first + 1]);
  return fromLab({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])});
}

const ColorScale& getColorScale(MuscleColor color) {
  // Blue to red as OpenSim shows activation, by way of violet, lightness rising all the way so that
  // more active muscles also read in print.
  static const ColorScale activation = {
      "Activation",
      "",
      "",
      0,
      1,
      {0, 0.5, 1},
      {{44, 92, 200}, {116, 84, 200}, {190, 62, 138}, {228, 36, 36}}};
  // Dark to bright, one hue family apart from activation's, so that the two are not mistaken.
  static const ColorScale force = {
      "Force / max. isometric",
      "",
      "",
      0,
      1,
      {0, 0.5, 1},
      {{52, 42, 88}, {124, 44, 110}, {196, 66, 80}, {240, 128, 44}, {252, 206, 90}}};
  // Diverging around the optimal length: teal short, orange long.
  static const ColorScale fiber_length = {
      "Fiber length / optimal",
      "",
      "",
      0.5,
      1.5,
      {0.5, 1, 1.5},
      {{0, 92, 100}, {62, 160, 158}, {226, 222, 212}, {226, 150, 66}, {150, 72, 10}}};
  check(color != MuscleColor::kNone, "muscles without a quantity have no colour scale");
  if (color == MuscleColor::kForce) return force;
  return color == MuscleColor::kFiberLength ? fiber_length : activation;
}

}  // namespace gaitmill
