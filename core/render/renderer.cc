#include "core/render/renderer.h"

#define GL_GLEXT_PROTOTYPES
#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <GL/osmesa.h>

#include "core/base/error.h"
#include "core/render/color_scale.h"
#include "core/render/shaders.h"

namespace gaitmill {

namespace {

constexpr int kTileWidth = 1280;  // [px]
constexpr int kTileHeight = 720;
// Pixels drawn per pixel of the image, each way. Multisampling of OpenGL would smooth edges alike,
// but in llvmpipe it costs a third more here, where triangles are about as small as pixels.
constexpr int kScale = 2;
constexpr Rgb kSkyColor{250, 251, 252};
constexpr Rgb kBottomColor{228, 232, 238};

[[noreturn]] void fail(const std::string& what) {
  throw Error(ErrorCode::kRender, "the renderer failed: " + what);
}

GLuint compileShader(GLenum kind, const char* source) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint done = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (done != GL_TRUE) {
    std::array<char, 500> log{};
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    fail(std::string("shader: ") + log.data());
  }
  return shader;
}

GLuint linkProgram(const char* vertex_source, const char* fragment_source) {
  const GLuint program = glCreateProgram();
  const GLuint vertex = compileShader(GL_VERTEX_SHADER, vertex_source);
  const GLuint fragment = compileShader(GL_FRAGMENT_SHADER, fragment_source);
  glAttachShader(program, vertex);
  glAttachShader(program, fragment);
  glBindAttribLocation(program, 0, "position");
  glBindAttribLocation(program, 1, "normal");
  glBindAttribLocation(program, 2, "color");
  glLinkProgram(program);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  GLint done = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &done);
  if (done != GL_TRUE) fail("program does not link");
  return program;
}

// Colour and depth of one tile, as what is drawn into.
void makeTarget(int width, int height) {
  GLuint target = 0;
  glGenFramebuffers(1, &target);
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  const auto attach = [&](GLenum format, GLenum place) {
    GLuint buffer = 0;
    glGenRenderbuffers(1, &buffer);
    glBindRenderbuffer(GL_RENDERBUFFER, buffer);
    glRenderbufferStorage(GL_RENDERBUFFER, format, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, buffer);
  };
  attach(GL_RGBA8, GL_COLOR_ATTACHMENT0);
  attach(GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    fail("no buffer to draw into");
  }
}

// A surface on the other side of the graphics library.
class Buffers {
 public:
  void create() {
    glGenBuffers(1, &vertices_);
    glGenBuffers(1, &indices_);
  }
  void upload(const Surface& surface) {
    count_ = static_cast<GLsizei>(surface.indices.size());
    bind();
    glBufferData(GL_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(surface.vertices.size() * sizeof(SurfaceVertex)),
                 surface.vertices.data(),
                 GL_STREAM_DRAW);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(surface.indices.size() * sizeof(std::uint32_t)),
                 surface.indices.data(),
                 GL_STREAM_DRAW);
  }
  void draw() const {
    if (count_ == 0) return;
    bind();
    const auto offset = [](std::size_t bytes) {
      return reinterpret_cast<const void*>(bytes);
    };
    const auto stride = static_cast<GLsizei>(sizeof(SurfaceVertex));
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, stride, offset(0));
    glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, stride, offset(12));
    glVertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, offset(24));
    glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
  }

 private:
  void bind() const {
    glBindBuffer(GL_ARRAY_BUFFER, vertices_);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  }
  GLuint vertices_ = 0;
  GLuint indices_ = 0;
  GLsizei count_ = 0;
};

void setMatrix(GLuint program, const char* name, const Eigen::Matrix4d& matrix) {
  const Eigen::Matrix4f values = matrix.cast<float>();
  glUniformMatrix4fv(glGetUniformLocation(program, name), 1, GL_FALSE, values.data());
}

void setVector(GLuint program, const char* name, const Eigen::Vector3d& vector) {
  const Eigen::Vector3f values = vector.cast<float>();
  glUniform3fv(glGetUniformLocation(program, name), 1, values.data());
}

// Sky at the top of the region, floor haze at its bottom; in clip coordinates of the tile.
Surface makeBackground(double top_share, double bottom_share) {
  const Rgb top = blend(kSkyColor, kBottomColor, top_share);
  const Rgb bottom = blend(kSkyColor, kBottomColor, bottom_share);
  const Eigen::Vector3f n = Eigen::Vector3f::UnitZ();
  Surface surface;
  surface.vertices = {{{-1, 1, 0}, n, top, 255},
                      {{1, 1, 0}, n, top, 255},
                      {{-1, -1, 0}, n, bottom, 255},
                      {{1, -1, 0}, n, bottom, 255}};
  surface.indices = {0, 2, 1, 1, 2, 3};
  return surface;
}

}  // namespace

struct Renderer::Impl {
  OSMesaContext context = nullptr;
  std::array<std::uint8_t, 16> default_buffer{};  // of one row of four pixels; never looked at
  GLuint lit = 0, flat = 0;
  Buffers background, floor, figure;
  std::vector<std::uint8_t> pixels;  // RGBA, rows from the bottom

  void makeCurrent() {
    if (OSMesaMakeCurrent(context, default_buffer.data(), GL_UNSIGNED_BYTE, 4, 1) != GL_TRUE) {
      fail("no context");
    }
  }

  void create() {
    makeCurrent();
    makeTarget(kScale * kTileWidth, kScale * kTileHeight);
    lit = linkProgram(kLitVertexShader, kLitFragmentShader);
    flat = linkProgram(kFlatVertexShader, kFlatFragmentShader);
    for (Buffers* buffers : {&background, &floor, &figure}) buffers->create();
    for (const GLuint attribute : {0U, 1U, 2U}) glEnableVertexAttribArray(attribute);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDepthFunc(GL_LEQUAL);
    glCullFace(GL_BACK);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
  }

  void drawFlat(const Camera& camera, const Region& region, const Region& tile) {
    glUseProgram(flat);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    background.upload(makeBackground(static_cast<double>(tile.top) / region.height,
                                     static_cast<double>(tile.top + tile.height) / region.height));
    setMatrix(flat, "clip", Eigen::Matrix4d::Identity());
    background.draw();
    if (camera.eye.y() <= 0) return;  // from below, the floor would hide the feet
    glEnable(GL_BLEND);
    setMatrix(flat, "clip", camera.calcClipMatrix(tile.left, tile.top, tile.width, tile.height));
    floor.draw();
    glDisable(GL_BLEND);
  }

  void drawLit(const Camera& camera, const Region& tile) {
    glUseProgram(lit);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    setMatrix(lit, "clip", camera.calcClipMatrix(tile.left, tile.top, tile.width, tile.height));
    setVector(lit, "eye", camera.eye);
    setVector(lit, "up_C", camera.R_CG.col(1));
    const Eigen::Matrix3f R = camera.R_CG.cast<float>();
    glUniformMatrix3fv(glGetUniformLocation(lit, "camera"), 1, GL_FALSE, R.data());
    figure.draw();
  }

  void drawTile(const Camera& camera, const Region& region, const Region& tile) {
    const int width = kScale * tile.width, height = kScale * tile.height;
    glViewport(0, 0, width, height);
    glClear(GL_DEPTH_BUFFER_BIT);
    drawFlat(camera, region, tile);
    drawLit(camera, tile);
    pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    const GLenum error = glGetError();
    if (error != GL_NO_ERROR) fail("OpenGL error " + std::to_string(error));
  }

  // Means of 2 x 2 pixels, rows from the top.
  void copyTile(const Region& region, const Region& tile, Image& image) const {
    static_assert(kScale == 2, "the mean below is of four");
    const std::size_t row_bytes = static_cast<std::size_t>(tile.width) * kScale * 4;
    for (int y = 0; y < tile.height; ++y) {
      const auto row = static_cast<std::size_t>(tile.height - 1 - y) * kScale;
      const std::uint8_t* a = pixels.data() + row * row_bytes;
      const std::uint8_t* b = a + row_bytes;
      std::uint8_t* to =
          image.bytes.data() + image.at(region.left + tile.left, region.top + tile.top + y);
      for (int x = 0; x < tile.width; ++x, a += 8, b += 8, to += 3) {
        for (std::size_t c = 0; c < 3; ++c) {
          to[c] = static_cast<std::uint8_t>((a[c] + a[c + 4] + b[c] + b[c + 4] + 2) / 4);
        }
      }
    }
  }
};

Renderer::Renderer() : impl_(std::make_unique<Impl>()) {
  const std::array<int, 9> attributes = {OSMESA_FORMAT,
                                         OSMESA_RGBA,
                                         OSMESA_PROFILE,
                                         OSMESA_COMPAT_PROFILE,
                                         OSMESA_CONTEXT_MAJOR_VERSION,
                                         3,
                                         OSMESA_CONTEXT_MINOR_VERSION,
                                         0,
                                         0};
  impl_->context = OSMesaCreateContextAttribs(attributes.data(), nullptr);
  if (impl_->context == nullptr) fail("the graphics library offers no context of OpenGL 3.0");
  try {
    impl_->create();
  } catch (...) {
    OSMesaDestroyContext(impl_->context);
    throw;
  }
}

Renderer::~Renderer() {
  OSMesaDestroyContext(impl_->context);
}

void Renderer::draw(const Surface& floor,
                    const Surface& figure,
                    const Camera& camera,
                    const Region& region,
                    Image& image) {
  Impl& s = *impl_;
  s.makeCurrent();
  s.floor.upload(floor);
  s.figure.upload(figure);
  for (int top = 0; top < region.height; top += kTileHeight) {
    for (int left = 0; left < region.width; left += kTileWidth) {
      const Region tile{left,
                        top,
                        std::min(kTileWidth, region.width - left),
                        std::min(kTileHeight, region.height - top)};
      s.drawTile(camera, region, tile);
      s.copyTile(region, tile, image);
    }
  }
}

}  // namespace gaitmill
