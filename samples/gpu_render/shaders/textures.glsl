// Textures as samples/render/texture.cpp samples them: bilinear between linear values, with the roundings of float, which the
// filters of texture units do not have.
#include "samples/render/exact/texel.h"

// @param color  offset of the table of colour values of bytes: `kSrgbTable` or `kLinearTable`
vec4 fetchTexel(TextureData image, uint column, uint row, uint color) {
  const uint texel = texels[image.texels + row * image.width + column];
  return vec4(byteValues[color + (texel & 255u)], byteValues[color + ((texel >> 8) & 255u)],
              byteValues[color + ((texel >> 16) & 255u)], byteValues[kLinearTable + (texel >> 24)]);
}

vec4 sampleTexture(uint index, vec2 uv, uint color) {
  const TextureData image = textures[index];
  const bool nearest = (image.sampling & kNearest) != 0u;
  const Neighbors x = neighborsOf(uv.x, image.width, image.sampling & kWrapBits, nearest);
  const Neighbors y = neighborsOf(uv.y, image.height, (image.sampling >> 2) & kWrapBits, nearest);
  return blend(blend(fetchTexel(image, x.first, y.first, color), fetchTexel(image, x.second, y.first, color), x.fraction),
               blend(fetchTexel(image, x.first, y.second, color), fetchTexel(image, x.second, y.second, color), x.fraction),
               y.fraction);
}
