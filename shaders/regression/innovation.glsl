// The innovation of a pixel is the luminance of this frame's light minus that of its history. If the length of the
// history suits the noise, innovations of successive frames are uncorrelated (Mehra 1970). A positive correlation means
// that the history is too long: the light changes, or reprojection blurs its detail.
// Means over quads, 2 x 2 pixels, are stored, in eight bits: the upper half of a half, which errs by an eighth at most.
// Needs: `frame` (FrameConstants).
#ifndef WALR_INNOVATION_GLSL
#define WALR_INNOVATION_GLSL
#include "conventions/camera.glsl"
#include "common/gather_bilinear.glsl"

uniform usampler2D previousInnovation;
layout(r8ui) uniform writeonly uimage2D outInnovation;

const float kLargestInnovation = 57344.0;  // The largest half whose lower bits are 0.

bool isFirstOfQuad(ivec2 p) { return ((p.x | p.y) & 1) == 0; }

// Of the quad whose first pixel showed the position `before` in the previous camera's view space, bilinear; 0 outside the
// image.
float previousInnovationAt(vec3 before) {
  if (before.z >= 0.0) return 0.0;
  const vec2 pixel = pixelOf(frame.previousRayFromPixel, before) * frame.previousPixelFromPixel - 0.5;
  const vec2 quad = 0.5 * pixel, size = vec2(textureSize(previousInnovation, 0));
  if (any(lessThan(quad, vec2(0.0))) || any(greaterThanEqual(quad, size - 1.0))) return 0.0;
  const vec2 base = floor(quad);
  const uvec4 texels = textureGather(previousInnovation, (base + 1.0) / size) << 8;
  return bilinear(vec4(unpackHalf2x16(texels.x | texels.y << 16), unpackHalf2x16(texels.z | texels.w << 16)), quad - base);
}

// Innovations of a quad's pixels.
struct Quad {
  float weight;   // Sum of weights.
  float sum;      // Sum of weight times innovation.
  float squares;  // Sum of weight times its square.
};

void add(inout Quad quad, float weight, float innovation) {
  quad.weight += weight;
  quad.sum += weight * innovation;
  quad.squares += weight * innovation * innovation;
}

float meanInnovation(Quad quad) { return quad.weight > 0.0 ? quad.sum / quad.weight : 0.0; }

// Sums over a quad of the product of its innovation with that of the previous frame, and of the squares of its pixels'.
vec2 innovationTerms(Quad quad, vec3 before) {
  const float previous = previousInnovationAt(before);
  return vec2(quad.sum * previous, previous != 0.0 ? quad.squares : 0.0);
}

// `p`: the first pixel of a quad.
void storeInnovation(ivec2 p, float innovation) {
  const float stored = clamp(innovation, -kLargestInnovation, kLargestInnovation);
  imageStore(outInnovation, p / 2, uvec4(packHalf2x16(vec2(stored, 0.0)) + 0x80u >> 8));
}

#endif
