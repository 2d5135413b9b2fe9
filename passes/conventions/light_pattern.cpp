#include "passes/conventions/light_pattern.h"

#include <stdexcept>
#include <string>

namespace walr {

fg::Extent LightPattern::lightingExtent(fg::Extent image) const {
  return {(image.width + columns - 1) / columns, (image.height + rows - 1) / rows};
}

glm::ivec2 LightPattern::pixelOf(glm::ivec2 texel, glm::ivec2 offset) const {
  const glm::ivec2 size(columns, rows);
  if (rows == 1) offset.x = (offset.x + texel.y) % size.x;
  return texel * size + offset;
}

void checkLightPattern(const LightPattern& pattern) {
  const auto inRange = [](std::uint32_t side) { return side >= 1 && side <= kMostPerLightTexel; };
  if (inRange(pattern.columns) && inRange(pattern.rows)) return;
  throw std::invalid_argument("a texel of light for " + std::to_string(pattern.columns) + " x " +
                              std::to_string(pattern.rows) + " pixels: both must be 1 to " +
                              std::to_string(kMostPerLightTexel));
}

void checkLightOffset(const LightPattern& pattern, glm::ivec2 offset) {
  const glm::ivec2 size(pattern.columns, pattern.rows);
  if (offset.x >= 0 && offset.y >= 0 && offset.x < size.x && offset.y < size.y) return;
  throw std::invalid_argument("a light offset of (" + std::to_string(offset.x) + ", " + std::to_string(offset.y) +
                              ") pixels: it must lie in the group of " + std::to_string(size.x) + " x " +
                              std::to_string(size.y) + " pixels that a texel of light stands for");
}

glm::ivec2 lightOffsetOfFrame(const LightPattern& pattern, std::uint32_t frame) {
  const std::uint32_t x = frame % pattern.columns;
  return {x, (frame / pattern.columns + x) % pattern.rows};
}

void specializeLight(fg::PassBuilder& pass, const LightPattern& pattern) {
  pass.specialize("kLightColumns", pattern.columns)
      .specialize("kLightRows", pattern.rows)
      .specialize("kLightMasked", pattern.hasAlpha())
      .specialize("kLightCounted", pattern.counted);
}

}  // namespace walr
