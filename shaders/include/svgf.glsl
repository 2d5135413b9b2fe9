// Shared by the passes of SVGF: how colour and variance are stored, and the edge-stopping functions W_Z and W_N, which
// need no colour (Fu 2022).
// Needs: `frame` (FrameConstants), `depth`, `shadingNormal`, `geometricNormal` (utexture2D), `constants`
// (SvgfFilterConstants).
#ifndef WALR_SVGF_GLSL
#define WALR_SVGF_GLSL
#include "plane.glsl"
#include "surface.glsl"

// Alpha holds the standard deviation of luminance: the variance would overflow a half from 256 on. Below 0 the pixel
// has no sample yet: its neighbours do not use it, and it takes its value from them.
const float kNoSample = -1.0;

struct Surface {
  Plane plane;
  vec3 normal;  // Shading normal.
};

Surface surfaceAt(ivec2 p, float z) {
  return Surface(planeAt(p, z, unpackNormal(texelFetch(geometricNormal, p, 0).x)),
                 unpackNormal(texelFetch(shadingNormal, p, 0).x));
}

// W_Z W_N of pixel `q`; 0 outside the image and where there is nothing to denoise. W_Z uses the distance from the
// tangent plane, which is the difference in depth beyond the depth gradient: it is 1 everywhere on a plane.
float surfaceWeight(Surface surface, ivec2 q) {
  if (any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, textureSize(depth, 0)))) return 0.0;
  const float z = unpackDepth(texelFetch(depth, q, 0).x);
  if (z == 0.0) return 0.0;
  const vec3 normal = unpackNormal(texelFetch(shadingNormal, q, 0).x);
  const float cosine = clamp(dot(surface.normal, normal), 1e-6, 1.0);
  return exp(-planeDistance(surface.plane, q, z) * constants.inverseSigmaDepth) * pow(cosine, constants.sigmaNormal);
}

#endif
