// BMFR, the fit (Koskela et al. 2019, 3.3 and 3.4): one work group fits the colours of a block of 32 x 32 pixels as a
// linear combination of ten features, by Householder QR with three right-hand sides, and writes the fitted colours.
// VIEW: does the same work and writes one of its intermediate values instead of the result.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#include "regression/bmfr_fit.h"
#include "conventions/frame.h"
#include "conventions/camera.glsl"
#include "common/hash.glsl"
#include "stage/pass_through.glsl"
#include "conventions/surface.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(constant_id = 0) const bool kAlphaIsSampleCount = false;
#include "conventions/sampled_light.glsl"

layout(std140) uniform frameConstants { FrameConstants frame; };
uniform texture2D lighting;
uniform utexture2D depth;
uniform utexture2D shadingNormal;
#ifdef VIEW
layout(rgba32f) uniform writeonly image2D outView;
#else
layout(rgba16f) uniform writeonly image2D outFitted;
#endif
layout(push_constant) uniform PushConstants {
  BmfrFitConstants constants;
#ifdef VIEW
  uint view;  // Which quantity; numbered in viewOf.
#endif
};

const uint kThreads = 256u;
const int kRowsPerThread = 4;
const int kFeatures = 10;  // 1, normal (3), position (3), position squared (3).
const int kColumns = 13;   // Features, then red, green, blue.

uint threadIndex = gl_LocalInvocationIndex;
#include "regression/householder.glsl"

// Displacements of the block grid, one for each of 16 frames, spread uniformly (Koskela et al. 2019, 6.1).
const ivec2 kBlockOffsets[16] = ivec2[16](
    ivec2(-14, -14), ivec2(4, -6), ivec2(-8, 14), ivec2(8, 0), ivec2(-10, -8), ivec2(2, 12), ivec2(12, -12),
    ivec2(-10, 0), ivec2(12, 14), ivec2(-8, -16), ivec2(6, 6), ivec2(-2, -2), ivec2(6, -14), ivec2(-16, 12),
    ivec2(14, -4), ivec2(-6, 4));

// The coordinate mirrored at the borders of the image as often as needed. In floats, which hold these numbers exactly:
// GPUs divide integers slowly. The half keeps the quotient away from integers.
int mirrored(int x, int size) {
  const float period = 2.0 * float(size);
  const int m = int(float(x) - period * floor((float(x) + 0.5) / period));
  return min(m, 2 * size - 1 - m);
}

// Position in the block of row `s` of this thread. The rows of a thread are pixels above each other.
ivec2 placeOf(int s) {
  const uvec2 first = uvec2(threadIndex % uint(kBmfrBlockSize), threadIndex / uint(kBmfrBlockSize));
  return ivec2(first) + ivec2(0, s * int(kThreads) / kBmfrBlockSize);
}

// One pixel of the block.
struct Pixel {
  ivec2 p;        // Position before mirroring.
  bool surface;   // There is something to denoise.
  vec3 normal;    // Shading normal.
  vec3 position;  // Relative to the camera, along the world's axes: small even far from the world's origin.
  vec3 colour;
  bool sampled;   // The colour is a sample.
};

Pixel readPixel(int s) {
  const ivec2 size = textureSize(depth, 0);
  const ivec2 offset = kBlockOffsets[frame.frameIndex % 16u] - kBmfrBlockSize / 2;
  const ivec2 block = ivec2(gl_WorkGroupID.xy) * kBmfrBlockSize + offset;
  Pixel pixel;
  pixel.p = block + placeOf(s);
  const ivec2 q = ivec2(mirrored(pixel.p.x, size.x), mirrored(pixel.p.y, size.y));
  const float z = unpackDepth(texelFetch(depth, q, 0).x);
  const mat3 worldFromView = transpose(mat3(frame.viewFromWorld));
  pixel.surface = z > 0.0;
  pixel.normal = worldFromView * unpackLongNormal(texelFetch(shadingNormal, q, 0).x);
  pixel.position = worldFromView * (rayThrough(frame.rayFromPixel, pixelCentre(q)) * z);
  const vec4 sampleHere = texelFetch(lighting, q, 0);
  pixel.colour = sampleHere.rgb;
  pixel.sampled = isSampled(sampleHere);
  return pixel;
}

// The block's bounding box, by which each axis of the positions is scaled to [-1, 1].
struct Bounds {
  vec3 centre;
  vec3 scale;
};

Bounds blockBounds(Pixel pixels[kRowsPerThread]) {
  const float kFar = 3.0e38, kNear = 1.0e-30;
  const int kFirst = kColumns - 6;
  [[unroll]] for (int axis = 0; axis < 3; ++axis) {
    float largest = -kFar, largestNegated = -kFar;
    [[unroll]] for (int s = 0; s < kRowsPerThread; ++s) {
      if (!pixels[s].surface) continue;
      largest = max(largest, pixels[s].position[axis]);
      largestNegated = max(largestNegated, -pixels[s].position[axis]);
    }
    partialSums[kFirst + axis][threadIndex] = largest;
    partialSums[kFirst + 3 + axis][threadIndex] = largestNegated;
  }
  reduceColumns(kFirst, true);
  const vec3 highest = vec3(totals[kFirst], totals[kFirst + 1], totals[kFirst + 2]);
  const vec3 lowest = -vec3(totals[kFirst + 3], totals[kFirst + 4], totals[kFirst + 5]);
  const vec3 halfExtent = 0.5 * (highest - lowest);
  // An axis along which the block hardly extends holds only rounding errors, which must not be scaled up to a feature.
  const float least = max(constants.extentFloor * max(max(halfExtent.x, halfExtent.y), halfExtent.z), kNear);
  return Bounds(0.5 * (highest + lowest), 1.0 / max(halfExtent, vec3(least)));
}

// The multi-order features (Koskela et al. 2019, equation 8), each within [-1, 1]. Positions are relative to the
// block's centre: with the lower orders, their squares span the same functions as squares of world positions, without
// cancellation.
float[kFeatures] featuresOf(Pixel pixel, Bounds bounds) {
  const vec3 w = (pixel.position - bounds.centre) * bounds.scale;
  const vec3 n = pixel.normal;
  return float[kFeatures](1.0, n.x, n.y, n.z, w.x, w.y, w.z, w.x * w.x, w.y * w.y, w.z * w.z);
}

// Uniform in [-1, 1] for every feature of a pixel.
float[kFeatures] noiseOf(uint index) {
  const uvec2 key = uvec2(gl_WorkGroupID.y << 16 | gl_WorkGroupID.x, frame.frameIndex);
  float noise[kFeatures];
  noise[0] = 0.0;
  [[unroll]] for (int i = 0; i < 3; ++i) {
    const vec4 random = vec4(pcg4d(uvec4(index, key, i))) * (2.0 / 4294967295.0) - 1.0;
    [[unroll]] for (int c = 0; c < 4; ++c)
      if (1 + 4 * i + c < kFeatures) noise[1 + 4 * i + c] = random[c];
  }
  return noise;
}

// A pixel without a surface or without a finite sample becomes a row of zeros, which does not change the fit.
float[kColumns] rowOf(Pixel pixel, uint index, Bounds bounds) {
  float row[kColumns];
  [[unroll]] for (int j = 0; j < kColumns; ++j) row[j] = 0.0;
  if (!pixel.surface || !pixel.sampled) return row;
  const float features[kFeatures] = featuresOf(pixel, bounds);
  const float noise[kFeatures] = noiseOf(index);
  [[unroll]] for (int j = 0; j < kFeatures; ++j) row[j] = features[j] + constants.noiseAmplitude * noise[j];
  const vec3 colour = clampedRadiance(pixel.colour);
  [[unroll]] for (int c = 0; c < 3; ++c) row[kFeatures + c] = colour[c];
  return row;
}

float rowsInUse(float rows[kRowsPerThread][kColumns]) {
  float sum = 0.0;
  [[unroll]] for (int s = 0; s < kRowsPerThread; ++s) sum += rows[s][0];
  partialSums[kColumns - 1][threadIndex] = sum;
  reduceColumns(kColumns - 1, false);
  return totals[kColumns - 1];
}

// The synthesis uses the features without noise (Koskela et al. 2019, 3.4).
vec3 synthesis(Pixel pixel, Bounds bounds) {
  const float features[kFeatures] = featuresOf(pixel, bounds);
  vec3 colour = vec3(0.0);
  [[unroll]] for (int j = 0; j < kFeatures; ++j)
    colour += features[j] * vec3(coefficients[j][0], coefficients[j][1], coefficients[j][2]);
  return colour;
}

// A pixel without a surface gets the pass-through.
vec3 fittedColour(Pixel pixel, Bounds bounds) {
  if (!pixel.surface) return passThroughLight(pixel.colour);
  return clampedRadiance(synthesis(pixel, bounds));
}

#ifdef VIEW
// Number of features that the block's fit leaves out because earlier ones explain them.
float featuresLeftOut() {
  float count = 0.0;
  for (int k = 0; k < kFeatures; ++k) count += triangle[k][k] == 0.0 ? 1.0 : 0.0;
  return count;
}

vec3 viewOf(Pixel pixel, Bounds bounds, float samples) {
  if (!pixel.surface) return vec3(0.0);
  const vec3 colour = synthesis(pixel, bounds);
  switch (view) {
    case 0u: return vec3(featuresLeftOut(), samples, featuresLeftOut() > 0.0);
    case 1u: return vec3(notEqual(clampedRadiance(colour), colour));
    case 2u: return vec3(samples == 0.0, !pixel.sampled, !isFinite(colour));
  }
  return vec3(0.0);
}
#endif

void main() {
  Pixel pixels[kRowsPerThread];
  [[unroll]] for (int s = 0; s < kRowsPerThread; ++s) pixels[s] = readPixel(s);
  const Bounds bounds = blockBounds(pixels);

  float rows[kRowsPerThread][kColumns];
  [[unroll]] for (int s = 0; s < kRowsPerThread; ++s)
    rows[s] = rowOf(pixels[s], threadIndex + uint(s) * kThreads, bounds);
  const float samples = rowsInUse(rows);
  solveLeastSquares(rows, samples, constants.rankTolerance);

  [[unroll]] for (int s = 0; s < kRowsPerThread; ++s) {
    const ivec2 p = pixels[s].p;
    if (any(lessThan(p, ivec2(0))) || any(greaterThanEqual(p, textureSize(depth, 0)))) continue;
#ifdef VIEW
    imageStore(outView, p, vec4(viewOf(pixels[s], bounds, samples), 1.0));
#else
    imageStore(outFitted, p, vec4(fittedColour(pixels[s], bounds), 1.0));
#endif
  }
}
