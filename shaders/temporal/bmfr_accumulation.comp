// BMFR, second accumulation (Koskela et al. 2019, 3.5): averages the fitted frames over time through the history taps
// that the first accumulation accepted. The cumulative mean turns exponential at `maxHistory`. Averaging hides the
// borders of blocks, which are displaced every frame, and the noise that the fit adds to its features.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "temporal/bmfr_accumulation.h"
#include "conventions/frame.h"
#include "common/half.glsl"
#include "temporal/history_taps.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture2D fitted;
uniform utexture2D taps;  // Kept history taps (history_taps.glsl).
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
