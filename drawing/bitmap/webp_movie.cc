#include "drawing/bitmap/webp_movie.h"

#include <fmt/format.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include <cmath>

#include "geometry/core/error.h"

namespace deformlab {
namespace {

using AnimEncoder = std::unique_ptr<WebPAnimEncoder, decltype(&WebPAnimEncoderDelete)>;

AnimEncoder make_encoder(int width, int height, int loop) {
  if (width > WebpMovie::kLargestSide || height > WebpMovie::kLargestSide) {
    throw InputError(
        fmt::format("a WebP has sides of at most {} pixels, and the page would have {}×{}; lower "
                    "output.resolution",
                    WebpMovie::kLargestSide, width, height));
  }
  WebPAnimEncoderOptions options;
  WebPAnimEncoderOptionsInit(&options);
  options.anim_params.loop_count = loop;
  options.anim_params.bgcolor = 0;  // transparent
  return {WebPAnimEncoderNew(width, height, &options), WebPAnimEncoderDelete};
}

WebPConfig lossless() {
  WebPConfig config;
  WebPConfigInit(&config);
  WebPConfigLosslessPreset(&config, 2);  // of 0, fast, to 9, small
  config.exact = 1;
  return config;
}

}  // namespace

struct WebpMovie::Encoder {
  AnimEncoder encoder;
  WebPConfig config = lossless();
  double fps;
  int frames = 0;

  // Rounded from the beginning of the movie, so that errors do not add up.
  int time() const { return static_cast<int>(std::lround(1000 * frames / fps)); }  // [ms]

  void check(int done, const char* what) const {
    if (done != 0) return;
    throw InputError(fmt::format("the WebP cannot be made ({}): {}", what,
                                 WebPAnimEncoderGetError(encoder.get())));
  }
};

WebpMovie::WebpMovie(int width, int height, double fps, int loop)
    : encoder_(new Encoder{.encoder = make_encoder(width, height, loop), .fps = fps}) {
  if (!encoder_->encoder) throw InputError("the WebP cannot be made: there is not enough memory");
}

WebpMovie::~WebpMovie() = default;
WebpMovie::WebpMovie(WebpMovie&&) noexcept = default;
WebpMovie& WebpMovie::operator=(WebpMovie&&) noexcept = default;

void WebpMovie::add(const Bitmap& frame) {
  WebPPicture picture;
  WebPPictureInit(&picture);
  picture.use_argb = 1;
  picture.width = frame.width;
  picture.height = frame.height;
  const std::unique_ptr<WebPPicture, decltype(&WebPPictureFree)> owner(&picture, WebPPictureFree);
  Encoder& e = *encoder_;
  const int read = WebPPictureImportRGBA(&picture, frame.rgba.data(), 4 * frame.width);
  e.check(read, "a frame is too large");
  e.check(WebPAnimEncoderAdd(e.encoder.get(), &picture, e.time(), &e.config), "a frame");
  ++e.frames;
}

std::string WebpMovie::finish() {
  Encoder& e = *encoder_;
  e.check(WebPAnimEncoderAdd(e.encoder.get(), nullptr, e.time(), nullptr), "the last frame");
  WebPData data;
  WebPDataInit(&data);
  e.check(WebPAnimEncoderAssemble(e.encoder.get(), &data), "the file");
  const std::unique_ptr<WebPData, decltype(&WebPDataClear)> owner(&data, WebPDataClear);
  return {reinterpret_cast<const char*>(data.bytes), data.size};
}

}  // namespace deformlab
