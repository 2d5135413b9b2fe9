#pragma once

#include <cstdint>
#include <vector>

#include "tests/passes/reference/atrous.h"

/// Conversion between numbers and the texels of the passes' textures, written from the documented formats and packings.
namespace walr::test {

/// RGBA16F. Values must be exact as halves, or not finite.
std::vector<std::uint16_t> encodeHalves(const reference::Image<glm::dvec3>& image);
/// The lighting of a frame, which may be sparse: texels that belong to no pixel are NaN.
std::vector<std::uint16_t> encodeLighting(const reference::HostFrame& frame);
/// R8_UNORM.
std::vector<std::uint8_t> encodeRoughness(const reference::HostFrame& frame);
reference::Image<glm::dvec4> decodeHalves(const std::vector<std::uint16_t>& texels, glm::ivec2 size);

/// Packed light (packed_light.glsl). Alpha is the history length of accumulated light; for filtered light 1, or -1
/// where there is no surface; and the history length of resolved light, at most `longest`.
reference::Image<glm::dvec4> decodeAccumulated(const std::vector<std::uint32_t>& texels, glm::ivec2 size);
/// The same on the light grid of a frame with sparse light; 0 at pixels without a texel.
reference::Image<glm::dvec4> decodeLightGrid(const std::vector<std::uint32_t>& texels,
                                             const reference::HostFrame& frame);
reference::Image<glm::dvec4> decodeFiltered(const std::vector<std::uint32_t>& texels, glm::ivec2 size);
reference::Image<glm::dvec4> decodeResolved(const std::vector<std::uint32_t>& texels, double longest, glm::ivec2 size);

/// R32F.
std::vector<float> encodeFloats(const reference::Image<double>& image);

/// Split a packed view depth into the depth and the edge distance.
double decodeDepth(std::uint32_t packed);
int decodeEdgeDistance(std::uint32_t packed);
/// Two 16-bit unorms.
glm::dvec2 decodeUnorms(std::uint32_t packed);
/// A depth and a geometric normal that share 32 bits. `depth` must be exact in this form.
double decodeDepthBesideNormal(std::uint32_t packed);
glm::dvec3 decodeShortNormal(std::uint32_t packed);
std::uint32_t encodeDepthNormal(double depth, glm::dvec3 normal);

/// The R32_UINT texels of guides; those that a test does not need are empty. With `features`, `depth` also holds the
/// geometric normal.
struct GuideTexels {
  std::vector<std::uint32_t> depth;
  std::vector<std::uint32_t> shadingNormal = {};
  std::vector<std::uint32_t> features = {};
  std::vector<std::uint32_t> geometricNormal = {};
};
reference::Image<reference::Guide> decodeGuides(const GuideTexels& texels, glm::ivec2 size);

/// Centred moments from the texels of a storage's textures. Raw storage has no second moment of luminance; its W is 1,
/// or 0 where a feature mean of 0 marks a pixel without a sample.
reference::Image<reference::Moments> decodeMoments(MomentStorage storage,
                                                   const std::vector<std::vector<std::uint32_t>>& textures,
                                                   glm::ivec2 size);

}  // namespace walr::test
