// Evaluates light directions by the include for hosts.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "conventions/pack_direction.glsl"
#include "walr/light_direction.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kRepack = false;  // Packs the slopes again first.
layout(set = 0, binding = 0) uniform utexture2D direction;
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D target;

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(direction, 0)))) return;
  uvec2 texel = texelFetch(direction, p, 0).xy;
  if (kRepack) texel = packDirection(walrLightSlopes(texel));
  const vec3 light = walrLightFor(vec3(1.0), texel, vec3(0.0, 0.0, 1.0), vec3(0.48, -0.64, 0.6));
  imageStore(target, p, vec4(light, 1.0));
}
