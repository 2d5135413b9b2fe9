// Writes the error to expect of the result after the tone map x / (1 + x), for each tile of 8 x 8 pixels
// (passes/EXPECTED_ERROR.md).
// VIEW: writes what the error is computed from, too.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "common/luminance.glsl"
#include "conventions/packed_light.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba16f) uniform readonly image2D result;
uniform utexture2D accumulated;
#ifdef VIEW
layout(rgba32f) uniform writeonly image2D outView;
layout(push_constant) uniform PushConstants {
  uint view;  // Which quantity; there is one.
};
#else
layout(r16f) uniform writeonly image2D outExpectedError;
#endif

// The squared error that nothing of the picture tells, times its height^(3/2): windows are a share of the height, so that
// smooth light errs less in larger pictures. Measured from 144 to 540 lines (passes/LEARNT.md, "Rays, sparse light and
// other normals").
const float kUntold = 0.028;

const int kTile = 8;
const int kSide = kTile + 2;
shared vec3 around[kSide * kSide];  // Of the tile and a border of a pixel: see `texelAt`.
shared vec2 sums[kTile * kTile];    // Of squared errors, and of pixels.

// x: tone-mapped luminance of the result; y: accumulated light less the result, in luminance times the slope of the tone
// map; z: 1 where there is light, else all are 0.
vec3 texelAt(ivec2 p) {
  if (any(lessThan(p, ivec2(0))) || any(greaterThanEqual(p, imageSize(result)))) return vec3(0.0);
  const vec4 mean = unpackAccumulated(texelFetch(accumulated, p, 0).x);
  if (!(mean.a > 0.0)) return vec3(0.0);
  const float light = max(luminance(imageLoad(result, p).rgb), 0.0);
  const float mapped = light / (1.0 + light), slope = 1.0 / ((1.0 + light) * (1.0 + light));
  return vec3(mapped, slope * (luminance(mean.rgb) - light), 1.0);
}

void main() {
  const ivec2 first = kTile * ivec2(gl_WorkGroupID.xy) - 1;
  for (int i = int(gl_LocalInvocationIndex); i < kSide * kSide; i += kTile * kTile) {
    around[i] = texelAt(first + ivec2(i % kSide, i / kSide));
  }
  barrier();
  const ivec2 thread = ivec2(gl_LocalInvocationID.xy);
  const int centre = (thread.y + 1) * kSide + thread.x + 1;
  // Differences from the pixel's own value, so that their squares do not cancel.
  vec4 sum = vec4(0.0);
  for (int y = -kSide; y <= kSide; y += kSide) {
    for (int x = -1; x <= 1; ++x) {
      const vec3 texel = around[centre + y + x];
      const float difference = texel.x - around[centre].x;
      sum += texel.z * vec4(difference, difference * difference, texel.y, 1.0);
    }
  }
  const vec3 mean = sum.xyz / max(sum.w, 1.0);
  const float contrast = sqrt(max(mean.y - mean.x * mean.x, 0.0)), residual = abs(mean.z);
  const float counted = around[centre].z;
  sums[gl_LocalInvocationIndex] = counted * vec2(contrast * residual, 1.0);
  for (int stride = kTile * kTile / 2; stride > 0; stride /= 2) {
    barrier();
    const int i = int(gl_LocalInvocationIndex);
    if (i < stride) sums[i] += sums[i + stride];
  }
  barrier();
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy), size = imageSize(result);
  if (any(greaterThanEqual(p, size))) return;
  const vec2 ofTile = sums[0];
  const float squared = kUntold / (float(size.y) * sqrt(float(size.y))) + ofTile.x / max(ofTile.y, 1.0);
  const float error = ofTile.y > 0.0 ? sqrt(squared) : 0.0;
#ifdef VIEW
  imageStore(outView, p, vec4(view == 0u ? vec3(error, contrast, residual) * counted : vec3(0.0), 1.0));
#else
  imageStore(outExpectedError, p, vec4(error, 0.0, 0.0, 1.0));
#endif
}
