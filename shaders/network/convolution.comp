// A 3 x 3 convolution with LeakyReLU of one or two inputs (Salmi et al. 2024, Enhancing Local Regression with Neural
// Networks). The first input may be pooled or grown while it is read, so that neither has a pass of its own; the second,
// the skip of a U-Net, has the result's size. Beyond the image there are zeros.
//
// A work group makes eight channels of 16 x 16 texels, a thread of four texels of them. It goes through the inputs four
// channels at a time, which it keeps with their weights in shared memory.
// HALVES: products are halves, and so are their sums over the taps of four channels.
#version 460
#extension GL_EXT_control_flow_attributes : require
#ifdef HALVES
#extension GL_EXT_shader_explicit_arithmetic_types_float16 : require
#endif
#extension GL_GOOGLE_include_directive : require
#include "network/guide_network.h"
#include "common/halves.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint kFirstChannels = 16u;  // A multiple of four.
layout(constant_id = 1) const uint kSecondChannels = 0u;  // Likewise; 0: there is no second input.
layout(constant_id = 2) const uint kFirstInput = 0u;      // kInputAsItIs and so on.

layout(push_constant) uniform PushConstants { LayerConstants constants; };

layout(std430) readonly buffer firstInput { uvec2 first[]; };
layout(std430) readonly buffer secondInput { uvec2 second[]; };
// Of every eight results: for every four inputs, for each of nine taps, the weights of the first and last four results of
// each input. Then the biases of all results.
layout(std430) readonly buffer weights { uvec2 halves[]; };
layout(std430) writeonly buffer outResult { uvec2 result[]; };

const int kThreads = 8, kTile = 2 * kThreads, kRim = kTile + 2, kTaps = 9, kWeights = kTaps * 8;
const int kFirstGroups = int(kFirstChannels) / 4, kGroups = kFirstGroups + int(kSecondChannels) / 4;

const float kSlope = 0.1;  // Of LeakyReLU below 0.

#ifdef HALVES
#define Factor f16vec4
f16vec4 factorOf(uvec2 packed) { return f16vec4(unpackFloat2x16(packed.x), unpackFloat2x16(packed.y)); }
#else
#define Factor vec4
vec4 factorOf(uvec2 packed) { return unpackHalves(packed); }
#endif

shared uvec2 tile[kRim * kRim];
shared Factor taps[kWeights];

uvec2 largest(uvec2 a, uvec2 b) { return packHalves(max(unpackHalves(a), unpackHalves(b))); }

uvec2 firstAt(ivec2 p, int group) {
  const ivec2 extent = constants.firstExtent;
  if (kFirstInput == kInputAsItIs) return first[halvesIndex(p, group, extent)];
  if (kFirstInput == kInputGrown) return first[halvesIndex(p / 2, group, extent)];
  const ivec2 last = min(2 * p + 1, extent - 1);  // At an odd border the texel beside is the last one again.
  const uvec2 above = largest(first[halvesIndex(2 * p, group, extent)],
                              first[halvesIndex(ivec2(last.x, 2 * p.y), group, extent)]);
  const uvec2 below = largest(first[halvesIndex(ivec2(2 * p.x, last.y), group, extent)],
                              first[halvesIndex(last, group, extent)]);
  return largest(above, below);
}

uvec2 inputAt(ivec2 p, int group) {
  if (any(lessThan(p, ivec2(0))) || any(greaterThanEqual(p, constants.extent))) return uvec2(0u);
  if (group < kFirstGroups) return firstAt(p, group);
  return second[halvesIndex(p, group - kFirstGroups, constants.extent)];
}

void main() {
  const ivec2 corner = ivec2(gl_WorkGroupID.xy) * kTile;
  const ivec2 thread = ivec2(gl_LocalInvocationID.xy);
  const int eight = int(gl_WorkGroupID.z);
  const int number = int(gl_LocalInvocationIndex);
  const uint biases = constants.weights + uint(int(gl_NumWorkGroups.z) * kGroups * kWeights + 2 * eight);

  // Of the thread's four texels, which lie half a tile apart so that neighbouring threads read neighbouring texels, the
  // first and last four results.
  vec4 sums[4][2];
  [[unroll]] for (int i = 0; i < 8; ++i) sums[i / 2][i % 2] = unpackHalves(halves[biases + uint(i % 2)]);

  for (int group = 0; group < kGroups; ++group) {
    if (group > 0) barrier();
    for (int i = number; i < kRim * kRim; i += kThreads * kThreads)
      tile[i] = inputAt(corner + ivec2(i % kRim, i / kRim) - 1, group);
    const uint begin = constants.weights + uint((eight * kGroups + group) * kWeights);
    for (int i = number; i < kWeights; i += kThreads * kThreads) taps[i] = factorOf(halves[begin + uint(i)]);
    barrier();
#ifdef HALVES
    Factor partial[4][2];
    [[unroll]] for (int i = 0; i < 8; ++i) partial[i / 2][i % 2] = Factor(0.0);
#define PARTIAL partial
#else
#define PARTIAL sums
#endif
    [[unroll]] for (int tap = 0; tap < kTaps; ++tap) {
      const ivec2 from = thread + ivec2(tap % 3, tap / 3);
      [[unroll]] for (int texel = 0; texel < 4; ++texel) {
        const ivec2 at = from + kThreads * ivec2(texel % 2, texel / 2);
        const Factor x = factorOf(tile[at.y * kRim + at.x]);
        [[unroll]] for (int i = 0; i < 8; ++i) PARTIAL[texel][i % 2] += x[i / 2] * taps[8 * tap + i];
      }
    }
#ifdef HALVES
    [[unroll]] for (int i = 0; i < 8; ++i) sums[i / 2][i % 2] += vec4(partial[i / 2][i % 2]);
#endif
  }

  [[unroll]] for (int texel = 0; texel < 4; ++texel) {
    const ivec2 p = corner + thread + kThreads * ivec2(texel % 2, texel / 2);
    if (any(greaterThanEqual(p, constants.extent))) continue;
    [[unroll]] for (int i = 0; i < 2; ++i) {
      const vec4 sum = sums[texel][i];
      result[halvesIndex(p, 2 * eight + i, constants.extent)] = packHalves(max(sum, kSlope * sum));
    }
  }
}
