// FLR, second stage (Salmi et al. 2024): the horizontal pass of the separable Gaussian over the outer products of
// cells.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "constants/flr.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform PushConstants { FlrConstants constants; };
#include "include/flr.glsl"

layout(std430) readonly buffer moments { OuterProducts cells[]; };
layout(std430) writeonly buffer outBlurred { OuterProducts outCells[]; };

void main() {
  const ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
  if (!insideGrid(cell)) return;
  OuterProducts sum = noSamples();
  for (int i = -constants.radius; i <= constants.radius; ++i) {
    const ivec2 tap = cell + ivec2(i, 0);
    if (insideGrid(tap)) add(sum, gaussian(i), cells[cellIndex(tap)]);
  }
  outCells[cellIndex(cell)] = sum;
}
