// Moments of WALR over pixels: what regression needs to know of a window. Means of the features X and the colour Y, and
// their covariances XX and XY. Centred moments lose nothing to cancellation in half precision; raw moments lose all
// precision where features hardly vary.
#ifndef WALR_MOMENTS_GLSL
#define WALR_MOMENTS_GLSL
#include "common/luminance.glsl"

struct Moments {
  vec2 x;          // Mean of the features u, v.
  vec3 y;          // Mean of the colour.
  vec3 xx;         // Covariances uu, uv, vv.
  vec3 yu, yv;     // Covariances of the colour with u and with v.
  float luma2;     // Mean of the squared luminance.
  float samples;   // W: sum of the sample weights.
};

// Moments of one pixel: covariances are 0. It weighs nothing without a sample (history length 0: all of its samples
// were NaN or infinite).
Moments momentsOf(vec2 features, vec4 accumulated) {
  const float l = luminance(accumulated.rgb);
  return Moments(features, accumulated.rgb, vec3(0.0), vec3(0.0), vec3(0.0), l * l, accumulated.a > 0.0 ? 1.0 : 0.0);
}

// Weighted merge of centred moments in one pass, C = sum w (C_i + (m_i - M)(m_i - M)^T) / sum w. Means are taken
// relative to the first moments, those of the window's centre, which are near M.
struct MomentSum {
  vec2 originX;
  vec3 originY;
  Moments sum;
};

MomentSum startSum(Moments centre) {
  MomentSum s;
  s.originX = centre.x;
  s.originY = centre.y;
  s.sum = Moments(vec2(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0);
  return s;
}

void add(inout MomentSum s, float edgeWeight, Moments m) {
  const float w = edgeWeight * m.samples;
  const vec2 dx = m.x - s.originX;
  const vec3 dy = m.y - s.originY;
  s.sum.x += w * dx;
  s.sum.y += w * dy;
  s.sum.xx += w * (m.xx + vec3(dx.x * dx.x, dx.x * dx.y, dx.y * dx.y));
  s.sum.yu += w * (m.yu + dy * dx.x);
  s.sum.yv += w * (m.yv + dy * dx.y);
  s.sum.luma2 += w * m.luma2;
  s.sum.samples += w;
}

// Adds a sum with the same origin.
void join(inout MomentSum s, MomentSum part) {
  s.sum.x += part.sum.x;
  s.sum.y += part.sum.y;
  s.sum.xx += part.sum.xx;
  s.sum.yu += part.sum.yu;
  s.sum.yv += part.sum.yv;
  s.sum.luma2 += part.sum.luma2;
  s.sum.samples += part.sum.samples;
}

// The merged moments; those of the centre with weight 0 if there is no sample.
Moments finish(MomentSum s) {
  const float scale = s.sum.samples > 0.0 ? 1.0 / s.sum.samples : 0.0;
  const vec2 dx = s.sum.x * scale;
  const vec3 dy = s.sum.y * scale;
  Moments m;
  m.x = s.originX + dx;
  m.y = s.originY + dy;
  m.xx = s.sum.xx * scale - vec3(dx.x * dx.x, dx.x * dx.y, dx.y * dx.y);
  m.yu = s.sum.yu * scale - dy * dx.x;
  m.yv = s.sum.yv * scale - dy * dx.y;
  m.luma2 = s.sum.luma2 * scale;
  m.samples = s.sum.samples;
  return m;
}

#endif
