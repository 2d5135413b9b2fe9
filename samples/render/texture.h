#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace walr::render {

/// A decoded picture: 8-bit RGBA, rows from the top, no padding.
struct Image {
  std::string name;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba;
};

/// What a texture coordinate outside 0..1 means (glTF sampler `wrapS` and `wrapT`).
enum class Wrap : std::uint8_t { Repeat, ClampToEdge, MirroredRepeat };

/// An image with the way it is sampled.
struct Texture {
  std::uint32_t image = 0;  ///< Index into `Scene::images`.
  Wrap wrapU = Wrap::Repeat;
  Wrap wrapV = Wrap::Repeat;
  bool nearest = false;  ///< No interpolation (glTF `magFilter` NEAREST).
};

/// How the red, green and blue bytes of a texture are meant; alpha is always linear.
enum class ColorSpace : std::uint8_t { Srgb, Linear };

/// Value of a texture at `uv` (v down, as glTF), from the finest level: bilinear, after conversion to linear values.
/// A texture coordinate that is not finite gives the texel at the origin.
glm::vec4 sampleTexture(const Image& image, const Texture& texture, glm::vec2 uv, ColorSpace space);

}  // namespace walr::render
