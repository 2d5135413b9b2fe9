#include "samples/image/webp_animation.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <webp/encode.h>
#include <webp/mux.h>

#include "samples/errors.h"
#include "samples/image/file_output.h"

namespace walr {

struct WebpAnimation::Encoder {
  int width;
  int height;
  double millisecondsPerFrame;
  int frames = 0;
  std::unique_ptr<WebPAnimEncoder, decltype(&WebPAnimEncoderDelete)> handle{nullptr, WebPAnimEncoderDelete};

  /// Time stamp of the next frame. Frames are not rounded one by one, so that the animation keeps its length.
  [[nodiscard]] int milliseconds() const { return static_cast<int>(std::lround(frames * millisecondsPerFrame)); }

  [[noreturn]] void fail(const std::string& action) const {
    throw OutputError("WebP: " + action + ": " + WebPAnimEncoderGetError(handle.get()));
  }
};

WebpAnimation::WebpAnimation(int width, int height, double framesPerSecond)
    : encoder_(new Encoder{.width = width, .height = height, .millisecondsPerFrame = 1000.0 / framesPerSecond}) {
  WebPAnimEncoderOptions options;
  const bool known = WebPAnimEncoderOptionsInit(&options) != 0;
  const bool inRange = width >= 1 && height >= 1 && width <= WEBP_MAX_DIMENSION && height <= WEBP_MAX_DIMENSION;
  if (known && inRange) encoder_->handle.reset(WebPAnimEncoderNew(width, height, &options));
  if (encoder_->handle == nullptr) {
    throw OutputError("WebP: an animation of " + std::to_string(width) + " x " + std::to_string(height) +
                      " pixels cannot be encoded; each side has 1 to " + std::to_string(WEBP_MAX_DIMENSION) +
                      " pixels");
  }
}

WebpAnimation::~WebpAnimation() = default;

void WebpAnimation::add(std::span<const std::uint32_t> texels) {
  WebPConfig config;
  WebPPicture picture;
  constexpr float kQuality = 90.0F;  // Of 100; noise in the picture shows artefacts below.
  if (WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, kQuality) == 0 || WebPPictureInit(&picture) == 0) {
    throw OutputError("WebP: the library has another version than the one that walr was built with");
  }
  const std::unique_ptr<WebPPicture, decltype(&WebPPictureFree)> freed(&picture, WebPPictureFree);
  picture.use_argb = 1;
  picture.width = encoder_->width;
  picture.height = encoder_->height;
  constexpr int kBytesPerTexel = 4;
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(texels.data());
  if (WebPPictureImportRGBX(&picture, bytes, encoder_->width * kBytesPerTexel) == 0 ||
      WebPAnimEncoderAdd(encoder_->handle.get(), &picture, encoder_->milliseconds(), &config) == 0) {
    encoder_->fail("adding frame " + std::to_string(encoder_->frames));
  }
  ++encoder_->frames;
}

void WebpAnimation::write(const std::filesystem::path& path) {
  WebPData data;
  WebPDataInit(&data);
  const std::unique_ptr<WebPData, decltype(&WebPDataClear)> cleared(&data, WebPDataClear);
  // The last frame's end is told by a frame without a picture.
  if (WebPAnimEncoderAdd(encoder_->handle.get(), nullptr, encoder_->milliseconds(), nullptr) == 0 ||
      WebPAnimEncoderAssemble(encoder_->handle.get(), &data) == 0) {
    encoder_->fail("assembling " + path.string());
  }
  writeFileAtomically(path, std::as_bytes(std::span(data.bytes, data.size)));
}

}  // namespace walr
