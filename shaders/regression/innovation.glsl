// The innovation of a pixel is the luminance of this frame's light minus that of its history. If the length of the
// history suits the noise, innovations of successive frames are uncorrelated (Mehra 1970). A positive correlation means
// that the history is too long: the light changes, or reprojection blurs its detail.
// Needs: `frame` (FrameConstants).
#ifndef WALR_INNOVATION_GLSL
#define WALR_INNOVATION_GLSL
#include "conventions/camera.glsl"
#include "common/gather_bilinear.glsl"
#include "common/half.glsl"

uniform sampler2D previousInnovation;
layout(r16f) uniform writeonly image2D outInnovation;
layout(rgba32f) uniform writeonly image2D outInnovationSums;  // zw: farProduct (accumulated_share.glsl).

// Of the surface at position `before` in the previous camera's view space, bilinear; 0 outside the image.
float previousInnovationAt(vec3 before) {
  if (before.z >= 0.0) return 0.0;
  const vec2 position = pixelOf(frame.previousRayFromPixel, before) * frame.previousPixelFromPixel - 0.5;
  const ivec2 last = textureSize(previousInnovation, 0) - 1;
  if (any(lessThan(position, vec2(0.0))) || any(greaterThanEqual(position, vec2(last)))) return 0.0;
  const vec2 base = floor(position);
  return gatherBilinear(previousInnovation, base, position - base);
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
