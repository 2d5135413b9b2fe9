// Ambient occlusion by what the depth buffer shows around a pixel: the mean over eight directions of the sine at which
// the horizon stands above the tangent plane (after Bavoil et al. 2008), each occluder fading out at the search radius.
// Same pattern at every pixel and no randomness: it serves as a feature of the regression, and a noisy feature would
// print its noise.
// Needs: `frame` (FrameConstants), `surfaceDepthAt(ivec2 p, float skyDepth)`: view depth, 0 outside the picture and on sky.
#ifndef WALR_AMBIENT_OCCLUSION_GLSL
#define WALR_AMBIENT_OCCLUSION_GLSL
#include "camera.glsl"

// At a surface of depth `z` and normal `normal`, towards the camera.
// `radius`: pixels; `steps`: of a direction, their distances grow with the square, from one pixel on.
float ambientOcclusion(ivec2 p, float z, vec3 normal, float radius, int steps) {
  const vec3 ray = rayThrough(frame.rayFromPixel, pixelCentre(p));
  // Lengths in units of the pixel's depth, so that no scale over- or underflows.
  const float inverseDepth = 1.0 / z;
  const float reach = radius * abs(frame.rayFromPixel.x);
  const float falloff = 1.0 / (reach * reach);
  // Read once: llvmpipe would read them at every tap, which is a tenth of the time.
  const vec2 pixel = frame.rayFromPixel.xy;
  const float skyDepth = frame.skyDepth;
  // All directions side by side: their fetches do not wait for each other, and distances are the same for all pixels.
  float horizon[9] = float[](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
  for (int step = 1; step <= steps; ++step) {
    const float share = float(step) / float(steps);
    const int distance = max(int(radius * share * share), step);
    [[unroll]] for (int i = 0; i < 9; ++i) {
      if (i != 4) {
        const ivec2 direction = ivec2(i % 3, i / 3) - 1;
        const float zq = surfaceDepthAt(p + distance * direction, skyDepth);
        const vec2 turn = float(distance) * vec2(direction) * pixel;  // Of the ray.
        const vec3 v = zq * inverseDepth * (ray + vec3(turn, 0.0)) - ray;
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
