// Whether light holds albedo, by a pair of pixels on one surface with different albedo (lint_inputs.h).
// Needs: lint/lint_inputs.h.
#ifndef WALR_ALBEDO_CONTRAST_GLSL
#define WALR_ALBEDO_CONTRAST_GLSL

// Class of the contrast of the pair's albedo, from 1 on; 0: it is too small.
// `follows`: the light's contrast is nearer to that of albedo than to none. Light that ignores albedo lies on either side
// of none at random, light that holds it on either side of albedo's.
uint albedoContrast(vec3 light, vec3 otherLight, vec3 albedo, vec3 otherAlbedo, out bool follows) {
  // The channel in which their albedo differs most.
  float ofAlbedo = 0.0, ofLight = 0.0;  // Octaves.
  for (int c = 0; c < 3; ++c) {
    if (!(min(albedo[c], otherAlbedo[c]) >= kAlbedoLeast && min(light[c], otherLight[c]) > 0.0)) continue;
    const float contrast = log2(albedo[c] / otherAlbedo[c]);
    if (!(abs(contrast) > abs(ofAlbedo))) continue;
    ofAlbedo = contrast;
    ofLight = log2(light[c] / otherLight[c]);
  }
  follows = ofLight * sign(ofAlbedo) > 0.5 * abs(ofAlbedo);
  return uint(min(abs(ofAlbedo) / kAlbedoContrastStep, float(kAlbedoContrasts)));
}

#endif
