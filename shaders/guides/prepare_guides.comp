// Converts the host's G-buffer into the guides that every later pass reads (guides.glsl). The shading normal's two
// coordinates are features of the regression over pixels. The geometric normal and the position define each pixel's
// plane.
// GEOMETRIC_NORMAL, NORMAL_APART: see guides.glsl.
// VIEW: writes why pixels are not denoised, or which inputs are not finite, instead of guides.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "conventions/frame.h"
#include "guides/prepare_guides.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std140) uniform frameConstants { FrameConstants frame; };
#ifdef VIEW
layout(rgba32f) uniform writeonly image2D outView;
#endif
layout(push_constant) uniform PushConstants {
  PrepareGuidesConstants guideConstants;
#ifdef VIEW
  uint view;  // Which quantity; numbered in viewOf.
#endif
};
#ifdef VIEW
#include "guides/host_surface.glsl"
#else
#include "guides/guides.glsl"
#endif

#ifdef VIEW
vec3 viewOf(ivec2 p) {
  const float z = texelFetch(hostDepth, p, 0).x;
  const vec3 n = texelFetch(normal, p, 0).xyz;
  const vec3 diffuse = albedoAt(p);
  switch (view) {
    case 0u:
      if (!isSurfaceDepth(z, surfaceDepthEnd())) return vec3(1.0, 0.0, 0.0);
      if (!isUsable(dot(n, n))) return vec3(0.0, 1.0, 0.0);
      return vec3(0.0, 0.0, !hasDiffuseLobe(diffuse));
    case 1u: return vec3(!isFinite(z), !isFinite(n), !isFinite(diffuse));
  }
  return vec3(0.0);
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(hostDepth, 0)))) return;
  imageStore(outView, p, vec4(viewOf(p), 1.0));
}
#else
void main() {
  const PackedGuides guides = guidesOfPixel();
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(p, textureSize(hostDepth, 0)))) storeGuides(p, guides);
}
#endif
