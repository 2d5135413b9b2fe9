// Edge-stopping function and edge tracing (walr.txt 3.3, 4.3, 5.2).
// Needs: `frame` (FrameConstants), `depth` (utexture2D), `settings` (AtrousConstants), `kTraceEdges`.
#ifndef WALR_EDGE_TRACING_GLSL
#define WALR_EDGE_TRACING_GLSL
#include "plane.glsl"
#include "surface.glsl"

// Edge-stopping function: 1 near the plane, 0 away from it, outside the image and where there is no surface.
float edgeWeight(Plane plane, ivec2 q, out uint sdf) {
  sdf = 0u;
  if (any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, textureSize(depth, 0)))) return 0.0;
  const uint packed = texelFetch(depth, q, 0).x;
  sdf = unpackSdf(packed);
  const float z = unpackDepth(packed);
  if (z == 0.0) return 0.0;
  return clamp((settings.planeFar - planeDistance(plane, q, z)) / (settings.planeFar - settings.planeNear), 0.0, 1.0);
}

struct Trace {
  float weight;  // Smallest edge weight met on the segment.
  int edge;      // Step at which it became 0; steps + 1 where it did not.
};

// Walk from `p` in `direction` up to `steps` pixels. Each pixel's signed distance says how far the next edge lay in the
// last iteration; the walk steps by a fraction of it. Without edge tracing only the far end is looked at.
Trace traceEdge(Plane plane, ivec2 p, ivec2 direction, int steps, uint sdf) {
  Trace trace = Trace(1.0, steps + 1);
  int step = 0;
  while (step < steps) {
    step = kTraceEdges ? min(step + max(int(settings.sdfFraction * float(sdf)), 1), steps) : steps;
    trace.weight = min(trace.weight, edgeWeight(plane, p + step * direction, sdf));
    if (trace.weight <= 0.0) {
      trace.edge = step;
      break;
    }
  }
  return trace;
}

#endif
