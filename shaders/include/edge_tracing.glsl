// The eight taps of an a-trous iteration: edge tracing along axes and diagonals (Meunier & Harada 2022, 3.3 and 5.2),
// and what takes the place of a tap behind an edge. Needs: `frame` (FrameConstants), `depth`, `planeNormal`
// (utexture2D), `constants` (AtrousConstants), and atrous.comp's specialization constants. FIRST: of the first
// iteration, whose taps are the very next pixels.
#ifndef WALR_EDGE_TRACING_GLSL
#define WALR_EDGE_TRACING_GLSL
#include "hash.glsl"
#include "plane.glsl"
#include "surface.glsl"

// Values of kReplacement (TapReplacement).
const uint kNoReplacement = 0;
const uint kUniformReplacement = 1;  // Any pixel before the edge, the centre among them.
const uint kNearReplacement = 2;     // One of the last third before the edge.

// The pixel that is filtered.
struct Centre {
  ivec2 pixel;
  ivec2 size;  // Of the image.
  Plane plane;
  float scale;  // Of the fall of the edge weight from planeNear to planeFar.
  uint sdf;
};

// What the traces to all eight taps found.
struct TraceSummary {
  int nearestEdge;
  int replaced;
  int lost;
  int centred;  // Replaced by the centre.
};

// Where a tap is taken and what it weighs; nowhere where that is 0.
struct Tap {
  ivec2 pixel;
  float weight;
};

// A straight line of pixels away from the centre.
struct Line {
  ivec2 direction;
  int inside;    // Steps up to the border of the image.
  float offset;  // Product of the plane's normal with the centre's ray, over the centre's depth.
  float slope;   // How much that grows from step to step: rays of a line of pixels lie evenly on a line.
};

Line lineFrom(Centre centre, ivec2 direction) {
  const ivec2 room = mix(centre.pixel, centre.size - 1 - centre.pixel, greaterThan(direction, ivec2(0)));
  const ivec2 inside = mix(ivec2(kSpacing), room, notEqual(direction, ivec2(0)));
  const Plane plane = centre.plane;
  const float slope = dot(plane.normal.xy * frame.rayFromPixel.xy, vec2(direction));
  return Line(direction, min(inside.x, inside.y), plane.offset * plane.inverseDepth, slope * plane.inverseDepth);
}

// What the edge-stopping function (Meunier & Harada 2022, 4.3) makes of one pixel.
struct TracedPixel {
  float weight;  // 1 or more near the plane; 0 or less at an edge.
  bool surface;  // None outside the image.
  uint sdf;
};

TracedPixel tracePixel(Centre centre, Line line, int step) {
  uint packedDepth = texelFetch(depth, centre.pixel + min(step, line.inside) * line.direction, 0).x;
  if (step > line.inside) packedDepth = 0u;
  const float z = unpackDepth(packedDepth);
  const float distance = abs(z * (line.offset + float(step) * line.slope) - centre.plane.offset);
  const float weight = (constants.planeFar - distance) * centre.scale;
  return TracedPixel(z > 0.0 ? weight : 0.0, z > 0.0, unpackSdf(packedDepth));
}

// Step of the pixel that stands in for a tap which met its edge at step `edge`.
int replacementStep(ivec2 p, int tap, int edge) {
  const uvec4 key = uvec4(p, frame.frameIndex, kIteration * 9u + uint(tap));
  return kReplacement == kNearReplacement ? edge - 1 - int(hashBelow(key, uint(edge + 2) / 3u))
                                          : int(hashBelow(key, uint(edge)));
}

// Tap number `tap` of 0 to 8, `direction` being (tap % 3, tap / 3) - 1, with the smallest edge weight on the way to it.
// Each pixel's signed distance says how far the next edge lay in the last iteration; the walk steps by a fraction of it.
// Without edge tracing only the far end is looked at.
//
// A tap behind an edge gives way to a random one before it, so that no seam follows the tap pattern. The way there is
// walked in the same loop, side by side with invocations that are still on their first.
Tap findTap(Centre centre, int tap, ivec2 direction, inout TraceSummary summary) {
  const Line line = lineFrom(centre, direction);
  int edge = kSpacing + 1;  // Step of the first edge.
  int reach = kSpacing;
  float weight = 1.0;
  bool surface = false;  // At the edge.
#ifdef FIRST
  const TracedPixel traced = tracePixel(centre, line, 1);
  weight = min(traced.weight, 1.0);
  surface = traced.surface;
  if (weight <= 0.0) edge = 1;
#else
  int step = 0;
  uint sdf = centre.sdf;
  while (step < reach) {
    step = kTraceEdges ? min(step + max(int(constants.sdfFraction * float(sdf)), 1), reach) : reach;
    const TracedPixel traced = tracePixel(centre, line, step);
    weight = min(weight, traced.weight);
    sdf = traced.sdf;
    if (weight <= 0.0) {
      if (edge <= kSpacing) break;
      edge = step;
      surface = traced.surface;
      if (edge == 1 || kReplacement == kNoReplacement) break;
      reach = replacementStep(centre.pixel, tap, edge);
      step = 0;
      sdf = centre.sdf;
      weight = 1.0;
    }
  }
#endif
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
      // A pixel that shares its surface with few around it takes a little from beyond its edges.
      leak = true;
      reach = 1;
      weight = kEdgeLeak;
    }
  }
  const ivec2 q = centre.pixel + reach * direction;
  if (kNormalFactor && weight > 0.0 && !leak)
    weight *= clamp(dot(centre.plane.normal, unpackNormal(texelFetch(planeNormal, q, 0).x)), 0.0, 1.0);
  return Tap(q, weight);
}

#endif
