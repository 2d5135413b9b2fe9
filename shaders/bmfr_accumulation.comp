// BMFR postprocessing (Koskela et al. 2019, 3.5): the fitted frame is averaged over time through the taps that the
// first accumulation accepted, a cumulative mean that turns exponential. Displaced blocks and the noise of the
// regularisation average out.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "constants/bmfr.h"
#include "constants/frame.h"
#include "include/half.glsl"
#include "include/history_taps.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture2D fitted;
uniform utexture2D taps;
uniform texture2D previousAccumulated;  // rgb: mean; a: history length.
layout(rgba16f) uniform writeonly image2D outAccumulated;
layout(std140) uniform frameConstants { FrameConstants frame; };
layout(push_constant) uniform PushConstants { BmfrAccumulationConstants constants; };

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(fitted, 0)))) return;

  const vec3 current = texelFetch(fitted, p, 0).rgb;
  const uint kept = texelFetch(taps, p, 0).x;
  if (kept == kNoSurfaceTaps) {
    imageStore(outAccumulated, p, vec4(current, 0.0));
    return;
  }
  const vec4 history = meanOfTaps(previousAccumulated, unpackTaps(p, kept, frame.previousPixelFromPixel));
  const float samples = min(history.a + 1.0, constants.maxHistory);
  imageStore(outAccumulated, p, nearestHalf(vec4(mix(history.rgb, current, 1.0 / samples), samples)));
}
