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
// the features of the regression over pixels. The second coordinate is never 0, which tells this format from a short
// normal.
const uint kShortNormalEnd = 1u << 16;

uint packNormal(vec3 n) {
  const uint packed = packUnorm2x16(octahedralEncode(n));
  return packed < kShortNormalEnd ? packed | kShortNormalEnd : packed;
}
vec2 unpackFeatures(uint packed) { return unpackUnorm2x16(packed); }
vec3 longNormalDirection(uint packed) { return octahedralDirection(unpackFeatures(packed) * 2.0 - 1.0, 1.0); }
vec3 unpackLongNormal(uint packed) { return normalize(longNormalDirection(packed)); }

// A short normal: R16_UINT, accurate to a degree, which suffices for the plane of a block. The number of steps is even,
// so that a normal along the view axis is exact.
const float kShortNormalSteps = 254.0;

uint packShortNormal(vec3 n) {
  const uvec2 steps = octahedralSteps(n, kShortNormalSteps);
  return steps.x | steps.y << 8;
}
vec3 shortNormalDirection(uint packed) {
  const float centre = 0.5 * kShortNormalSteps;
  return octahedralDirection(vec2(packed & 0xffu, packed >> 8 & 0xffu) - centre, centre);
}
vec3 unpackShortNormal(uint packed) { return normalize(shortNormalDirection(packed)); }

// Unpacks a normal of either format.
vec3 unpackNormal(uint packed) {
  return packed < kShortNormalEnd ? unpackShortNormal(packed) : unpackLongNormal(packed);
}

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
