#include "core/render/picture_limits.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/io/number_text.h"

namespace gaitmill {

namespace {

Where atField(const char* field) {
  Where where;
  where.field = field;
  return where;
}

void checkSide(const char* name, int side) {
  require(side >= kMinimumSide && side <= kMaximumSide,
          ErrorCode::kImageSize,
          std::string(name) + " is " + std::to_string(side) + " px, it can be " +
              std::to_string(kMinimumSide) + " to " + std::to_string(kMaximumSide) + " px",
          atField(name));
}

void checkTimes(double start, double end) {
  require(std::isfinite(start) && std::isfinite(end),
          ErrorCode::kRequestField,
          "start and end must be times",
          atField("start"));
}

double countPixels(const PictureOptions& options) {
  return static_cast<double>(options.width) * options.height;
}

}  // namespace

View parseView(const std::string& text) {
  if (text == "sagittal") return {0, 0};
  if (text == "frontal") return {0.5 * kPi, 0};
  if (text == "oblique") return {toRadians(40), toRadians(12)};
  const std::size_t comma = text.find(',');
  const auto parse = [&](std::size_t first, std::size_t count) {
    return parseNumber(trim(std::string_view(text).substr(first, count)));
  };
  std::optional<double> azimuth, elevation;
  if (comma != std::string::npos) {
    azimuth = parse(0, comma);
    elevation = parse(comma + 1, std::string::npos);
  }
  require(azimuth && elevation && std::isfinite(*azimuth) && std::isfinite(*elevation) &&
              std::abs(*azimuth) <= 360 && std::abs(*elevation) <= 90,
          ErrorCode::kRequestField,
          "view '" + text +
              "' must be sagittal, frontal, oblique, or azimuth,elevation in degrees with the "
              "azimuth in -360..360 and the elevation in -90..90",
          atField("view"));
  return {toRadians(*azimuth), toRadians(*elevation)};
}

void validateOptions(const PictureOptions& options) {
  checkSide("width", options.width);
  checkSide("height", options.height);
  require(std::isfinite(options.view.azimuth) && std::abs(options.view.elevation) <= 0.5001 * kPi,
          ErrorCode::kRequestField,
          "the view's azimuth must be a number and its elevation in -90..90 degrees",
          atField("view"));
}

void validateStrip(double start, double end, int count, const PictureOptions& options) {
  validateOptions(options);
  checkTimes(start, end);
  require(count >= 1 && count <= kMaximumPoses,
          ErrorCode::kImageSize,
          "a strip of " + std::to_string(count) + " poses, it can have 1 to " +
              std::to_string(kMaximumPoses),
          atField("poses"));
  require(count * options.width <= kMaximumStripWidth &&
              count * countPixels(options) <= kMaximumStripPixels,
          ErrorCode::kImageSize,
          "a strip of " + std::to_string(count) + " poses can have at most " +
              std::to_string(kMaximumStripWidth) + " px in width and " +
              formatFixed(kMaximumStripPixels / 1e6, 1) + " million pixels",
          atField("width"));
}

int countFrames(
    double start, double end, double rate, double slow_down, const PictureOptions& options) {
  validateOptions(options);
  checkTimes(start, end);
  require(end > start, ErrorCode::kRequestField, "end must be after start", atField("end"));
  require(rate > 0 && rate <= 60,
          ErrorCode::kRequestField,
          "rate must be above 0 and at most 60 frames per second",
          atField("rate"));
  require(slow_down > 0 && slow_down <= 1000,
          ErrorCode::kRequestField,
          "slow_down must be above 0 and at most 1000",
          atField("slow_down"));
  const double frames = std::max(1.0, std::round((end - start) * slow_down * rate));
  require(frames <= kMaximumFrames && frames * countPixels(options) <= kMaximumAnimationPixels,
          ErrorCode::kImageSize,
          "an animation of " + formatFixed(frames, 0) + " frames; it can have at most " +
              std::to_string(kMaximumFrames) + " frames and " +
              formatFixed(kMaximumAnimationPixels / 1e6, 0) + " million pixels",
          atField("rate"));
  return static_cast<int>(frames);
}

}  // namespace gaitmill
