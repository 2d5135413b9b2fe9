// Where a texture is sampled, to the same bits in both path tracers. See arithmetic.h for why and how.
#ifndef WALR_RENDER_EXACT_TEXEL_H
#define WALR_RENDER_EXACT_TEXEL_H
#include "samples/render/exact/arithmetic.h"
#ifdef __cplusplus
namespace walr::render::exact {
#endif

// Values of `render::Wrap`.
WALR_EXACT_CONSTANT uint kRepeat = 0u;
WALR_EXACT_CONSTANT uint kClampToEdge = 1u;
WALR_EXACT_CONSTANT uint kMirroredRepeat = 2u;

// Two neighbouring texels along one axis.
struct Neighbors {
  uint first;
  uint second;
  float fraction;  // Weight of `second`.
};

// A texture coordinate in 0..1. One that is not finite, and one from 2^24 on, which has no fractional part, counts as
// 0.
WALR_EXACT float wrapped(float coordinate, uint wrap) {
  const float place = abs(coordinate) < 16777216.0f ? coordinate : 0.0f;
  if (wrap == kRepeat) return place - floor(place);
  if (wrap == kClampToEdge) return min(max(place, 0.0f), 1.0f);
  const float folded = place - 2.0f * floor(0.5f * place);
  return folded <= 1.0f ? folded : 2.0f - folded;
}

WALR_EXACT Neighbors neighborsOf(float coordinate, uint size, uint wrap, bool nearest) {
  const uint last = size - 1u;
  const float texel = wrapped(coordinate, wrap) * float(size);
  Neighbors result;
  if (nearest) {
    result.first = min(uint(texel), last);
    result.second = result.first;
    result.fraction = 0.0f;
    return result;
  }
  // Before the centre of the first texel, its neighbour is the last texel (repeat) or the first one itself.
  const float corner = floor(texel - 0.5f);
  const uint beyond = wrap == kRepeat ? 0u : last;
  const bool before = corner < 0.0f;
  result.first = before ? last - beyond : min(uint(corner), last);
  result.second = before ? 0u : (result.first == last ? beyond : result.first + 1u);
  result.fraction = texel - 0.5f - corner;
  return result;
}

#ifdef __cplusplus
}  // namespace walr::render::exact
#endif
#endif
