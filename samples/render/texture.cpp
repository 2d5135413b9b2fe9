#include "samples/render/texture.h"

#include <array>
#include <cmath>

#include "samples/render/exact/texel.h"

namespace walr::render {
namespace {

using ByteTable = std::array<float, 256>;

ByteTable makeTable(ColorSpace space) {
  ByteTable table{};
  for (std::uint32_t i = 0; i < table.size(); ++i) table.at(i) = valueOfByte(i, space);
  return table;
}

static_assert(static_cast<std::uint32_t>(Wrap::Repeat) == exact::kRepeat);
static_assert(static_cast<std::uint32_t>(Wrap::ClampToEdge) == exact::kClampToEdge);
static_assert(static_cast<std::uint32_t>(Wrap::MirroredRepeat) == exact::kMirroredRepeat);

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

  const auto neighbors = [&](float coordinate, std::uint32_t size, Wrap wrap) {
    return exact::neighborsOf(coordinate, size, static_cast<std::uint32_t>(wrap), texture.nearest);
  };
  const exact::Neighbors x = neighbors(uv.x, image.width, texture.wrapU);
  const exact::Neighbors y = neighbors(uv.y, image.height, texture.wrapV);
  const auto fetch = [&](std::uint32_t column, std::uint32_t row) {
    const std::uint8_t* texel = &image.rgba[(static_cast<std::size_t>(row) * image.width + column) * 4];
    return glm::vec4(color[texel[0]], color[texel[1]], color[texel[2]], linear[texel[3]]);
  };
  return exact::blend(exact::blend(fetch(x.first, y.first), fetch(x.second, y.first), x.fraction),
                      exact::blend(fetch(x.first, y.second), fetch(x.second, y.second), x.fraction), y.fraction);
}

}  // namespace walr::render
