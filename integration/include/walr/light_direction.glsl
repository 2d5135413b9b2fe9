// For shaders of hosts: evaluates the light direction that walr writes with WalrDenoiserInfo::light_direction, an image of
// format R32G32_UINT (the integration guide, "Light for other normals"). GLSL 3.30 or later.
//
//   uvec2 direction = texelFetch(lightDirection, pixel, 0).xy;  // usampler2D
//   vec3 light = walrLightFor(denoised, direction, viewNormal, viewMappedNormal);
#ifndef WALR_LIGHT_DIRECTION_GLSL
#define WALR_LIGHT_DIRECTION_GLSL

// Slopes of the light: column i holds its change, RGB, over that of the normal's component i, view space. They are
// linear, in the unit of the light without exposure: with WalrConventions::pre_exposed, multiply them by the frame's
// WalrFrame::pre_exposure.
mat3 walrLightSlopes(uvec2 direction) {
  float unit = uintBitsToFloat((direction.y >> 24) << 23);
  mat3 slopes;
  for (int i = 0; i < 9; ++i) {
    int word = int(i < 5 ? direction.x : direction.y);
    slopes[i % 3][i / 3] = unit * float((word << (26 - 6 * (i % 5))) >> 26);
  }
  return slopes;
}

// Denoised light as it would be with another normal.
// denoised: of the pixel; normal: the one that the denoiser got; other: the one to shade with. Both are of unit length, in
// view space, where the camera looks down -z and y is up.
vec3 walrLightFor(vec3 denoised, uvec2 direction, vec3 normal, vec3 other) {
  return max(denoised + walrLightSlopes(direction) * (other - normal), vec3(0.0));
}

#endif
