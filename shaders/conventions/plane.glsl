// The tangent plane at a pixel, for edge-stopping. Distances from it are in units of the pixel's depth.
// Needs: `frame` (FrameConstants).
#ifndef WALR_PLANE_GLSL
#define WALR_PLANE_GLSL
#include "conventions/camera.glsl"

struct Plane {
  vec3 normal;
  float offset;        // dot(normal, ray of the pixel).
  float inverseDepth;
};

Plane planeAt(ivec2 p, float z, vec3 normal) {
  return Plane(normal, dot(normal, rayThrough(frame.rayFromPixel, pixelCentre(p))), 1.0 / z);
}

// Distance from the plane, over the depth of its pixel, of the surface that pixel `q` shows at depth `z`: delta in
// passes/WALR.md, 4.
float planeDistance(Plane plane, ivec2 q, float z) {
  const vec3 ray = rayThrough(frame.rayFromPixel, pixelCentre(q));
  return abs(z * plane.inverseDepth * dot(plane.normal, ray) - plane.offset);
}

#endif
