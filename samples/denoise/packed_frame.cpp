#include "samples/denoise/packed_frame.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "passes/conventions/orthographic.h"
#include "samples/errors.h"
#include "samples/image/half.h"

namespace walr {

std::vector<Rgba16> packRgba16(const Image& image) {
  std::vector<Rgba16> texels(image.pixelCount());
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const auto pixel = image.pixel(i);
    for (std::size_t c = 0; c < pixel.size(); ++c) {
      texels[i].at(c) = toHalf(pixel[c]).bits();
    }
  }
  return texels;
}

Image unpackRgb(const std::vector<Rgba16>& texels, int width, int height) {
  Image image(width, height, 3);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      image.pixel(i)[c] = Imath::half(Imath::half::FromBits, texels[i].at(c));
    }
  }
  return image;
}

namespace {

/// Object numbers in the format of their texture.
std::vector<std::uint32_t> packNumbers(const Image& image) {
  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> numbers;
  numbers.reserve(image.pixelCount());
  for (const float value : image.values()) {
    const bool isNumber = value >= 0.0F && value < static_cast<float>(kNone);
    numbers.push_back(isNumber ? static_cast<std::uint32_t>(value) : kNone);
  }
  return numbers;
}

std::vector<Rgba16> packSpecularLighting(const Frame& frame) {
  std::vector<Rgba16> texels = packRgba16(frame.specular);
  for (std::size_t i = 0; i < texels.size(); ++i) texels[i][3] = toHalf(frame.specularDistance.values()[i]).bits();
  return texels;
}

/// As R8_UNORM; 1 where it is not finite.
std::vector<std::uint8_t> packUnorm8(const Image& image) {
  std::vector<std::uint8_t> texels;
  texels.reserve(image.pixelCount());
  for (const float value : image.values()) {
    const float bounded = value >= 0.0F ? std::min(value, 1.0F) : (value < 0.0F ? 0.0F : 1.0F);
    texels.push_back(static_cast<std::uint8_t>(std::lround(255.0F * bounded)));
  }
  return texels;
}

}  // namespace

std::vector<Rgba16> packLight(const Frame& frame, Light light) {
  if (light == Light::Specular) return packSpecularLighting(frame);
  const Image& full = light == Light::Indirect ? frame.indirect : frame.direct;
  if (frame.light.everyPixel()) return packRgba16(full);
  const fg::Extent extent =
      frame.light.lightingExtent({static_cast<std::uint32_t>(full.width()), static_cast<std::uint32_t>(full.height())});
  Image texels(static_cast<int>(extent.width), static_cast<int>(extent.height), full.components());
  for (int y = 0; y < texels.height(); ++y) {
    for (int x = 0; x < texels.width(); ++x) {
      const glm::ivec2 p = frame.light.pixelOf({x, y}, frame.lightOffset);
      if (p.x >= full.width() || p.y >= full.height()) continue;
      for (int c = 0; c < texels.components(); ++c) texels.at(x, y, c) = full.at(p.x, p.y, c);
    }
  }
  return packRgba16(texels);
}

PackedLight packSpecular(const Frame& frame) {
  return {packLight(frame, Light::Specular),
          {packRgba16(frame.specularAlbedo), packUnorm8(frame.roughness), packRgba16(frame.specularMotion)}};
}

PackedFrame packFrame(Frame frame, Light light) {
  PackedFrame packed;
  if (light == Light::Specular) {
    PackedLight specular = packSpecular(frame);
    packed.lighting = std::move(specular.lighting);
    packed.lobe = std::move(specular.lobe);
  } else {
    packed.lighting = packLight(frame, light);
    packed.lobe.albedo = packRgba16(frame.albedo);
  }
  packed.normal = packRgba16(frame.normal);
  packed.motion = packRgba16(frame.motion);
  packed.objectId = packNumbers(frame.objectId);
  packed.frame = std::move(frame);
  return packed;
}

FrameDescription frameDescriptionOf(const Frame& frame, glm::vec2 motionScale) {
  FrameDescription description{.view = frame.camera.view,
                               .previousView = frame.camera.previousView,
                               .projection = frame.camera.projection,
                               .previousProjection = frame.previousProjection,
                               .jitter = frame.camera.jitter,
                               .previousJitter = frame.previousJitter,
                               .motionScale = motionScale,
                               .frameIndex = static_cast<std::uint32_t>(frame.number),
                               .skyDepth = kSkyDepth,
                               .lightOffset = frame.lightOffset,
                               .previousLightOffset = frame.previousLightOffset};
  if (frame.previousSize) {
    description.previousExtent = {static_cast<std::uint32_t>(frame.previousSize->x),
                                  static_cast<std::uint32_t>(frame.previousSize->y)};
  }
  return description;
}

namespace {

FrameConstants constantsOf(const Frame& frame, glm::vec2 motionScale, fg::Extent extent) {
  const std::string camera = "camera of frame " + std::to_string(frame.number) + ": ";
  if (isOrthographic(frame.camera.projection)) {
    throw InputError(camera + "it is orthographic; the frames of a sequence need a perspective camera");
  }
  try {
    return frameConstants(frameDescriptionOf(frame, motionScale), extent);
  } catch (const std::invalid_argument& error) {
    throw InputError(camera + error.what());
  }
}

}  // namespace

FrameConstants frameConstantsOf(const Frame& frame, glm::vec2 motionScale) {
  return constantsOf(
      frame, motionScale,
      {static_cast<std::uint32_t>(frame.depth.width()), static_cast<std::uint32_t>(frame.depth.height())});
}

void checkCameras(const Sequence& sequence) {
  for (std::size_t i = 0; i < sequence.entries().size(); ++i) {
    (void)constantsOf(sequence.describe(i), sequence.denoiserLayout().motionScale, sequence.extent());
  }
}

}  // namespace walr
