#pragma once

#include "core/render/picture.h"

namespace gaitmill {

// What can be asked of a Painter.
inline constexpr int kMinimumSide = 16;  ///< [px] of one pose
inline constexpr int kMaximumSide = 4096;
inline constexpr int kMaximumStripWidth = 16383;       ///< [px]; that of a WebP too
inline constexpr double kMaximumStripPixels = 16.8e6;  ///< of all poses: 50 MB unpacked
inline constexpr int kMaximumPoses = 24;
inline constexpr int kMaximumFrames = 600;
inline constexpr double kMaximumAnimationPixels = 250e6;  ///< of all frames: some 20 s of work

/// @throws Error kImageSize naming the side; kRequestField for a view that is no direction
void validateOptions(const PictureOptions& options);
/// @throws Error kImageSize; kRequestField if start or end are no times
void validateStrip(double start, double end, int count, const PictureOptions& options);
/// Number of frames of an animation. @throws Error kImageSize; kRequestField for a rate or slowness
/// that is not positive, or a time range that is empty
int countFrames(
    double start, double end, double rate, double slow_down, const PictureOptions& options);

}  // namespace gaitmill
