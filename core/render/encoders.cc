#include "core/render/encoders.h"

#include <png.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/error.h"

namespace gaitmill {

namespace {

// Lossy, at a quality where thin muscles keep their edges; method 2 of 6 halves the time of the
// default for some 5 % more bytes.
constexpr float kWebpQuality = 84;
constexpr int kWebpMethod = 2;
constexpr int kKeyFrameDistance = 1000;  // [frames] one motion hardly needs a second key frame

void need(bool done, const char* what) {
  require(done, ErrorCode::kRender, std::string("the image could not be encoded: ") + what);
}

// What libpng writes to and answers to; its errors return here as exceptions of our own, thrown
// after the library's jump has ended.
struct PngTarget {
  std::string bytes;
};

void appendPng(png_structp png, png_bytep data, std::size_t size) {
  auto* target = static_cast<PngTarget*>(png_get_io_ptr(png));
  target->bytes.append(reinterpret_cast<const char*>(data), size);
}

void flushPng(png_structp) {}

// In place of libpng's own, which print.
void leavePng(png_structp png, png_const_charp) {
  png_longjmp(png, 1);
}
void ignorePng(png_structp, png_const_charp) {}

// No object with a destructor lives in here: libpng leaves by longjmp.
bool writePng(png_structp png, png_infop info, const Image& image, png_bytepp rows) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_IHDR(png,
               info,
               static_cast<png_uint_32>(image.width),
               static_cast<png_uint_32>(image.height),
               8,
               PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_set_compression_level(png, 1);
  png_set_filter(png, PNG_FILTER_TYPE_DEFAULT, PNG_FILTER_UP);
  png_write_info(png, info);
  png_write_image(png, rows);
  png_write_end(png, info);
  return true;
}

}  // namespace

std::string encodePng(const Image& image) {
  PngTarget target;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, leavePng, ignorePng);
  need(png != nullptr, "no memory for libpng");
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &target, appendPng, flushPng);
  std::vector<png_bytep> rows;
  for (int y = 0; y < image.height; ++y) {
    rows.push_back(const_cast<png_bytep>(image.bytes.data() + image.at(0, y)));
  }
  const bool done = info != nullptr && writePng(png, info, image, rows.data());
  png_destroy_write_struct(&png, &info);
  need(done, "libpng refused it");
  return target.bytes;
}

struct WebpAnimation::Impl {
  WebPAnimEncoder* encoder = nullptr;
  WebPConfig config{};
  double frame_time = 0;
  int frames = 0;
  int width = 0;
  int height = 0;

  int timestamp() const { return static_cast<int>(std::lround(frames * frame_time)); }
  ~Impl() { WebPAnimEncoderDelete(encoder); }
};

WebpAnimation::WebpAnimation(int width, int height, double frame_time)
    : impl_(std::make_unique<Impl>()) {
  impl_->width = width;
  impl_->height = height;
  impl_->frame_time = frame_time;
  WebPAnimEncoderOptions options;
  need(WebPAnimEncoderOptionsInit(&options) != 0 && WebPConfigInit(&impl_->config) != 0,
       "another version of libwebp");
  options.kmin = kKeyFrameDistance - 1;
  options.kmax = kKeyFrameDistance;
  impl_->config.quality = kWebpQuality;
  impl_->config.method = kWebpMethod;
  impl_->encoder = WebPAnimEncoderNew(width, height, &options);
  need(impl_->encoder != nullptr, "no memory for libwebp");
}

WebpAnimation::~WebpAnimation() = default;

void WebpAnimation::addFrame(const Image& image) {
  WebPPicture picture;
  need(WebPPictureInit(&picture) != 0, "another version of libwebp");
  picture.width = image.width;
  picture.height = image.height;
  picture.use_argb = 1;
  const bool done =
      WebPPictureImportRGB(&picture, image.bytes.data(), 3 * image.width) != 0 &&
      WebPAnimEncoderAdd(impl_->encoder, &picture, impl_->timestamp(), &impl_->config) != 0;
  WebPPictureFree(&picture);
  need(done, WebPAnimEncoderGetError(impl_->encoder));
  ++impl_->frames;
}

std::string WebpAnimation::finish() {
  need(WebPAnimEncoderAdd(impl_->encoder, nullptr, impl_->timestamp(), nullptr) != 0,
       WebPAnimEncoderGetError(impl_->encoder));
  WebPData data;
  WebPDataInit(&data);
  const bool done = WebPAnimEncoderAssemble(impl_->encoder, &data) != 0;
  std::string bytes;
  if (done) bytes.assign(reinterpret_cast<const char*>(data.bytes), data.size);
  WebPDataClear(&data);
  need(done, WebPAnimEncoderGetError(impl_->encoder));
  return bytes;
}

}  // namespace gaitmill
