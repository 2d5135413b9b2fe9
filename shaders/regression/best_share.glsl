// The share of accumulated light with the least expected error (passes/WALR.md, 9).
#ifndef WALR_BEST_SHARE_GLSL
#define WALR_BEST_SHARE_GLSL

// `statistics`: x: square of what the fits miss; y: square of the noise of one sample. `samples`: whose mean the accumulated
// light is. History that reprojection blurs agrees too little with this frame's light, for which `gain` makes up.
float bestShare(vec2 statistics, float samples, float trust, float gain) {
  const float missed = gain * max(statistics.x, 0.0), noise = max(statistics.y, 0.0) / samples;
  return trust * missed / max(missed + noise, 1e-30);
}

#endif
