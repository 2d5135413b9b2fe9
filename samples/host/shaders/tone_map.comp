// Tone-maps a lit image for the display. SPLIT: three images, each in a range of columns, with lines between them. COMPARE: two.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "display.glsl"
#include "view_constants.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D lit;
layout(set = 0, binding = 1, rgba8) uniform writeonly image2D outDisplay;
layout(set = 0, binding = 2, std140) uniform View { ViewConstants view; };
#ifdef SPLIT
layout(set = 0, binding = 3) uniform texture2D left;
#endif
#if defined(SPLIT) || defined(COMPARE)
layout(set = 0, binding = 4) uniform texture2D right;
#endif

vec3 exposedDisplay(vec3 linear) { return display(linear * exp2(view.stops)); }

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(lit, 0)))) return;
#ifdef SPLIT
  vec3 linear = texelFetch(lit, p, 0).rgb;
  if (p.x < view.leftEdge) linear = texelFetch(left, p, 0).rgb;
  if (p.x >= view.rightEdge) linear = texelFetch(right, p, 0).rgb;
  const bool line = p.x == view.leftEdge || p.x == view.rightEdge;
  const vec3 colour = line ? vec3(1.0) : exposedDisplay(linear);
#elif defined(COMPARE)
  const vec3 linear = p.x < view.middleEdge ? texelFetch(lit, p, 0).rgb : texelFetch(right, p, 0).rgb;
  const vec3 colour = p.x == view.middleEdge ? vec3(1.0) : exposedDisplay(linear);
#else
  const vec3 colour = exposedDisplay(texelFetch(lit, p, 0).rgb);
#endif
  imageStore(outDisplay, p, vec4(colour, 1.0));
}
