// The eight taps of an a-trous iteration over pixels: edge tracing along axes and diagonals (Meunier & Harada 2022, 3.3
// and 5.2), and the replacement of taps behind an edge.
// Needs: `frame` (FrameConstants), `depth`, `planeNormal` (utexture2D), `constants` (AtrousConstants), and the
// specialization constants of atrous.comp.
// FIRST: this is the first iteration, whose taps are the adjacent pixels.
#ifndef WALR_EDGE_TRACING_GLSL
#define WALR_EDGE_TRACING_GLSL
#include "common/hash.glsl"
#include "conventions/plane.glsl"
#include "conventions/surface.glsl"

// Values of kReplacement (TapReplacement).
const uint kNoReplacement = 0;
const uint kNearReplacement = 2;     // One of the last third before the edge.

// The pixel that is filtered.
struct Centre {
  ivec2 pixel;
  ivec2 size;  // Of the image.
  Plane plane;
  float scale;  // 1 / (planeFar - planeNear).
  uint sdf;     // Distance to the nearest edge that the previous iteration found, steps.
};

// What the traces to all eight taps found.
struct TraceSummary {
  int nearestEdge;  // Step of the nearest edge; kSpacing + 1: none.
  int replaced;     // Taps that another pixel replaced.
  int lost;         // Taps behind an edge that none replaced.
  int centred;      // Taps that the centre replaced.
};

// Where a tap is taken, and its weight. At weight 0 it is not read.
struct Tap {
  ivec2 pixel;
  float weight;
};

// A straight line of pixels away from the centre.
struct Line {
  ivec2 direction;
  int inside;    // Number of steps to the border of the image.
  float offset;  // dot(normal of the centre's plane, ray of the centre) / depth of the centre.
  float slope;   // Change of `offset` per step: the rays of evenly spaced pixels are evenly spaced.
};

Line lineFrom(Centre centre, ivec2 direction) {
  const ivec2 room = mix(centre.pixel, centre.size - 1 - centre.pixel, greaterThan(direction, ivec2(0)));
  const ivec2 inside = mix(ivec2(kSpacing), room, notEqual(direction, ivec2(0)));
  const Plane plane = centre.plane;
  const float slope = dot(plane.normal.xy * frame.rayFromPixel.xy, vec2(direction));
  return Line(direction, min(inside.x, inside.y), plane.offset * plane.inverseDepth, slope * plane.inverseDepth);
}

// What the edge-stopping function needs of one pixel.
struct TracedPixel {
  float distance;  // From the centre's plane. planeFar where there is no surface.
  bool surface;    // False outside the image.
  uint sdf;
};

TracedPixel tracePixel(Centre centre, Line line, int step) {
  uint packedDepth = texelFetch(depth, centre.pixel + min(step, line.inside) * line.direction, 0).x;
  if (step > line.inside) packedDepth = 0u;
  const float z = unpackDepth(packedDepth);
  const float distance = abs(z * (line.offset + float(step) * line.slope) - centre.plane.offset);
  return TracedPixel(z > 0.0 ? distance : constants.planeFar, z > 0.0, unpackSdf(packedDepth));
}

// The smallest value of the edge-stopping function on the way to a tap (Meunier & Harada 2022, 4.3), from the largest
// distance on it; 0 or less at an edge.
float traceWeight(Centre centre, float distance) { return min((constants.planeFar - distance) * centre.scale, 1.0); }

// Step of the pixel that replaces a tap whose trace met its edge at step `edge`.
int replacementStep(ivec2 p, int tap, int edge) {
  const uvec4 seed = uvec4(p, frame.frameIndex, kIteration * 9u + uint(tap));
  return kReplacement == kNearReplacement ? edge - 1 - int(hashBelow(seed, uint(edge + 2) / 3u))
                                          : int(hashBelow(seed, uint(edge)));
}

// Finds tap number `tap` of 0 to 8, in `direction` = (tap % 3, tap / 3) - 1. Its weight is the smallest edge-stopping
// weight on the way to it. The trace steps by a fraction of the distance to the nearest edge that the previous
// iteration stored for the pixel. Without edge tracing only the far end is tested.
//
// A tap behind an edge is replaced by a random pixel before the edge, so that no seam shows the pattern of the taps.
// The same loop traces the way to the replacement, so that invocations of a subgroup do not wait for each other.
Tap findTap(Centre centre, int tap, ivec2 direction, inout TraceSummary summary) {
  const Line line = lineFrom(centre, direction);
  int edge = kSpacing + 1;  // Step of the first edge; kSpacing + 1: none.
  int reach = kSpacing;
  float distance = 0.0;  // The largest on the way.
  bool surface = false;  // The edge is a surface, not sky or the border of the image.
#ifdef FIRST
  const TracedPixel traced = tracePixel(centre, line, 1);
  distance = traced.distance;
  surface = traced.surface;
  if (distance >= constants.planeFar) edge = 1;
#else
  int step = 0;
  uint sdf = centre.sdf;
  while (step < reach) {
    step = kTraceEdges ? min(step + max(int(constants.sdfFraction * float(sdf)), 1), reach) : reach;
    const TracedPixel traced = tracePixel(centre, line, step);
    distance = max(distance, traced.distance);
    sdf = traced.sdf;
    if (distance >= constants.planeFar) {
      if (edge <= kSpacing) break;
      edge = step;
      surface = traced.surface;
      if (edge == 1 || kReplacement == kNoReplacement) break;
      reach = replacementStep(centre.pixel, tap, edge);
      step = 0;
      sdf = centre.sdf;
      distance = 0.0;
    }
  }
#endif
  float weight = traceWeight(centre, distance);
  summary.nearestEdge = min(summary.nearestEdge, edge);
  bool leak = false;
  if (edge <= kSpacing) {
    const bool isolated = edge == 1;
    if (isolated || reach == 0) weight = 0.0;
    if (kReplacement == kNoReplacement || (isolated && !kRepeatCentre)) {
      ++summary.lost;
    } else {
      ++summary.replaced;
      if (weight <= 0.0) ++summary.centred;
    }
    if (isolated && surface && kEdgeLeak > 0.0) {
      // A pixel with few neighbours on its surface takes a little light from beyond its edges.
      leak = true;
      reach = 1;
      weight = kEdgeLeak;
    }
  }
  const ivec2 q = centre.pixel + reach * direction;
  if (kNormalFactor && weight > 0.0 && !leak)
    weight *= clamp(dot(centre.plane.normal, unpackLongNormal(texelFetch(planeNormal, q, 0).x)), 0.0, 1.0);
  return Tap(q, weight);
}

#endif
