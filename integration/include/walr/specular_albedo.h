/* For hosts, in C, C++ and GLSL: the directional albedo of glTF's specular lobe, by which reflected light is
 * divided before walr and multiplied after.
 *
 * The lobe is GGX with alpha = roughness * roughness, Smith's height-correlated masking and Schlick's Fresnel term
 * (glTF 2.0, appendix B), without multiple scattering. Its albedo is the share of light that it reflects to the viewer
 * under a uniform sky: f0 * A + B, with A = E * (1 - F) and B = E * F, where E is the albedo of a lobe that reflects
 * all (f0 = 1), and F the mean of Schlick's (1 - cosine)^5. Both are fits to numerical integrals for cosines from .02
 * on. E errs by at most .015, and the albedo of a dielectric (f0 = .04) by at most 7 %. */
#ifndef WALR_SPECULAR_ALBEDO_H
#define WALR_SPECULAR_ALBEDO_H

#if defined(__cplusplus)
#include <cmath>
#define WALR_SPECULAR_FUNCTION inline
#define WALR_SPECULAR_ROOT std::sqrt
#elif defined(__STDC__)
#include <math.h>
#define WALR_SPECULAR_FUNCTION static inline
#define WALR_SPECULAR_ROOT sqrtf
#else
#define WALR_SPECULAR_FUNCTION
#define WALR_SPECULAR_ROOT sqrt
#endif

/* f0: reflectance at normal incidence, one colour channel, 0 to 1; roughness: linear as in glTF, 0 to 1; cosine:
 * between normal and view direction, 0 to 1. At least .02, so that light can be divided by it. */
WALR_SPECULAR_FUNCTION float walrSpecularAlbedo(float f0, float roughness, float cosine) {
  float alpha = roughness * roughness;
  float spread = WALR_SPECULAR_ROOT(alpha * alpha + cosine * cosine);
  float seen = spread > 0.0f ? cosine / spread : 1.0f;
  float reflected = 0.969f + seen * seen * seen * (0.9085f * seen - 0.8836f) +
                    alpha * (alpha * (0.6551f * cosine - 3.0158f * seen) +
                             cosine * seen * (4.2097f - 3.551f * seen - 0.4237f * cosine));
  float bent = 1.0f - 0.7041f * cosine - (0.2822f - 0.4792f * roughness) * spread -
               roughness * (0.4451f + 0.2005f * roughness - 0.279f * seen);
  float fresnel = bent > 0.0f ? bent * bent * bent * bent * bent : 0.0f;
  float albedo = reflected * (f0 + (1.0f - f0) * fresnel);
  return albedo < 0.02f ? 0.02f : albedo > 1.0f ? 1.0f : albedo;
}

#undef WALR_SPECULAR_FUNCTION
#undef WALR_SPECULAR_ROOT
#endif
