// Light whose texels are means of several samples (kLightCounted of light_sample.glsl; "Sparse light" in
// integration/docs/advanced.md). History length is then a number of samples, but the longest history stays a number of
// frames: each counts for as many samples as this one. History may hold more samples than that, because earlier frames had
// more. It then loses the share of one frame in each frame, as any history of full length does.
// Needs: `constants.maxHistory`, light_sample.glsl.
#ifndef WALR_SAMPLE_COUNTS_GLSL
#define WALR_SAMPLE_COUNTS_GLSL
#include "temporal/temporal_accumulation.h"

// Number of samples of a frame, such that packed light can hold the longest history of such frames.
float countedSamples(LightSample light) {
  return kLightCounted ? min(light.count, kMostAccumulatedSamples / constants.maxHistory) : 1.0;
}

// The same of light that counts, and 0 of other light.
float usableSamples(LightSample light) { return isUsable(light) ? countedSamples(light) : 0.0; }

// The number of samples that a frame of a history stands for. `count`: that of this frame. A frame without a sample
// says nothing about the others, which then count as they do without counts.
float samplesPerFrame(float history, float count) {
  if (!kLightCounted) return 1.0;
  const float assumed = count > 0.0 ? count : 1.0;
  const bool hadMore = history > kLengthRounding * constants.maxHistory * assumed;  // Rounding is no sample.
  return hadMore ? history / constants.maxHistory : assumed;
}

// History length with this frame's samples. `longest`: of the pixel, frames.
float lengthWith(float history, float count, float perFrame, float longest) {
  if (!kLightCounted) return min(history + count, longest);
  return min(history, perFrame * (longest - (count > 0.0 ? 1.0 : 0.0))) + count;
}

#endif
