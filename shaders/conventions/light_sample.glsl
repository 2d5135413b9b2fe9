// The noisy light of one frame. It may be sparse: not every pixel has a sample (passes/conventions/light_pattern.h). A group of
// kLightColumns x kLightRows pixels has one texel of the lighting. The texel is the sample of one pixel of the group.
// LIGHT_GRID: accumulated light has a texel for each group, not for each pixel: it lies on the light grid. Texel t of a
// frame shows the pixel of group t that has the sample of this frame. LIGHT_GRID_CHOSEN: kLightGrid says whether it does.
// Needs: `frame` (FrameConstants). Takes constant_id 30 to 32, 34, and 33 with LIGHT_GRID_CHOSEN.
#ifndef WALR_LIGHT_SAMPLE_GLSL
#define WALR_LIGHT_SAMPLE_GLSL
#include "common/finite.glsl"

layout(constant_id = 30) const int kLightColumns = 1;
layout(constant_id = 31) const int kLightRows = 1;
layout(constant_id = 32) const bool kLightMasked = false;   // Where alpha is 0 there is no sample.
layout(constant_id = 34) const bool kLightCounted = false;  // Elsewhere it is the number of samples. Needs kLightMasked.
#ifdef LIGHT_GRID
const bool kLightGrid = true;
#elif defined(LIGHT_GRID_CHOSEN)
layout(constant_id = 33) const bool kLightGrid = false;
#else
const bool kLightGrid = false;
#endif

const bool kSparseLight = kLightColumns > 1 || kLightRows > 1 || kLightMasked;

struct LightSample {
  vec3 radiance;  // As the host wrote it, which may be NaN; 0 without a sample.
  bool exists;
  float count;  // Number of samples whose mean the radiance is; 0 without a sample.
};
const LightSample kNoLightSample = LightSample(vec3(0.0), false, 0.0);

// Whether a sample counts: it is there, and finite.
bool isUsable(LightSample light) { return light.exists && isFinite(light.radiance); }

// The pixel of its group that has the sample, in the groups of row `row`.
ivec2 sampledPixel(int row) {
  const ivec2 offset = frame.lightOffset;
  return kLightRows == 1 ? ivec2((offset.x + row) % kLightColumns, 0) : offset;
}

ivec2 lightGroup() { return ivec2(kLightColumns, kLightRows); }

// The texel of accumulated light for a pixel: its own, or that of its group.
ivec2 accumulatedTexel(ivec2 p) { return kLightGrid ? p / lightGroup() : p; }

// Whether the light grid shows this pixel. Its groups have more than one row.
bool isOnLightGrid(ivec2 p) { return p - p / lightGroup() * lightGroup() == frame.lightOffset; }

// Whether a texel of the lighting belongs to the pixel, and which.
bool hasLightTexel(ivec2 p, out ivec2 texel) {
  texel = p;
  if (kLightColumns == 1 && kLightRows == 1) return true;
  const ivec2 size = ivec2(kLightColumns, kLightRows);
  texel = p / size;
  return p - texel * size == sampledPixel(texel.y);
}

LightSample lightSampleAt(texture2D lighting, ivec2 p) {
  ivec2 texel;
  if (!hasLightTexel(p, texel)) return kNoLightSample;
  const vec4 light = texelFetch(lighting, texel, 0);
  if (kLightMasked && !(light.a > 0.0)) return kNoLightSample;
  return LightSample(light.rgb, true, kLightCounted ? light.a : 1.0);
}

#endif
