// Ambient occlusion from the depth buffer (passes/WALR.md, 1; after Bavoil et al. 2008): the mean over eight directions
// of the sine of the horizon above the tangent plane. Each occluder fades out towards the search radius. The pattern is
// the same at every pixel and not random: a noisy feature of the regression would print its noise into the result. Rings
// of four pixels on the axes and on the diagonals take turns, so that 16 pixels see occluders at four distances.
// Needs: `frame`, `guideConstants`, `hostDepth`, `Surface`, `kOcclusionRings`.
#ifndef WALR_AMBIENT_OCCLUSION_GLSL
#define WALR_AMBIENT_OCCLUSION_GLSL

// Ambient occlusion of the surface that a pixel shows, 0 (open) to 1.
float ambientOcclusion(ivec2 p, Surface surface, uint depthEnd) {
  const vec3 ray = surface.ray;
  const vec2 pixel = frame.rayFromPixel.xy;
  const float raySquared = dot(ray, ray);
  const float inverseReach = guideConstants.inverseOcclusionRadius * frame.pixelFromRay.x;
  const float falloff = inverseReach * inverseReach;
  // Depths that are much nearer are out of reach and would overflow.
  const uint nearest = floatBitsToUint(surface.depth * 1e-6);
  const uvec2 last = uvec2(textureSize(hostDepth, 0) - 1);

  // All directions in the inner loop, so that their fetches overlap.
  float horizon[9] = float[](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
  [[unroll]] for (int ring = 0; ring < kOcclusionRings; ++ring) {
    const float distance = guideConstants.occlusionDistances[ring];
    const float inverseDistance = guideConstants.inverseOcclusionDistances[ring];
    const float fadeScale = distance * distance * falloff;
    const float scaledDepth = surface.depth * inverseDistance;
    [[unroll]] for (int i = 0; i < 9; ++i) {
      if (i != 4 && i % 2 != ring % 2) {
        const ivec2 direction = ivec2(i % 3, i / 3) - 1;
        const uvec2 q = uvec2(p + int(distance) * direction);  // Larger than any image where it is negative.
        const float z = texelFetch(hostDepth, ivec2(min(q, last)), 0).x;
        const bool inside = all(lessThanEqual(q, last));
        const bool occludes = floatBitsToUint(z) - nearest < depthEnd - nearest;
        // The vector to the tap is distance * z * (offset + slope * ray). What does not depend on z is the same for all
        // rings.
        const vec2 offset = vec2(direction) * pixel;
        const float slope = inverseDistance - scaledDepth / z;
        const float squared = dot(offset, offset) + slope * (2.0 * dot(offset, ray.xy) + slope * raySquared);
        const float fade = clamp(1.0 - fadeScale * squared, 0.0, 1.0);
        const float sine = (dot(offset, surface.normal.xy) + slope * surface.facing) * inversesqrt(squared);
        horizon[i] = max(horizon[i], inside && occludes ? fade * sine : 0.0);
      }
    }
  }
  float sum = 0.0;
  [[unroll]] for (int i = 0; i < 9; ++i) sum += horizon[i];
  return sum / 8.0;
}

#endif
