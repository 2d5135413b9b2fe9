#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

#include "framegraph/declare/graph.h"

namespace walr {

/// Which pixels of a frame have a sample of light. Guides are always given for all pixels.
///
/// Pixels form groups of `columns` x `rows`, from the upper left corner of the image. A group has one texel of the
/// lighting, which is the sample of one of its pixels: the one at `FrameDescription::lightOffset` in the group. If
/// groups have one row, the offset in x moves on by one pixel, modulo `columns`, with every row of the image: groups of
/// 2 x 1 make a checkerboard. Where that pixel lies outside the image, the texel is not read.
struct LightPattern {
  std::uint32_t columns = 1;  ///< 1 to `kMostPerLightTexel`.
  std::uint32_t rows = 1;     ///< 1 to `kMostPerLightTexel`.
  /// Any texel may be without a sample: one whose alpha is not above 0. Its colour does not matter, not even NaN.
  bool masked = false;
  /// The same, and an alpha above 0 is the number of samples whose mean the texel's colour is; fractions are allowed.
  /// Accumulation weighs the texel by it (shaders/temporal/sample_counts.glsl), but by no more than
  /// `kMostAccumulatedSamples` / `accumulation.max-history`.
  bool counted = false;

  /// Whether groups are single pixels, so that the lighting has the extent of the image.
  [[nodiscard]] bool fullSize() const { return columns == 1 && rows == 1; }
  /// Whether every pixel has a sample.
  [[nodiscard]] bool everyPixel() const { return fullSize() && !hasAlpha(); }
  /// Whether the alpha of the lighting is read.
  [[nodiscard]] bool hasAlpha() const { return masked || counted; }
  /// Whether the sampled pixels form a rectangular grid: groups with one row only are shifted from row to row.
  [[nodiscard]] bool grid() const { return rows > 1; }
  /// Extent of the lighting of an image.
  [[nodiscard]] fg::Extent lightingExtent(fg::Extent image) const;
  /// The pixel that has the sample of a texel; it may lie outside the image.
  /// @param offset `FrameDescription::lightOffset`
  [[nodiscard]] glm::ivec2 pixelOf(glm::ivec2 texel, glm::ivec2 offset) const;

  /// The texel of a pixel's group.
  [[nodiscard]] glm::ivec2 texelOf(glm::ivec2 pixel) const { return pixel / glm::ivec2(columns, rows); }
  /// Whether a pixel is the one in its group that has the sample.
  [[nodiscard]] bool hasSample(glm::ivec2 pixel, glm::ivec2 offset) const {
    return pixelOf(texelOf(pixel), offset) == pixel;
  }

  friend bool operator==(const LightPattern&, const LightPattern&) = default;
};

/// Largest side of a group: larger ones were not measured.
inline constexpr std::uint32_t kMostPerLightTexel = 3;

/// @throws std::invalid_argument naming a side of the groups that is out of range
void checkLightPattern(const LightPattern& pattern);

/// @throws std::invalid_argument if the offset does not lie in a group
void checkLightOffset(const LightPattern& pattern, glm::ivec2 offset);

/// Offsets that visit every pixel of a group once in as many frames.
glm::ivec2 lightOffsetOfFrame(const LightPattern& pattern, std::uint32_t frame);

/// Specialize a shader with light_sample.glsl.
void specializeLight(fg::PassBuilder& pass, const LightPattern& pattern);

}  // namespace walr
