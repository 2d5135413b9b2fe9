// What denoisers take of specular light, from what the path tracer writes (samples/gpu_render/shaders/trace.comp).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "common/finite.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D traced;          // Alpha: mean inverse distance.
layout(set = 0, binding = 1) uniform texture2D specularAlbedo;  // Alpha: number of paths.
layout(set = 0, binding = 2) uniform texture2D normal;          // Alpha: roughness.
layout(set = 0, binding = 3, rgba16f) uniform writeonly image2D outSpecular;
layout(set = 0, binding = 4, r8) uniform writeonly image2D outRoughness;

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(traced, 0)))) return;
  const vec4 light = texelFetch(traced, p, 0);
  const bool sampled = texelFetch(specularAlbedo, p, 0).a > 0.0;
  const float distance = sampled ? min(1.0 / max(light.a, 1.0 / kLargestHalf), kLargestHalf) : 0.0;
  imageStore(outSpecular, p, vec4(light.rgb, distance));
  imageStore(outRoughness, p, vec4(texelFetch(normal, p, 0).a));
}
