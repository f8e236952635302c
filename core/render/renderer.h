#pragma once

#include <memory>

#include "core/render/camera.h"
#include "core/render/image.h"
#include "core/render/surface.h"

namespace gaitmill {

/// A rectangle of an image [px].
struct Region {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

/// Draws triangles into images with OpenGL in memory (OSMesa): no display, no GPU. Edges and
/// shading are smoothed by four samples per pixel. Its buffers have one size whatever the image
/// has, since large images are drawn in tiles: about 45 MB. One thread at a time.
class Renderer {
 public:
  Renderer();  ///< @throws Error kRender if the graphics library offers no context
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Draws background, floor (unlit, blended, in the order given) and figure (lit, hidden and
  /// back surfaces left out) as the camera sees them, the region's upper left corner being the
  /// camera's (0, 0).
  /// @throws Error kRender if the graphics library reports an error
  void draw(const Surface& floor,
            const Surface& figure,
            const Camera& camera,
            const Region& region,
            Image& image);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gaitmill
