#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace walr::render {

/// A decoded image: 8-bit RGBA, rows from the top, no padding.
struct Image {
  std::string name;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba;
};

/// How texture coordinates outside 0..1 are wrapped (glTF sampler `wrapS` and `wrapT`).
enum class Wrap : std::uint8_t { Repeat, ClampToEdge, MirroredRepeat };

/// An image with the way it is sampled.
struct Texture {
  std::uint32_t image = 0;        ///< Index into `Scene::images`.
  std::uint32_t coordinates = 0;  ///< Which of `Material::coordinates` it is sampled at.
  Wrap wrapU = Wrap::Repeat;
  Wrap wrapV = Wrap::Repeat;
  bool nearest = false;  ///< No interpolation (glTF `magFilter` NEAREST).
};

/// The encoding of the red, green and blue bytes of a texture; alpha is always linear.
enum class ColorSpace : std::uint8_t { Srgb, Linear };

/// The linear value of a byte of a texture.
float valueOfByte(std::uint32_t byte, ColorSpace space);

/// Value of a texture at `uv` (v points down, as in glTF). Texels are converted to linear values and interpolated
/// bilinearly; there are no mipmaps. A coordinate that is not finite counts as 0.
glm::vec4 sampleTexture(const Image& image, const Texture& texture, glm::vec2 uv, ColorSpace space);

}  // namespace walr::render
