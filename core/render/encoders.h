#pragma once

#include <memory>
#include <string>

#include "core/render/image.h"

namespace gaitmill {

/// PNG, compressed for speed. @throws Error kRender
std::string encodePng(const Image& image);

/// Collects frames of one size into an animated WebP that repeats for ever.
class WebpAnimation {
 public:
  /// @param frame_time  how long each frame shows [ms] > 0
  WebpAnimation(int width, int height, double frame_time);
  ~WebpAnimation();
  WebpAnimation(const WebpAnimation&) = delete;
  WebpAnimation& operator=(const WebpAnimation&) = delete;

  void addFrame(const Image& image);  ///< @throws Error kRender
  std::string finish();               ///< bytes of the file. @throws Error kRender

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gaitmill
