#pragma once

#include <cstdint>
#include <vector>

#include "tests/passes/reference/atrous.h"

/// Texels of the passes' textures as numbers, from what their formats and packings document.
namespace walr::test {

/// RGBA16F. Values must be representable as halves, or not finite.
std::vector<std::uint16_t> encodeHalves(const reference::Image<glm::dvec3>& image);
reference::Image<glm::dvec4> decodeHalves(const std::vector<std::uint16_t>& texels, glm::ivec2 size);

/// Packed light (packed_light.glsl). Alpha: samples behind it; 1, or -1 where there is no surface; frames behind it, at
/// most `longest`.
reference::Image<glm::dvec4> decodeAccumulated(const std::vector<std::uint32_t>& texels, glm::ivec2 size);
reference::Image<glm::dvec4> decodeFiltered(const std::vector<std::uint32_t>& texels, glm::ivec2 size);
reference::Image<glm::dvec4> decodeResolved(const std::vector<std::uint32_t>& texels, double longest, glm::ivec2 size);

/// R32F.
std::vector<float> encodeFloats(const reference::Image<double>& image);

/// The bits of a packed view depth without those of the edge distance, and the edge distance.
double decodeDepth(std::uint32_t packed);
int decodeEdgeDistance(std::uint32_t packed);
/// Two 16-bit unorms.
glm::dvec2 decodeUnorms(std::uint32_t packed);
/// A normal of R32_UINT or R16_UINT.
glm::dvec3 decodeNormal(std::uint32_t packed);

/// The R32_UINT texels of guides; what is not needed is empty.
struct GuideTexels {
  std::vector<std::uint32_t> depth;
  std::vector<std::uint32_t> shadingNormal = {};
  std::vector<std::uint32_t> features = {};
  std::vector<std::uint32_t> geometricNormal = {};
};
reference::Image<reference::Guide> decodeGuides(const GuideTexels& texels, glm::ivec2 size);

/// Centred moments from the texels of a storage's textures; raw storage has no second luminance moment, and W is 1,
/// or 0 where the features' mean of 0 tells that there is no sample.
reference::Image<reference::Moments> decodeMoments(MomentStorage storage,
                                                   const std::vector<std::vector<std::uint32_t>>& textures,
                                                   glm::ivec2 size);

}  // namespace walr::test
