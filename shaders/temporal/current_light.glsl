// Accumulated light with the antilag of its own frame (passes/WALR.md, 3). Accumulation itself shortens history in the
// next frame only.
// Needs: light.glsl, light_sample.glsl, `frame` (FrameConstants), `constants.maxHistory`. Takes constant_id 4.
#ifndef WALR_CURRENT_LIGHT_GLSL
#define WALR_CURRENT_LIGHT_GLSL
#include "temporal/antilag.glsl"
#include "common/finite.glsl"
#include "temporal/sample_counts.glsl"

layout(constant_id = 4) const bool kAntilag = false;
uniform texture2D lighting;
uniform sampler2D antilag;  // Of this frame.

// Accumulated light at a texel that holds the pixel p. Without kAntilag it is accumulated light as it is.
vec4 currentLightAt(ivec2 texel, ivec2 p, TileLimits limits) {
  const vec4 mean = lightAt(texel);
  if (!kAntilag) return mean;
  const float ofThisFrame = kSparseLight ? 0.0 : 1.0;  // At least: sparse light may have none.
  const float longest = longestHistory(limits.factor, constants.maxHistory);
  if (!isTooLong(mean.a - ofThisFrame, longest)) return mean;
  const LightSample noisy = lightSampleAt(lighting, p);
  const bool usable = isUsable(noisy);
  const vec3 y = usable ? withoutFirefly(clampedRadiance(noisy.radiance), limits.brightest) : vec3(0.0);
  const float n = usableSamples(noisy);
  return withLongestHistory(mean, y, n, samplesPerFrame(mean.a - n, n) * longestHistoryOf(usable, longest));
}

#endif
