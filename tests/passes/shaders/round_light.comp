// Packs and unpacks light, for tests of the packing.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "include/packed_light.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint kKey = 0;  // Of the texture whose packing it is.
layout(constant_id = 1) const uint kFrame = 0;
layout(constant_id = 2) const uint kLongest = 1;  // Length.
layout(set = 0, binding = 0) uniform texture2D source;
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D target;

vec4 rounded(vec4 light, vec4 random) {
  switch (kKey) {
    case kAccumulatedSeed: return unpackAccumulated(packAccumulated(light, random));
    case kFilteredSeed: return vec4(1.0, 1.0, 1.0, light.a) * unpackFiltered(packFiltered(light.rgb, random.rgb));
    case kResolvedSeed: return unpackResolved(packResolved(light, float(kLongest), random), float(kLongest));
  }
  return vec4(unpackPassThrough(packPassThrough(light.rgb)), light.a);  // Rounded to nearest.
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(source, 0)))) return;
  imageStore(target, p, rounded(texelFetch(source, p, 0), randomNumbers(p, kFrame, kKey)));
}
