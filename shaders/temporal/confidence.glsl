// The host's confidence in the history of a pixel: it scales the longest history that the pixel may use.
// Takes constant_id 18. Without kConfidence the image is not read.
#ifndef WALR_CONFIDENCE_GLSL
#define WALR_CONFIDENCE_GLSL

layout(constant_id = 18) const bool kConfidence = false;
uniform texture2D confidence;

// A history length, cut to what the host's confidence leaves of `most`, if it is below 1. NaN is no statement.
float confidentLength(ivec2 p, float samples, float most) {
  if (!kConfidence) return samples;
  const uint bits = floatBitsToUint(texelFetch(confidence, p, 0).x);
  const bool isNaN = (bits & 0x7fffffffu) > 0x7f800000u, isFull = uintBitsToFloat(bits) >= 1.0;
  return isNaN || isFull ? samples : min(samples, most * max(uintBitsToFloat(bits), 0.0));
}

#endif
