// Converts one texture from a host's conventions to the project's, or the result back to the host's. It is compiled
// once for each kind of texture (DEPTH, NORMAL, VALUES, NUMBERS). A host's texture may be larger than
// the rectangle that is denoised.
// SINGLE, PACKED: VALUES that are stored as RGBA32F or B10G11R11 instead of RGBA16F.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "guides/convert_input.h"

layout(local_size_x = 8, local_size_y = 8) in;

#ifdef NUMBERS
uniform utexture2D source;
layout(r32ui) uniform writeonly uimage2D target;
#else
uniform texture2D source;
#endif
#ifdef DEPTH
layout(r32f) uniform writeonly image2D target;
layout(constant_id = 0) const bool kDevice = false;    // From device depth.
layout(constant_id = 1) const bool kNegative = false;  // From z of view space, which is negative.
#elif defined(SINGLE)
layout(rgba32f) uniform writeonly image2D target;
#elif defined(PACKED)
layout(r11f_g11f_b10f) uniform writeonly image2D target;
#elif !defined(NUMBERS)
layout(rgba16f) uniform writeonly image2D target;
#endif
layout(std140) uniform hostConstants { HostConstants host; };
#ifdef VALUES
layout(constant_id = 2) const bool kBack = false;      // From the result to the host's texture.
layout(constant_id = 3) const bool kExposed = false;   // Light, to multiply by an exposure.
layout(constant_id = 4) const bool kReversed = false;  // Motion whose third channel is current - previous view depth.
#else
const bool kBack = false;
#endif

#ifdef DEPTH
layout(constant_id = 2) const bool kOrthographic = false;  // To the view depth of the stand-in.

float orthographicDepth(float value) {
  const float depth = kDevice ? host.depthFromDevice.x + host.depthFromDevice.y * value : kNegative ? -value : value;
  return depth > 0.0 ? depth + host.standOff : depth;
}

// Infinite depth is sky, and so is a depth that no perspective projection gives.
vec4 convert(vec4 value) {
  if (kOrthographic) return vec4(orthographicDepth(value.x));
  if (!kDevice) return vec4(kNegative ? -value.x : value.x);
  const float divisor = value.x + host.depthFromDevice.y;
  const float depth = host.depthFromDevice.x / divisor;
  const float infinity = uintBitsToFloat(0x7f800000u);
  return vec4(divisor != 0.0 && depth > 0.0 ? depth : infinity);
}
#endif

#ifdef NORMAL
layout(constant_id = 0) const bool kUnsigned = false;    // From 0..1 to -1..1.
layout(constant_id = 1) const bool kOctahedral = false;  // Two channels, pole on +z (Cigolle et al. 2014).

vec4 convert(vec4 value) {
  // Zero is sky. In an octahedral map zero is a direction, and only depth tells sky.
  if (!kOctahedral && all(equal(value.xyz, vec3(0.0)))) return vec4(0.0);
  vec3 n = kUnsigned ? 2.0 * value.xyz - 1.0 : value.xyz;
  if (kOctahedral) {
    n.z = 1.0 - abs(n.x) - abs(n.y);
    if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
    n = normalize(n);
  }
  return vec4(n, 0.0);
}
#endif

#ifdef PACKED
#include "common/small_float.glsl"
vec4 stored(vec4 value) { return vec4(nearestSmallFloats(value.rgb), 1.0); }
#elif defined(VALUES) && !defined(SINGLE)
#include "common/half.glsl"
// What is more than a half can hold counts as the largest half. NaN and infinity stay: they are no samples.
vec4 stored(vec4 value) {
  const bvec4 finite = bvec4(isFinite(value.r), isFinite(value.g), isFinite(value.b), isFinite(value.a));
  return mix(value, nearestHalf(value), finite);
}
#else
vec4 stored(vec4 value) { return value; }
#endif

#ifdef VALUES
vec4 convert(vec4 value) {
  if (kExposed) value.rgb *= kBack ? host.exposure : host.inverseExposure;
  if (kReversed) value.z = -value.z;
  return stored(value);
}
#endif

#ifdef NUMBERS
uvec4 convert(uvec4 value) { return value; }
#endif

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, kBack ? textureSize(source, 0) : imageSize(target)))) return;
  const ivec2 from = kBack ? p : p + host.offset;
  const ivec2 to = kBack ? p + host.offset : p;
  imageStore(target, to, convert(texelFetch(source, from, 0)));
}
