// Textures as samples/render/texture.cpp samples them: bilinear between linear values, with the roundings of float, which the
// filters of texture units do not have.
struct Neighbors {
  uint first;
  uint second;
  float fraction;  // Weight of `second`.
};

Neighbors findNeighbors(float coordinate, uint size, uint sampling, uint wrap) {
  const uint kRepeat = 0u;
  const uint kMirroredRepeat = 2u;
  // A float from 2^24 on has no fractional part. NaN fails the comparison.
  float place = abs(coordinate) < 16777216.0 ? coordinate : 0.0;
  if (wrap == kRepeat) {
    place -= floor(place);
  } else if (wrap == kMirroredRepeat) {
    const float folded = place - 2.0 * floor(0.5 * place);
    place = folded <= 1.0 ? folded : 2.0 - folded;
  } else {
    place = clamp(place, 0.0, 1.0);
  }
  const uint last = size - 1u;
  const float texel = place * float(size);
  if ((sampling & kNearest) != 0u) {
    const uint index = min(uint(texel), last);
    return Neighbors(index, index, 0.0);
  }
  const float corner = floor(texel - 0.5);
  const bool before = corner < 0.0;
  const uint beyond = wrap == kRepeat ? 0u : last;
  Neighbors result;
  result.first = before ? last - beyond : min(uint(corner), last);
  result.second = before ? 0u : (result.first == last ? beyond : result.first + 1u);
  result.fraction = texel - 0.5 - corner;
  return result;
}

// @param color  offset of the table of colour values of bytes: `kSrgbTable` or `kLinearTable`
vec4 fetchTexel(TextureData image, uint column, uint row, uint color) {
  const uint texel = texels[image.texels + row * image.width + column];
  return vec4(byteValues[color + (texel & 255u)], byteValues[color + ((texel >> 8) & 255u)],
              byteValues[color + ((texel >> 16) & 255u)], byteValues[kLinearTable + (texel >> 24)]);
}

vec4 sampleTexture(uint index, vec2 uv, uint color) {
  const TextureData image = textures[index];
  const Neighbors x = findNeighbors(uv.x, image.width, image.sampling, image.sampling & kWrapBits);
  const Neighbors y = findNeighbors(uv.y, image.height, image.sampling, (image.sampling >> 2) & kWrapBits);
  return mix(mix(fetchTexel(image, x.first, y.first, color), fetchTexel(image, x.second, y.first, color), x.fraction),
             mix(fetchTexel(image, x.first, y.second, color), fetchTexel(image, x.second, y.second, color), x.fraction),
             y.fraction);
}
