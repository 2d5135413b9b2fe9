// The edge-stopping function between blocks and pixels (Meunier & Harada 2022, 4.3; passes/WALR.md, 4).
// Needs: `constants` (BlockRegressionConstants).
#ifndef WALR_BLOCK_PLANE_GLSL
#define WALR_BLOCK_PLANE_GLSL

// e(distance): 1 up to plane-near, 0 from plane-far on, linear between. `distance` is in units of depth.
float edgeStopping(float distance) {
  return clamp(constants.planeOffset - constants.planeScale * distance, 0.0, 1.0);
}

// Cosine between two normals, 0 where they face away from each other.
float normalCosine(vec3 a, vec3 b) { return clamp(dot(a, b), 0.0, 1.0); }

#endif
