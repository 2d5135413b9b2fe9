// Pixels of surfaces, and pairs of them on one surface.
// Needs: `frame` (FrameConstants), the texture `depth`, common/finite.glsl.
#ifndef WALR_LINT_SURFACES_GLSL
#define WALR_LINT_SURFACES_GLSL

bool inside(ivec2 p) { return all(lessThan(p, textureSize(depth, 0))); }
bool isSurfaceDepth(float z) { return isFinite(z) && z > 0.0 && z < frame.skyDepth; }
bool isInfinity(float x) { return floatBitsToUint(x) == 0x7f800000u; }

float depthAt(ivec2 p) { return texelFetch(depth, p, 0).x; }

// Whether two pixels with these depths and normals, which need not be of unit length, lie on one surface. `z`: of a
// surface.
bool areOnOneSurface(float z, vec3 n, float otherDepth, vec3 otherNormal) {
  const bool near = isSurfaceDepth(otherDepth) && abs(otherDepth - z) <= 0.02 * z;
  return near && dot(n, otherNormal) >= 0.99 * length(n) * length(otherNormal);
}

#endif
