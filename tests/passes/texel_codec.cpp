#include "tests/passes/texel_codec.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/gtc/packing.hpp>

#include "tests/passes/reference/octahedral.h"

namespace walr::test {
namespace {

using reference::MomentValues;

constexpr std::uint32_t kEdgeDistanceMask = 31;

double half(std::uint32_t word, int index) {
  return double(glm::unpackHalf1x16(static_cast<std::uint16_t>(word >> (16 * index))));
}

/// Decode an unsigned float with a 5-bit exponent.
double unsignedFloat(std::uint32_t bits, int mantissaBits) {
  const int exponent = static_cast<int>(bits >> mantissaBits);
  const int mantissa = static_cast<int>(bits & ((1U << mantissaBits) - 1U));
  const int implied = exponent == 0 ? 0 : 1 << mantissaBits;
  return std::ldexp(double(mantissa + implied), std::max(exponent, 1) - 15 - mantissaBits);
}

/// Decode R11G11B10.
glm::dvec3 triple(std::uint32_t word) {
  return {unsignedFloat(word & 0x7ffU, 6), unsignedFloat((word >> 11U) & 0x7ffU, 6), unsignedFloat(word >> 22U, 5)};
}

/// Decode three mantissas under a shared exponent.
glm::dvec3 sharedExponent(std::uint32_t word, int mantissaBits) {
  const std::uint32_t mask = (1U << mantissaBits) - 1U;
  const int exponent = static_cast<int>(word >> (3 * mantissaBits)) & 31;
  const auto channel = [&](int i) {
    return std::ldexp(double((word >> (i * mantissaBits)) & mask), exponent - 15 - mantissaBits);
  };
  return {channel(0), channel(1), channel(2)};
}

/// Decode the six bits of a history length after accumulation: halves up to 7.5, then eight steps an octave.
double decodeCount(std::uint32_t code) {
  if (code < 8) return 0.5 * code;
  return std::ldexp(double(8 + code % 8), static_cast<int>(code / 8) - 2);
}

/// Decode the three bits of a history length of anti-aliasing: 0, powers of two to 32, and the longest.
double decodeLength(std::uint32_t code, double longest) {
  if (code == 0) return 0.0;
  return code == 7 ? longest : std::min(std::ldexp(1.0, static_cast<int>(code) - 1), longest);
}

template <typename Decode>
reference::Image<glm::dvec4> decodeWords(const std::vector<std::uint32_t>& texels, glm::ivec2 size, Decode decode) {
  reference::Image<glm::dvec4> image(size);
  for (std::size_t i = 0; i < texels.size(); ++i) image.pixels()[i] = decode(texels[i]);
  return image;
}

/// The words of one pixel, texture after texture.
using Words = std::vector<std::uint32_t>;

MomentValues halvesInOrder(const Words& words, int count) {
  MomentValues values{};
  for (int k = 0; k < count; ++k) values[k] = half(words[k / 2], k % 2);
  return values;
}

reference::Moments decodeCentred16(const Words& words) {
  MomentValues values = halvesInOrder(words, reference::kMomentCount);
  values[14] *= values[14];  // Stored as its root.
  return reference::fromArray(values);
}

/// Raw halves and floats store u, v, uu, uv, vv, Y, YX_u, YX_v in this order.
reference::Moments fromRawOrder(const MomentValues& v) {
  return reference::toCentred({.x = {v[0], v[1]},
                               .y = {v[5], v[6], v[7]},
                               .xx = {v[2], v[3], v[4]},
                               .yu = {v[8], v[9], v[10]},
                               .yv = {v[11], v[12], v[13]},
                               .samples = 1.0});
}

reference::Moments decodeRaw32(const Words& words) {
  MomentValues values{};
  for (int k = 0; k < 14; ++k) values[k] = double(std::bit_cast<float>(words[k]));
  return fromRawOrder(values);
}

reference::Moments decodeRaw11(const Words& words) {
  return reference::toCentred({.x = glm::dvec2(triple(words[4])),
                               .y = triple(words[0]),
                               .xx = triple(words[3]),
                               .yu = triple(words[1]),
                               .yv = triple(words[2]),
                               .samples = 1.0});
}

reference::Moments decodePixel(MomentStorage storage, const Words& words) {
  switch (storage) {
    case MomentStorage::Centred16:
      return decodeCentred16(words);
    case MomentStorage::Raw16:
      return fromRawOrder(halvesInOrder(words, 14));
    case MomentStorage::Raw11:
      return decodeRaw11(words);
    case MomentStorage::Raw32:
      return decodeRaw32(words);
  }
  return {};
}

}  // namespace

std::vector<std::uint16_t> encodeHalves(const reference::Image<glm::dvec3>& image) {
  std::vector<std::uint16_t> texels;
  texels.reserve(image.pixels().size() * 4);
  for (const glm::dvec3& pixel : image.pixels()) {
    for (int c = 0; c < 3; ++c) texels.push_back(glm::packHalf1x16(static_cast<float>(pixel[c])));
    texels.push_back(0);
  }
  return texels;
}

std::vector<std::uint8_t> encodeRoughness(const reference::HostFrame& frame) {
  std::vector<std::uint8_t> texels;
  for (const double r : frame.roughness.pixels()) texels.push_back(static_cast<std::uint8_t>(std::lround(255.0 * r)));
  return texels;
}

std::vector<std::uint16_t> encodeLighting(const reference::HostFrame& frame) {
  const LightPattern& light = frame.conventions.light;
  if (light.everyPixel() && !frame.conventions.specular) return encodeHalves(frame.lighting);
  const auto texelsAlong = [](int pixels, std::uint32_t each) {
    return static_cast<std::size_t>(std::ceil(double(pixels) / each));
  };
  const std::size_t columns = texelsAlong(frame.size().x, light.columns);
  const std::size_t rows = texelsAlong(frame.size().y, light.rows);
  constexpr std::uint16_t kNaN = 0x7fff;
  std::vector<std::uint16_t> texels(4 * columns * rows, kNaN);
  reference::forEachPixel(frame.size(), [&](glm::ivec2 p) {
    if (!reference::hasLightTexel(frame, p)) return;
    const double alpha = frame.lightAlpha.pixels().empty() ? 1.0 : frame.lightAlpha[p];
    const glm::vec4 texel(glm::vec3(frame.lighting[p]), static_cast<float>(alpha));
    const std::size_t at = (p.y / light.rows) * columns + p.x / light.columns;
    for (int c = 0; c < 4; ++c) texels[4 * at + static_cast<std::size_t>(c)] = glm::packHalf1x16(texel[c]);
  });
  return texels;
}

reference::Image<glm::dvec4> decodeHalves(const std::vector<std::uint16_t>& texels, glm::ivec2 size) {
  reference::Image<glm::dvec4> image(size);
  for (std::size_t i = 0; i < texels.size(); ++i)
    image.pixels()[i / 4][static_cast<int>(i % 4)] = double(glm::unpackHalf1x16(texels[i]));
  return image;
}

reference::Image<glm::dvec4> decodeAccumulated(const std::vector<std::uint32_t>& texels, glm::ivec2 size) {
  return decodeWords(texels, size, [](std::uint32_t word) {
    return glm::dvec4(sharedExponent(word, reference::kAccumulatedBits), decodeCount(word >> 26U));
  });
}

reference::Image<glm::dvec4> decodeLightGrid(const std::vector<std::uint32_t>& texels,
                                             const reference::HostFrame& frame) {
  const LightPattern& light = frame.conventions.light;
  const fg::Extent extent =
      light.lightingExtent({static_cast<std::uint32_t>(frame.size().x), static_cast<std::uint32_t>(frame.size().y)});
  const reference::Image<glm::dvec4> means =
      decodeAccumulated(texels, {static_cast<int>(extent.width), static_cast<int>(extent.height)});
  reference::Image<glm::dvec4> image(frame.size());
  reference::forEachPixel(means.size(), [&](glm::ivec2 texel) {
    const glm::ivec2 p = light.pixelOf(texel, frame.constants.lightOffset);
    if (image.contains(p)) image[p] = means[texel];
  });
  return image;
}

reference::Image<glm::dvec4> decodeFiltered(const std::vector<std::uint32_t>& texels, glm::ivec2 size) {
  constexpr std::uint32_t kNoSurface = 1U << 27U;
  return decodeWords(texels, size, [](std::uint32_t word) {
    return glm::dvec4(sharedExponent(word, reference::kFilteredBits), word == kNoSurface ? -1.0 : 1.0);
  });
}

reference::Image<glm::dvec4> decodeResolved(const std::vector<std::uint32_t>& texels, double longest, glm::ivec2 size) {
  return decodeWords(texels, size, [longest](std::uint32_t word) {
    return glm::dvec4(sharedExponent(word, reference::kResolvedBits), decodeLength(word >> 29U, longest));
  });
}

std::vector<float> encodeFloats(const reference::Image<double>& image) {
  return {image.pixels().begin(), image.pixels().end()};
}

double decodeDepth(std::uint32_t packed) {
  return double(std::bit_cast<float>(packed & ~kEdgeDistanceMask));
}

double decodeDepthBesideNormal(std::uint32_t packed) {
  constexpr std::uint32_t kShortNormalMask = 0xfffU;
  return double(std::bit_cast<float>(packed & ~kShortNormalMask));
}

int decodeEdgeDistance(std::uint32_t packed) {
  return static_cast<int>(packed & kEdgeDistanceMask);
}

glm::dvec2 decodeUnorms(std::uint32_t packed) {
  return {(packed & 0xffffU) * reference::kUnorm16Step, (packed >> 16U) * reference::kUnorm16Step};
}

glm::dvec3 decodeShortNormal(std::uint32_t packed) {
  const glm::dvec2 steps(packed & 0x3fU, (packed >> 6U) & 0x3fU);
  return reference::stereographicDecode(steps * reference::kShortNormalStep - reference::kShortNormalEnd);
}

std::uint32_t encodeDepthNormal(double depth, glm::dvec3 normal) {
  const glm::dvec2 point = reference::stereographicEncode(reference::roundToShortNormal(normal));
  const glm::dvec2 steps = glm::round((point + reference::kShortNormalEnd) / reference::kShortNormalStep);
  return std::bit_cast<std::uint32_t>(static_cast<float>(depth)) | static_cast<std::uint32_t>(steps.x) |
         (static_cast<std::uint32_t>(steps.y) << 6U);
}

reference::Image<reference::Guide> decodeGuides(const GuideTexels& texels, glm::ivec2 size) {
  reference::Image<reference::Guide> guides(size);
  for (std::size_t i = 0; i < texels.depth.size(); ++i) {
    reference::Guide& guide = guides.pixels()[i];
    const bool besideNormal = !texels.features.empty();
    guide.depth = besideNormal ? decodeDepthBesideNormal(texels.depth[i]) : decodeDepth(texels.depth[i]);
    if (guide.depth == 0.0) continue;
    if (besideNormal) guide.normal = decodeShortNormal(texels.depth[i]);
    if (!texels.shadingNormal.empty()) guide.features = decodeUnorms(texels.shadingNormal[i]);
    if (!texels.features.empty()) {
      const std::uint32_t packed = texels.features[i];
      guide.features = glm::dvec2(packed & 0xfffU, (packed >> 12U) & 0xfffU) * reference::kUnorm12Step;
      guide.occlusion = (packed >> 24U) * reference::kUnorm8Step;
    }
    if (!texels.geometricNormal.empty())
      guide.normal = reference::octahedralDecode(decodeUnorms(texels.geometricNormal[i]));
  }
  return guides;
}

reference::Image<reference::Moments> decodeMoments(MomentStorage storage,
                                                   const std::vector<std::vector<std::uint32_t>>& textures,
                                                   glm::ivec2 size) {
  reference::Image<reference::Moments> moments(size);
  const std::size_t count = moments.pixels().size();
  for (std::size_t i = 0; i < count; ++i) {
    Words words;
    for (const std::vector<std::uint32_t>& texture : textures) {
      const std::size_t perPixel = texture.size() / count;
      for (std::size_t w = 0; w < perPixel; ++w) words.push_back(texture[i * perPixel + w]);
    }
    reference::Moments& m = moments.pixels()[i];
    m = decodePixel(storage, words);
    if (m.x == glm::dvec2(0.0)) m = {};
  }
  return moments;
}

}  // namespace walr::test
