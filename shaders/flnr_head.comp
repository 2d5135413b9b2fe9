// The network's last layer: a 1 x 1 convolution and a sigmoid make three guides for each of the 2 x 2 pixels of a texel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "constants/guide_network.h"
#include "include/halves.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint kChannels = 16u;  // Of the input, a multiple of four.

layout(push_constant) uniform PushConstants { LayerConstants constants; };

layout(std430) readonly buffer firstInput { uvec2 first[]; };
// For each input, for each guide, the weights of the four pixels. Then the biases of each guide.
layout(std430) readonly buffer weights { uvec2 halves[]; };
layout(rgba16f) uniform writeonly image2D outLearned;

const int kGuides = 3;

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, constants.extent))) return;
  vec4 sums[kGuides];
  for (int guide = 0; guide < kGuides; ++guide)
    sums[guide] = unpackHalves(halves[constants.weights + kChannels * uint(kGuides) + uint(guide)]);
  for (int group = 0; group < int(kChannels) / 4; ++group) {
    const vec4 x = unpackHalves(first[halvesIndex(p, group, constants.extent)]);
    for (int i = 0; i < 4 * kGuides; ++i) {
      const uint weight = constants.weights + uint(4 * group * kGuides + i);
      sums[i % kGuides] += x[i / kGuides] * unpackHalves(halves[weight]);
    }
  }
  for (int guide = 0; guide < kGuides; ++guide) sums[guide] = 1.0 / (1.0 + exp(-sums[guide]));
  for (int i = 0; i < 4; ++i) {
    const ivec2 pixel = 2 * p + ivec2(i % 2, i / 2);
    if (all(lessThan(pixel, imageSize(outLearned))))
      imageStore(outLearned, pixel, vec4(sums[0][i], sums[1][i], sums[2][i], 0.0));
  }
}
