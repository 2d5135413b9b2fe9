// Luminance of linear Rec. 709 colour.
#ifndef WALR_LUMINANCE_GLSL
#define WALR_LUMINANCE_GLSL

const vec3 kLuminanceFactors = vec3(0.2126, 0.7152, 0.0722);
float luminance(vec3 c) { return dot(c, kLuminanceFactors); }

// Replaces green by the luminance, and the luminance by green. Green has the largest part in it, so that rounding the
// luminance changes green least.
vec3 luminanceForGreen(vec3 c) { return vec3(c.x, luminance(c), c.z); }
vec3 greenForLuminance(vec3 c) {
  const float green = (c.y - kLuminanceFactors.x * c.x - kLuminanceFactors.z * c.z) / kLuminanceFactors.y;
  return vec3(c.x, max(green, 0.0), c.z);
}

#endif
