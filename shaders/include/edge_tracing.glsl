// Edge tracing along axes and diagonals (walr.txt 3.3, 5.2).
// Needs: `frame` (FrameConstants), `depth` (utexture2D), `settings` (AtrousConstants), `kTraceEdges`.
#ifndef WALR_EDGE_TRACING_GLSL
#define WALR_EDGE_TRACING_GLSL
#include "edge_weight.glsl"

struct Trace {
  float weight;  // Smallest edge weight met on the segment.
  int edge;      // Step at which it became 0; steps + 1 where it did not.
};

// What edge tracing reads; outside the image there is no surface.
uint packedDepthAt(ivec2 q) {
  if (any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, textureSize(depth, 0)))) return 0u;
  return texelFetch(depth, q, 0).x;
}

// Walk from `p` in `direction` up to `steps` pixels. Each pixel's signed distance says how far the next edge lay in the
// last iteration; the walk steps by a fraction of it. Without edge tracing only the far end is looked at.
Trace traceEdge(Plane plane, ivec2 p, ivec2 direction, int steps, uint sdf) {
  Trace trace = Trace(1.0, steps + 1);
  int step = 0;
  while (step < steps) {
    step = kTraceEdges ? min(step + max(int(settings.sdfFraction * float(sdf)), 1), steps) : steps;
    const ivec2 q = p + step * direction;
    const uint packedDepth = packedDepthAt(q);
    sdf = unpackSdf(packedDepth);
    trace.weight = min(trace.weight, edgeWeight(plane, q, packedDepth));
    if (trace.weight <= 0.0) {
      trace.edge = step;
      break;
    }
  }
  return trace;
}

#endif
