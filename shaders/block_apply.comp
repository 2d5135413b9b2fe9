// The blocks' fits applied to every pixel's features: those of the four blocks around it, weighed by plane and
// distance, mixed with the coarse fits as their samples count against `coarseSamples`.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "constants/block_regression.h"
#include "constants/frame.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const int kBlockSize = 4;  // Pixels per axis.

layout(set = 0, binding = 0, std140) uniform frameConstants { FrameConstants frame; };
layout(set = 0, binding = 1) uniform utexture2D depth;
layout(set = 0, binding = 2) uniform utexture2D shadingNormal;
layout(set = 0, binding = 3) uniform utexture2D geometricNormal;
layout(set = 0, binding = 4) uniform texture2D occlusion;
layout(set = 0, binding = 5) uniform texture2D accumulated;
layout(set = 0, binding = 6) uniform utexture2D fitA;
layout(set = 0, binding = 7) uniform utexture2D fitB;
layout(set = 0, binding = 8) uniform utexture2D fitC;
layout(set = 0, binding = 9) uniform utexture2D fitDepth;
layout(set = 0, binding = 10) uniform utexture2D fitNormal;
layout(set = 0, binding = 11) uniform utexture2D coarseA;
layout(set = 0, binding = 12) uniform utexture2D coarseB;
layout(set = 0, binding = 13) uniform utexture2D coarseC;
layout(set = 0, binding = 14) uniform utexture2D coarseDepth;
layout(set = 0, binding = 15, rgba16f) uniform writeonly image2D outFiltered;
layout(push_constant) uniform PushConstants { BlockRegressionConstants settings; };
#include "include/block_fit.glsl"
#include "include/block_plane.glsl"
#include "include/half.glsl"
#include "include/light.glsl"
#include "include/plane.glsl"

struct Prediction {
  vec3 colour;    // Weighted sum.
  float samples;  // Weighted sum.
  float weight;
};

void add(inout Prediction sum, float weight, BlockFit fit, float x[kFeatures]) {
  if (weight <= 0.0 || fit.samples <= 0.0) return;
  sum.colour += weight * evaluate(fit, x);
  sum.samples += weight * fit.samples;
  sum.weight += weight;
}

BlockFit loadFine(ivec2 block) {
  return unpackFit(PackedFit(texelFetch(fitA, block, 0), texelFetch(fitB, block, 0), texelFetch(fitC, block, 0)));
}
BlockFit loadCoarse(ivec2 block) {
  return unpackFit(
      PackedFit(texelFetch(coarseA, block, 0), texelFetch(coarseB, block, 0), texelFetch(coarseC, block, 0)));
}

// Where neither knows anything the pixel has only itself.
vec3 mixFits(Prediction fine, Prediction coarse, vec3 mean) {
  if (coarse.weight <= 0.0) return fine.weight > 0.0 ? fine.colour / fine.weight : mean;
  const vec3 wide = coarse.colour / coarse.weight;
  if (fine.weight <= 0.0) return wide;
  const float samples = fine.samples / fine.weight;
  return mix(wide, fine.colour / fine.weight, samples / (samples + settings.coarseSamples));
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(depth, 0)))) return;
  const float z = unpackDepth(texelFetch(depth, p, 0).x);
  if (z == 0.0) {
    imageStore(outFiltered, p, vec4(passedLight(p), 1.0));
    return;
  }
  const vec3 shading = unpackNormal(texelFetch(shadingNormal, p, 0).x);
  const vec3 normal = unpackNormal(texelFetch(geometricNormal, p, 0).x);
  const Plane plane = planeAt(p, z, normal);
  const float occluded = texelFetch(occlusion, p, 0).x;
  const vec2 position = (vec2(p) + 0.5) / float(kBlockSize) - 0.5;
  const ivec2 base = ivec2(floor(position));
  const vec2 f = position - vec2(base);
  Prediction fine = Prediction(vec3(0.0), 0.0, 0.0);
  Prediction coarse = fine;
  for (int i = 0; i < 4; ++i) {
    const ivec2 offset = ivec2(i & 1, i >> 1);
    const ivec2 block = base + offset;
    if (any(lessThan(block, ivec2(0))) || any(greaterThanEqual(block, textureSize(fitDepth, 0)))) continue;
    const vec2 axisWeight = mix(1.0 - f, f, vec2(offset));
    const float bilinear = axisWeight.x * axisWeight.y;
    const float coarseZ = unpackDepth(texelFetch(coarseDepth, block, 0).x);
    if (coarseZ > 0.0) add(coarse, bilinear, loadCoarse(block), featuresOf(shading, coarseZ / z - 1.0, occluded));
    const float fineZ = unpackDepth(texelFetch(fitDepth, block, 0).x);
    if (fineZ > 0.0) {
      const uint packedNormal = texelFetch(fitNormal, block, 0).x;
      const float weight = bilinear * facing(normal, blockNormal(packedNormal)) *
                           onPlane(planeDistance(plane, representativePixel(block, kBlockSize, packedNormal), fineZ));
      add(fine, weight, loadFine(block), featuresOf(shading, fineZ / z - 1.0, occluded));
    }
  }
  imageStore(outFiltered, p, nearestHalf(vec4(mixFits(fine, coarse, lightAt(p).rgb), 1.0)));
}
