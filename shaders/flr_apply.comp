// FLR, last stage (flr-flnr.txt): coefficients, upsampled bilinearly, applied to the guides at full resolution.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "constants/flr.h"
#include "include/finite.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform PushConstants { FlrConstants settings; };
#include "include/flr.glsl"

layout(set = 0, binding = 0) uniform texture2D lighting;
layout(set = 0, binding = 1) uniform utexture2D depth;
layout(set = 0, binding = 2) uniform utexture2D shadingNormal;
layout(set = 0, binding = 3, std430) readonly buffer coefficients { Coefficients cells[]; };
layout(set = 0, binding = 4, rgba16f) uniform writeonly image2D outFiltered;

// Interpolated prediction of the four cells around pixel `p` that have a fit.
// Alpha: below 0 where no cell has any.
vec4 predict(ivec2 p, vec4 x) {
  const vec2 position = (vec2(p) + 0.5) / float(settings.factor) - 0.5;
  const ivec2 base = ivec2(floor(position));
  const vec2 f = position - vec2(base);
  vec3 sum = vec3(0.0);
  float weightSum = 0.0;
  for (int i = 0; i < 4; ++i) {
    const ivec2 offset = ivec2(i & 1, i >> 1);
    if (!insideGrid(base + offset)) continue;
    const Coefficients k = cells[cellIndex(base + offset)];
    const vec2 axisWeight = mix(1.0 - f, f, vec2(offset));
    const float weight = axisWeight.x * axisWeight.y * k.constant.a;
    sum += weight * (k.constant.rgb + vec3(dot(k.slope[0], x), dot(k.slope[1], x), dot(k.slope[2], x)));
    weightSum += weight;
  }
  return weightSum > 0.0 ? vec4(clamp(sum / weightSum, 0.0, kLargestHalf), 1.0) : vec4(vec3(0.0), -1.0);
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(depth, 0)))) return;
  const float z = unpackDepth(texelFetch(depth, p, 0).x);
  if (z == 0.0) {
    const vec3 colour = texelFetch(lighting, p, 0).rgb;
    imageStore(outFiltered, p, vec4(isFinite(colour) ? colour : vec3(0.0), 1.0));
    return;
  }
  imageStore(outFiltered, p, predict(p, guidesOf(z, texelFetch(shadingNormal, p, 0).x)));
}
