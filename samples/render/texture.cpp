#include "samples/render/texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>

namespace walr::render {
namespace {

using ByteTable = std::array<float, 256>;

ByteTable makeTable(ColorSpace space) {
  ByteTable table{};
  for (std::uint32_t i = 0; i < table.size(); ++i) table.at(i) = valueOfByte(i, space);
  return table;
}

// Two neighbouring texels along one axis, and the weight of the second.
struct Neighbors {
  std::size_t first = 0;
  std::size_t second = 0;
  float fraction = 0.0F;
};

Neighbors findNeighbors(float coordinate, std::uint32_t size, const Texture& texture, Wrap wrap) {
  // A float from 2^24 on has no fractional part.
  constexpr float kLargestCoordinate = 16777216.0F;
  float place = std::abs(coordinate) < kLargestCoordinate ? coordinate : 0.0F;
  if (wrap == Wrap::Repeat) {
    place -= std::floor(place);
  } else if (wrap == Wrap::MirroredRepeat) {
    const float folded = place - 2.0F * std::floor(0.5F * place);
    place = folded <= 1.0F ? folded : 2.0F - folded;
  } else {
    place = glm::clamp(place, 0.0F, 1.0F);
  }
  const std::size_t last = size - 1;
  const float texel = place * static_cast<float>(size);
  if (texture.nearest) {
    const std::size_t index = std::min(static_cast<std::size_t>(texel), last);
    return {index, index, 0.0F};
  }
  // Before the centre of the first texel, its neighbour is the last texel (repeat) or the first one itself.
  const float corner = std::floor(texel - 0.5F);
  const bool before = corner < 0.0F;
  const std::size_t beyond = wrap == Wrap::Repeat ? 0 : last;
  Neighbors result;
  result.first = before ? last - beyond : std::min(static_cast<std::size_t>(corner), last);
  result.second = before ? 0 : (result.first == last ? beyond : result.first + 1);
  result.fraction = texel - 0.5F - corner;
  return result;
}

}  // namespace

float valueOfByte(std::uint32_t byte, ColorSpace space) {
  const float encoded = static_cast<float>(byte) / 255.0F;
  if (space == ColorSpace::Linear) return encoded;
  // IEC 61966-2-1.
  return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

glm::vec4 sampleTexture(const Image& image, const Texture& texture, glm::vec2 uv, ColorSpace space) {
  static const ByteTable srgb = makeTable(ColorSpace::Srgb);
  static const ByteTable linear = makeTable(ColorSpace::Linear);
  const ByteTable& color = space == ColorSpace::Srgb ? srgb : linear;

  const Neighbors x = findNeighbors(uv.x, image.width, texture, texture.wrapU);
  const Neighbors y = findNeighbors(uv.y, image.height, texture, texture.wrapV);
  const auto fetch = [&](std::size_t column, std::size_t row) {
    const std::uint8_t* texel = &image.rgba[(row * image.width + column) * 4];
    return glm::vec4(color[texel[0]], color[texel[1]], color[texel[2]], linear[texel[3]]);
  };
  return glm::mix(glm::mix(fetch(x.first, y.first), fetch(x.second, y.first), x.fraction),
                  glm::mix(fetch(x.first, y.second), fetch(x.second, y.second), x.fraction), y.fraction);
}

}  // namespace walr::render
