// Shows one texture of the graph, scaled to the size of the displayed image. UINT: a texture of bit fields, of whose
// first component the bytes are shown.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "common/finite.glsl"
#include "view_constants.h"

layout(local_size_x = 8, local_size_y = 8) in;
#ifdef UINT
layout(set = 0, binding = 0) uniform utexture2D inspected;
#else
layout(set = 0, binding = 0) uniform texture2D inspected;
layout(set = 0, binding = 2, std140) uniform View { ViewConstants view; };
#endif
layout(push_constant) uniform Shown { ivec2 size; };  // Pixels of the displayed image that are shown.
layout(set = 0, binding = 1, rgba8) uniform writeonly image2D outDisplay;

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, size))) return;
  const ivec2 texel = p * textureSize(inspected, 0) / size;
#ifdef UINT
  const vec3 colour = unpackUnorm4x8(texelFetch(inspected, texel, 0).x).rgb;
#else
  const vec3 value = texelFetch(inspected, texel, 0).rgb;
  const vec3 colour = isFinite(value) ? clamp(value * view.gain + view.bias, 0.0, 1.0) : vec3(1.0, 0.0, 1.0);
#endif
  imageStore(outDisplay, p, vec4(colour, 1.0));
}
