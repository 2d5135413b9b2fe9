// The lit image: albedo * (direct + indirect) + emission and, with SPECULAR, the same of specular light. Non-finite values of
// all but the indirect light count as 0, as in walr::composite.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "common/finite.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D indirect;
layout(set = 0, binding = 1) uniform texture2D direct;
layout(set = 0, binding = 2) uniform texture2D albedo;
layout(set = 0, binding = 3) uniform texture2D emission;
layout(set = 0, binding = 4, rgba16f) uniform writeonly image2D outLit;
#ifdef SPECULAR
layout(set = 0, binding = 5) uniform texture2D specular;
layout(set = 0, binding = 6) uniform texture2D specularAlbedo;
#endif

vec3 known(vec3 value) {
  return vec3(isFinite(value.r) ? value.r : 0.0, isFinite(value.g) ? value.g : 0.0, isFinite(value.b) ? value.b : 0.0);
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(indirect, 0)))) return;
  const vec3 arriving = known(texelFetch(direct, p, 0).rgb) + texelFetch(indirect, p, 0).rgb;
  vec3 lit = known(texelFetch(albedo, p, 0).rgb) * arriving + known(texelFetch(emission, p, 0).rgb);
#ifdef SPECULAR
  lit += known(texelFetch(specularAlbedo, p, 0).rgb) * known(texelFetch(specular, p, 0).rgb);
#endif
  imageStore(outLit, p, vec4(min(lit, vec3(kLargestHalf)), 1.0));
}
