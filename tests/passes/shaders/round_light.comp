// Packs and unpacks light, or writes its random numbers, for tests of the packing.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "conventions/packed_light.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint kKey = 0;  // Key of the texture; 0 for the pass-through.
layout(constant_id = 1) const bool kNumbers = false;  // Writes the random numbers.
layout(push_constant) uniform PushConstants {
  uint frame;
  uint longest;  // Longest history length of the resolved texture.
};
layout(set = 0, binding = 0) uniform texture2D source;
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D target;

const uint kFilteredKey = 0x101u;

vec4 rounded(vec4 light, vec4 random) {
  switch (kKey) {
    case kAccumulatedSeed: return unpackAccumulated(packAccumulated(light, random));
    case kFilteredKey: return vec4(1.0, 1.0, 1.0, light.a) * unpackFiltered(packFiltered(light.rgb, random.r));
    case kResolvedSeed: {
      const PackedLength most = PackedLength(float(longest), longest > 64u);
      return unpackResolved(packResolved(light, most, random), most);
    }
  }
  return vec4(unpackPassThrough(packPassThrough(light.rgb)), light.a);  // Rounded to nearest.
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(source, 0)))) return;
  const vec4 random = kKey == kFilteredKey ? vec4(ditherNumber(p, frame)) : randomNumbers(p, frame, kKey);
  imageStore(target, p, kNumbers ? random : rounded(texelFetch(source, p, 0), random));
}
