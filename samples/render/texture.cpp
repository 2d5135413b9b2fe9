#include "samples/render/texture.h"

#include <array>
#include <cmath>

#include <glm/common.hpp>

namespace walr::render {
namespace {

using ByteTable = std::array<float, 256>;

// IEC 61966-2-1.
ByteTable makeSrgbTable() {
  ByteTable table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const float encoded = static_cast<float>(i) / 255.0F;
    table[i] = encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
  }
  return table;
}

ByteTable makeLinearTable() {
  ByteTable table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = static_cast<float>(i) / 255.0F;
  }
  return table;
}

std::uint32_t wrapTexel(std::int64_t texel, std::uint32_t size, Wrap wrap) {
  const auto n = static_cast<std::int64_t>(size);
  const auto modulo = [](std::int64_t a, std::int64_t b) { return ((a % b) + b) % b; };
  switch (wrap) {
    case Wrap::ClampToEdge:
      return static_cast<std::uint32_t>(glm::clamp(texel, std::int64_t{0}, n - 1));
    case Wrap::MirroredRepeat: {
      const std::int64_t folded = modulo(texel, 2 * n);
      return static_cast<std::uint32_t>(folded < n ? folded : 2 * n - 1 - folded);
    }
    case Wrap::Repeat:
      break;
  }
  return static_cast<std::uint32_t>(modulo(texel, n));
}

}  // namespace

glm::vec4 sampleTexture(const Image& image, const Texture& texture, glm::vec2 uv, ColorSpace space) {
  static const ByteTable srgb = makeSrgbTable();
  static const ByteTable linear = makeLinearTable();
  const ByteTable& color = space == ColorSpace::Srgb ? srgb : linear;

  const auto fetch = [&](std::int64_t x, std::int64_t y) {
    const std::size_t column = wrapTexel(x, image.width, texture.wrapU);
    const std::size_t row = wrapTexel(y, image.height, texture.wrapV);
    const std::uint8_t* texel = &image.rgba[(row * image.width + column) * 4];
    return glm::vec4(color[texel[0]], color[texel[1]], color[texel[2]], linear[texel[3]]);
  };

  // Beyond this a float holds no fraction of a texel any more, and an integer conversion could overflow.
  constexpr float kLargestCoordinate = 16777216.0F;
  const auto usable = [](float c) { return std::isfinite(c) && std::abs(c) < kLargestCoordinate; };
  const glm::vec2 texel = glm::vec2(usable(uv.x) ? uv.x : 0.0F, usable(uv.y) ? uv.y : 0.0F) *
                          glm::vec2(static_cast<float>(image.width), static_cast<float>(image.height));
  if (texture.nearest) {
    return fetch(static_cast<std::int64_t>(std::floor(texel.x)), static_cast<std::int64_t>(std::floor(texel.y)));
  }
  const glm::vec2 corner = glm::floor(texel - 0.5F);
  const glm::vec2 fraction = texel - 0.5F - corner;
  const auto x = static_cast<std::int64_t>(corner.x);
  const auto y = static_cast<std::int64_t>(corner.y);
  return glm::mix(glm::mix(fetch(x, y), fetch(x + 1, y), fraction.x),
                  glm::mix(fetch(x, y + 1), fetch(x + 1, y + 1), fraction.x), fraction.y);
}

}  // namespace walr::render
