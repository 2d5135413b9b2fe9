// Storage of the guides of one pixel: view depth with the distance to the nearest edge, shading and geometric normal,
// ambient occlusion.
#ifndef WALR_SURFACE_GLSL
#define WALR_SURFACE_GLSL

// Depth and edge distance share one R32_UINT. The distance takes the five lowest mantissa bits, which leaves depth a
// relative rounding error of 2^-19. Depth 0 marks a pixel without a surface to denoise. The distance is called signed
// distance field, SDF, as in the paper (Meunier & Harada 2022, 5.2).
const uint kSdfMask = 31u;

uint packDepthSdf(float depth, uint sdf) {
  const uint rounded = (floatBitsToUint(depth) + (kSdfMask + 1u) / 2u) & ~kSdfMask;
  return rounded | min(sdf, kSdfMask);
}
float unpackDepth(uint packed) { return uintBitsToFloat(packed & ~kSdfMask); }
vec4 unpackDepth(uvec4 packed) { return uintBitsToFloat(packed & ~kSdfMask); }
uint unpackSdf(uint packed) { return packed & kSdfMask; }

// Octahedral map of a direction with its pole on +Z, the view axis: normals that face the camera do not wrap around
// (Cigolle et al. 2014; Meunier & Harada 2022, 5.2). The result is in [-1, 1].
vec2 octahedralPoint(vec3 n) {
  n /= abs(n.x) + abs(n.y) + abs(n.z);
  // The lower half is folded outwards.
  const uint fold = floatBitsToUint(max(-n.z, 0.0));
  return n.xy + uintBitsToFloat(fold | (floatBitsToUint(n.xy) & 0x80000000u));
}
vec2 octahedralEncode(vec3 n) { return octahedralPoint(n) * 0.5 + 0.5; }  // In [0, 1].

// The direction, not normalised, of a point of the map. Its coordinates run from -`scale` to `scale`; where they sum to
// more than `scale`, the map is folded over and z is negative.
vec3 octahedralDirection(vec2 e, float scale) {
  const float z = scale - abs(e.x) - abs(e.y);
  const uint fold = floatBitsToUint(max(-z, 0.0)), sign = 0x80000000u;
  return vec3(e - uintBitsToFloat((floatBitsToUint(e) & sign) | fold), z);
}
vec3 octahedralDecode(vec2 uv) { return normalize(octahedralDirection(uv * 2.0 - 1.0, 1.0)); }

// The two coordinates of the map, quantised to `steps` steps.
uvec2 octahedralSteps(vec3 n, float steps) {
  return uvec2(octahedralPoint(n) * (0.5 * steps) + (0.5 * steps + 0.5));
}

// A normal in one R32_UINT: two 16-bit coordinates of the octahedral map. Those of the shading normal, in [0, 1], are
// the features of the regression over pixels.
uint packNormal(vec3 n) { return packUnorm2x16(octahedralEncode(n)); }
vec2 unpackFeatures(uint packed) { return unpackUnorm2x16(packed); }
vec3 longNormalDirection(uint packed) { return octahedralDirection(unpackFeatures(packed) * 2.0 - 1.0, 1.0); }
vec3 unpackLongNormal(uint packed) { return normalize(longNormalDirection(packed)); }

// A short normal: two coordinates of six bits, which suffices for the plane of a block. They are a stereographic
// projection, which is n.xy / (1 + n.z) for a unit normal n, in steps of 1/16 from -31/16 to 31/16. It holds normals up
// to 125 degrees from the view axis to 5 degrees; normals that face the camera lie further away only in corners of a
// wide image, and get the nearest coordinates. The pole is no step off, so that a normal along the view axis is exact.
const int kShortNormalBits = 12;
const uint kShortNormalMask = (1u << kShortNormalBits) - 1u;
const float kShortNormalSteps = 16.0;   // Per unit of the projection.
const float kShortNormalCentre = 31.0;  // Step of the pole.

// `n`: not normalised.
uint packShortNormal(vec3 n) {
  const vec2 point = n.xy / max(n.z + length(n), 1e-30);
  const uvec2 steps = uvec2(clamp(point * kShortNormalSteps + (kShortNormalCentre + 0.5), 0.0, 2.0 * kShortNormalCentre));
  return steps.x | steps.y << 6;
}
// The point of the projection. Bits above those of the short normal do not matter.
vec2 shortNormalPoint(uint packed) {
  const uvec2 steps = uvec2(bitfieldExtract(packed, 0, 6), bitfieldExtract(packed, 6, 6));
  return vec2(steps) / kShortNormalSteps - kShortNormalCentre / kShortNormalSteps;
}
vec3 unpackShortNormal(uint packed) {
  const vec2 point = shortNormalPoint(packed);
  const float squared = dot(point, point);
  return vec3(2.0 * point, 1.0 - squared) / (1.0 + squared);
}

// Depth and geometric normal share one R32_UINT. The short normal takes the lowest mantissa bits, which leaves depth a
// relative rounding error of 2^-12. 0 marks a pixel without a surface to denoise.
uint packDepthNormal(float depth, uint shortNormal) {
  const uint rounded = (floatBitsToUint(depth) + (kShortNormalMask + 1u) / 2u) & ~kShortNormalMask;
  return rounded | shortNormal;
}
float unpackDepthBesideNormal(uint packed) { return uintBitsToFloat(packed & ~kShortNormalMask); }
vec4 unpackDepthBesideNormal(uvec4 packed) { return uintBitsToFloat(packed & ~kShortNormalMask); }

// Shading normal (two coordinates of 12 bits) and ambient occlusion in [0, 1] (8 bits) in one R32_UINT.
struct NormalAndOcclusion {
  vec3 normal;
  float occlusion;
};
uint packNormalAndOcclusion(NormalAndOcclusion s) {
  const uvec2 normal = octahedralSteps(s.normal, 4095.0);
  return normal.x | (normal.y << 12) | (uint(clamp(s.occlusion, 0.0, 1.0) * 255.0 + 0.5) << 24);
}
NormalAndOcclusion unpackNormalAndOcclusion(uint packed) {
  const uvec2 normal = uvec2(bitfieldExtract(packed, 0, 12), bitfieldExtract(packed, 12, 12));
  return NormalAndOcclusion(octahedralDecode(vec2(normal) / 4095.0), float(packed >> 24) / 255.0);
}

#endif
