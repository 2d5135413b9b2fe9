// Edge-stopping function between blocks and pixels (Meunier & Harada 2022, 4.3). Needs: `constants`
// (BlockRegressionConstants).
#ifndef WALR_BLOCK_PLANE_GLSL
#define WALR_BLOCK_PLANE_GLSL

// 1 near the plane, 0 away from it.
float onPlane(float distance) {
  return clamp((constants.planeFar - distance) / (constants.planeFar - constants.planeNear), 0.0, 1.0);
}

float facing(vec3 a, vec3 b) { return clamp(dot(a, b), 0.0, 1.0); }

#endif
