// Ambient occlusion from the depth buffer (passes/WALR.md, 1; after Bavoil et al. 2008): the mean over eight directions
// of the sine of the horizon above the tangent plane. Each occluder fades out towards the search radius. The pattern is
// the same at every pixel and not random: a noisy feature of the regression would print its noise into the result.
// Needs: `frame` (FrameConstants), `surfaceDepthAt(ivec2 p, float skyDepth)`: view depth, 0 outside the image and on
// sky.
#ifndef WALR_AMBIENT_OCCLUSION_GLSL
#define WALR_AMBIENT_OCCLUSION_GLSL
#include "camera.glsl"

// Ambient occlusion, 0 (open) to 1, of a surface at depth `z` whose unit normal `normal` faces the camera.
// `radius`: search radius, pixels. `steps`: pixels looked at per direction; their distances grow with the square of the
// step.
float ambientOcclusion(ivec2 p, float z, vec3 normal, float radius, int steps) {
  const vec3 ray = rayThrough(frame.rayFromPixel, pixelCentre(p));
  // Lengths are in units of the pixel's depth, so that no scale of the scene over- or underflows.
  const float inverseDepth = 1.0 / z;
  const float reach = radius * abs(frame.rayFromPixel.x);
  const float falloff = 1.0 / (reach * reach);
  // Copied once: Mesa's llvmpipe would load them at every tap, a tenth of the time.
  const vec2 pixel = frame.rayFromPixel.xy;
  const float skyDepth = frame.skyDepth;
  // All directions in the inner loop, so that their fetches overlap.
  float horizon[9] = float[](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
  for (int step = 1; step <= steps; ++step) {
    const float share = float(step) / float(steps);
    const int distance = max(int(radius * share * share), step);
    [[unroll]] for (int i = 0; i < 9; ++i) {
      if (i != 4) {
        const ivec2 direction = ivec2(i % 3, i / 3) - 1;
        const float zq = surfaceDepthAt(p + distance * direction, skyDepth);
        const vec2 offset = float(distance) * vec2(direction) * pixel;  // From this ray to the tap's.
        const vec3 v = zq * inverseDepth * (ray + vec3(offset, 0.0)) - ray;
        const float squared = max(dot(v, v), 1e-12);
        const float sine = max(1.0 - squared * falloff, 0.0) * dot(normal, v) * inversesqrt(squared);
        horizon[i] = max(horizon[i], zq > 0.0 ? sine : 0.0);
      }
    }
  }
  float sum = 0.0;
  [[unroll]] for (int i = 0; i < 9; ++i) sum += horizon[i];
  return sum / 8.0;
}

#endif
