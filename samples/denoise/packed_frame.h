#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "passes/conventions/frame.h"
#include "samples/sequence/frame.h"
#include "samples/sequence/sequence.h"

namespace walr {

/// The bits of four half floats: a texel of RGBA16F.
using Rgba16 = std::array<std::uint16_t, 4>;

/// The lobe that reflects a light.
struct PackedLobe {
  std::vector<Rgba16> albedo;
  std::vector<std::uint8_t> roughness;  ///< 255: 1; empty unless the light is specular.
  std::vector<Rgba16> motion;           ///< Of specular light: `Frame::specularMotion`; empty if the frame has none.
};

/// A frame with its images in the formats of the denoiser's textures (`DenoiserInputs`).
struct PackedFrame {
  Frame frame;
  /// Of the light that `packFrame` was asked for, with the extent `LightPattern::lightingExtent`.
  std::vector<Rgba16> lighting;
  std::vector<Rgba16> normal;
  std::vector<Rgba16> motion;
  PackedLobe lobe;                      ///< Of that light.
  std::vector<std::uint32_t> objectId;  ///< 0xffffffff: no object; empty if the frame has no object numbers.
};

/// Texels of an image of at most four components; missing components are 0. Finite values beyond the range of half
/// floats saturate.
std::vector<Rgba16> packRgba16(const Image& image);

/// The first three components of texels as an image.
Image unpackRgb(const std::vector<Rgba16>& texels, int width, int height);

/// What differs between the lights of a frame.
struct PackedLight {
  std::vector<Rgba16> lighting;
  PackedLobe lobe;
};

/// @param light  the light to denoise
PackedFrame packFrame(Frame frame, Light light = Light::Indirect);

/// Specular light of a frame.
PackedLight packSpecular(const Frame& frame);

/// The texels of one light of a frame: of the pixels that have a sample. Those of samples outside the image are 0.
/// Alpha is the distance of specular light.
std::vector<Rgba16> packLight(const Frame& frame, Light light);

/// A frame's camera in the form that the passes use.
/// @param motionScale  see `FrameDescription::motionScale`
FrameDescription frameDescriptionOf(const Frame& frame, glm::vec2 motionScale);

/// The uniform block of a frame's camera.
/// @param motionScale  see `FrameDescription::motionScale`
/// @throws InputError naming a frame whose camera is not usable
FrameConstants frameConstantsOf(const Frame& frame, glm::vec2 motionScale);

/// @throws InputError naming a frame whose camera is not usable
void checkCameras(const Sequence& sequence);

}  // namespace walr
