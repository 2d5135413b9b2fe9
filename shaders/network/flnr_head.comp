// The network's last layer: a 1 x 1 convolution and a sigmoid make three guides for each of the 2 x 2 pixels of a texel
// (kShrink 2), or four guides of a pixel (kShrink 1).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "network/guide_network.h"
#include "common/halves.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint kChannels = 16u;  // Of the input, a multiple of four.
layout(constant_id = 1) const int kShrink = 2;        // Pixels per axis of a texel.

layout(push_constant) uniform PushConstants { LayerConstants constants; };

layout(std430) readonly buffer firstInput { uvec2 first[]; };
// For each input, for each group, the weights of its four results. Then the biases of each group.
layout(std430) readonly buffer weights { uvec2 halves[]; };
layout(rgba16f) uniform writeonly image2D outLearned;

// Groups of four results: each a guide of four pixels, or the four guides of a pixel.
const int kGroups = kShrink == 2 ? 3 : 1, kMostGroups = 3;

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, constants.extent))) return;
  vec4 sums[kMostGroups];
  for (int group = 0; group < kGroups; ++group)
    sums[group] = unpackHalves(halves[constants.weights + kChannels * uint(kGroups) + uint(group)]);
  for (int four = 0; four < int(kChannels) / 4; ++four) {
    const vec4 x = unpackHalves(first[halvesIndex(p, four, constants.extent)]);
    for (int i = 0; i < 4 * kGroups; ++i) {
      const uint weight = constants.weights + uint(4 * four * kGroups + i);
      sums[i % kGroups] += x[i / kGroups] * unpackHalves(halves[weight]);
    }
  }
  for (int group = 0; group < kGroups; ++group) sums[group] = 1.0 / (1.0 + exp(-sums[group]));
  if (kShrink == 1) {
    imageStore(outLearned, p, sums[0]);
    return;
  }
  for (int i = 0; i < 4; ++i) {
    const ivec2 pixel = 2 * p + ivec2(i % 2, i / 2);
    if (all(lessThan(pixel, imageSize(outLearned))))
      imageStore(outLearned, pixel, vec4(sums[0][i], sums[1][i], sums[2][i], 0.0));
  }
}
