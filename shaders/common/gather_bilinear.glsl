#ifndef WALR_GATHER_BILINEAR_GLSL
#define WALR_GATHER_BILINEAR_GLSL

// Between four gathered texels; `f`: position between the first and the others, 0 to 1.
float bilinear(vec4 gathered, vec2 f) {
  const vec4 texels = gathered.wzxy;
  const vec2 rows = mix(texels.xz, texels.yw, f.x);
  return mix(rows.x, rows.y, f.y);
}

// Between four texels of an image that holds the bits of floats, in single precision, clamped at the borders. `base`:
// texel with the least coordinates, which may lie anywhere; `f`: position between it and the next ones, 0 to 1.
float gatherBilinear(usampler2D image, vec2 base, vec2 f) {
  return bilinear(uintBitsToFloat(textureGather(image, (base + 1.0) / vec2(textureSize(image, 0)))), f);
}

#endif
