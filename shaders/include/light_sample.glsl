// The noisy light of one frame. It may be sparse: not every pixel has a sample (passes/light_pattern.h). A group of
// kLightColumns x kLightRows pixels has one texel of the lighting. The texel is the sample of one pixel of the group.
// Needs: `frame` (FrameConstants). Takes constant_id 30 to 32.
#ifndef WALR_LIGHT_SAMPLE_GLSL
#define WALR_LIGHT_SAMPLE_GLSL

layout(constant_id = 30) const int kLightColumns = 1;
layout(constant_id = 31) const int kLightRows = 1;
layout(constant_id = 32) const bool kLightMasked = false;  // Where alpha is 0 there is no sample.

const bool kSparseLight = kLightColumns > 1 || kLightRows > 1 || kLightMasked;

struct LightSample {
  vec3 radiance;  // As the host wrote it, which may be NaN; 0 without a sample.
  bool exists;
};
const LightSample kNoLightSample = LightSample(vec3(0.0), false);

// The pixel of its group that has the sample, in the groups of row `row`.
ivec2 sampledPixel(int row) {
  const ivec2 offset = frame.lightOffset;
  return kLightRows == 1 ? ivec2((offset.x + row) % kLightColumns, 0) : offset;
}

LightSample lightSampleAt(texture2D lighting, ivec2 p) {
  ivec2 texel = p;
  if (kLightColumns > 1 || kLightRows > 1) {
    const ivec2 size = ivec2(kLightColumns, kLightRows);
    texel = p / size;
    if (p - texel * size != sampledPixel(texel.y)) return kNoLightSample;
  }
  const vec4 light = texelFetch(lighting, texel, 0);
  if (kLightMasked && !(light.a > 0.0)) return kNoLightSample;
  return LightSample(light.rgb, true);
}

#endif
