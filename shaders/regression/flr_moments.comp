// FLR, first stage (Salmi et al. 2024): sums the outer products of guides and colour over the pixels of each cell.
// EIGHT_GUIDES: writes a second buffer of products (flr.glsl).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#include "regression/flr.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kAlphaIsSampleCount = false;
#include "conventions/sampled_light.glsl"

layout(push_constant) uniform PushConstants { FlrConstants constants; };
#include "regression/flr.glsl"

uniform texture2D lighting;
uniform utexture2D depth;
layout(std430) writeonly buffer outMoments { vec4 outCells[]; };
#ifdef EIGHT_GUIDES
layout(std430) writeonly buffer outMoreMoments { vec4 outMoreCells[]; };
#endif
#include "regression/flr_guides.glsl"

void main() {
  const ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
  if (!insideGrid(cell)) return;
  const ivec2 first = cell * constants.factor;
  const ivec2 end = min(first + constants.factor, textureSize(depth, 0));
  OuterProducts sum = noSamples();
  for (int y = first.y; y < end.y; ++y) {
    for (int x = first.x; x < end.x; ++x) {
      const ivec2 p = ivec2(x, y);
      // All fetches come before the first test, so that they overlap.
      const float z = depthAt(p);
      const vec4 light = texelFetch(lighting, p, 0);
      const PackedGuides guides = packedGuides(p);
      // Sky, pixels without a diffuse lobe and pixels without a finite sample do not count.
      if (z == 0.0 || !isSampled(light)) continue;
      add(sum, 1.0, outerProducts(unpackGuides(guides, z), clampedRadiance(light.rgb)));
    }
  }
  [[unroll]] for (int k = 0; k < kFirstVectors; ++k) outCells[vectorIndex(cell, k)] = sum.v[k];
#ifdef EIGHT_GUIDES
  [[unroll]] for (int k = kFirstVectors; k < kProductVectors; ++k)
    outMoreCells[vectorIndex(cell, k - kFirstVectors)] = sum.v[k];
#endif
}
