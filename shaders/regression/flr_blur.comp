// FLR, second stage (Salmi et al. 2024): the horizontal pass of the separable Gaussian over the outer products of
// cells. Each thread blurs one vector of one cell: vectors are the layers of the dispatch.
// EIGHT_GUIDES: there is a second buffer of products (flr.glsl).
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "regression/flr.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform PushConstants { FlrConstants constants; };
#include "regression/flr.glsl"

layout(std430) readonly buffer moments { vec4 cells[]; };
layout(std430) writeonly buffer outBlurred { vec4 outCells[]; };
#ifdef EIGHT_GUIDES
layout(std430) readonly buffer moreMoments { vec4 moreCells[]; };
layout(std430) writeonly buffer outMoreBlurred { vec4 outMoreCells[]; };
#endif

vec4 momentsAt(ivec2 cell, int vector) {
#ifdef EIGHT_GUIDES
  if (vector >= kMostFirstVectors) return moreCells[vectorIndex(cell, vector - kMostFirstVectors)];
#endif
  return cells[vectorIndex(cell, vector)];
}

void main() {
  const ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
  if (!insideGrid(cell)) return;
  const int vector = int(gl_GlobalInvocationID.z);
  vec4 sum = vec4(0.0);
  const int first = max(cell.x - constants.radius, 0), last = min(cell.x + constants.radius, constants.cells.x - 1);
  for (int x = first; x <= last; ++x) sum += gaussian(x - cell.x) * momentsAt(ivec2(x, cell.y), vector);
#ifdef EIGHT_GUIDES
  if (vector >= kMostFirstVectors) {
    outMoreCells[vectorIndex(cell, vector - kMostFirstVectors)] = sum;
    return;
  }
#endif
  outCells[vectorIndex(cell, vector)] = sum;
}
