// What temporal accumulation does for and with the detection of light that changes (light_change.comp).
// Needs: `previousDoubt`; unless VIEW, `outChange` and workgroups of kLightChangeTile squared.
#ifndef WALR_LIGHT_CHANGE_GLSL
#define WALR_LIGHT_CHANGE_GLSL
#include "constants/light_change.h"

// Bilinear at a position in pixels of the frame before; the borders go on.
float doubtAt(vec2 pixel) {
  const vec2 position = pixel / float(kLightChangeTile) - 0.5;
  const ivec2 base = ivec2(floor(position));
  const vec2 f = fract(position);
  const ivec2 last = textureSize(previousDoubt, 0) - 1;
  float sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    const ivec2 offset = ivec2(i & 1, i >> 1);
    const vec2 weight = mix(1.0 - f, f, vec2(offset));
    sum += weight.x * weight.y * texelFetch(previousDoubt, clamp(base + offset, ivec2(0), last), 0).x;
  }
  return sum;
}

// History in doubt counts for fewer samples, down to one.
float longestHistory(vec2 pixel, float maxSamples) { return mix(maxSamples, 1.0, doubtAt(pixel)); }

#ifndef VIEW
const uint kTileThreads = uint(kLightChangeTile * kLightChangeTile);
shared vec2 tileSums[kTileThreads];

// All threads of the workgroup must come here.
void sumOverTile(float difference) {
  const uint thread = gl_LocalInvocationIndex;
  tileSums[thread] = vec2(difference, difference * difference);
  barrier();
  for (uint n = kTileThreads / 2u; n > 0u; n /= 2u) {
    if (thread < n) tileSums[thread] += tileSums[thread + n];
    barrier();
  }
  if (thread == 0u) imageStore(outChange, ivec2(gl_WorkGroupID.xy), vec4(tileSums[0], 0.0, 0.0));
}
#endif

#endif
