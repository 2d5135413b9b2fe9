// The innovation of a pixel: this frame's light less its history, as luminance. Where the history has the length that
// suits the noise, innovations of successive frames are not correlated (Mehra 1970): if they are, the last frame should
// have counted for more. That holds for light that changes and for detail that reprojection blurs.
// Needs: `frame` (FrameConstants).
#ifndef WALR_INNOVATION_GLSL
#define WALR_INNOVATION_GLSL
#include "camera.glsl"
#include "half.glsl"

uniform texture2D previousInnovation;
layout(r16f) uniform writeonly image2D outInnovation;
layout(rgba32f) uniform writeonly image2D outInnovationSums;  // zw: farProduct (accumulated_share.glsl).

// Of the surface at position `before` in the previous camera's view space, bilinear; 0 outside the image.
float previousInnovationAt(vec3 before) {
  if (before.z >= 0.0) return 0.0;
  const vec2 position = pixelOf(frame.previousRayFromPixel, before) * frame.previousPixelFromPixel - 0.5;
  const ivec2 last = textureSize(previousInnovation, 0) - 1;
  if (any(lessThan(position, vec2(0.0))) || any(greaterThanEqual(position, vec2(last)))) return 0.0;
  const ivec2 base = ivec2(position);
  const vec2 f = fract(position);
  float sum = 0.0;
  [[unroll]] for (int i = 0; i < 4; ++i) {
    const ivec2 corner = ivec2(i & 1, i >> 1);
    const vec2 weight = mix(1.0 - f, f, vec2(corner));
    sum += weight.x * weight.y * texelFetch(previousInnovation, base + corner, 0).x;
  }
  return sum;
}

// Product of the innovation with that of the previous frame, and the square of the latter.
vec2 innovationTerms(float innovation, vec3 before) {
  const float previous = previousInnovationAt(before);
  return previous * vec2(innovation, previous);
}

void storeInnovation(ivec2 p, float innovation) {
  imageStore(outInnovation, p, vec4(clamp(innovation, -kLargestHalf, kLargestHalf)));
}

#endif
