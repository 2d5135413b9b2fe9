// The sky as in samples/render/sky.cpp. The map lies in `sky`: 3 floats a texel, then the cumulative probabilities of rows, then
// those of columns within each row.
uint skyRows() { return 3u * trace.skySize.x * trace.skySize.y; }
uint skyColumns(uint row) { return skyRows() + trace.skySize.y + row * trace.skySize.x; }

// Position in the map, both coordinates in 0..1.
vec2 placeOf(vec3 direction) {
  return vec2(0.5 + angleOf(direction.x, -direction.z) / (2.0 * kPi), arcCosine(clamp(direction.y, -1.0, 1.0)) / kPi);
}

vec3 directionOf(vec2 place) {
  const vec2 around = cosineAndSine(place.x + 0.5);  // A whole turn more than `place.x - 0.5`.
  const vec2 polar = cosineAndSine(0.5 * place.y);
  return vec3(polar.y * around.y, polar.x, -polar.y * around.x);
}

vec3 skyTexel(ivec2 at) {
  const ivec2 size = ivec2(trace.skySize);
  const int x = (at.x + size.x) % size.x;
  const int y = clamp(at.y, 0, size.y - 1);
  const uint first = 3u * uint(y * size.x + x);
  return vec3(sky[first], sky[first + 1u], sky[first + 2u]);
}

vec3 skyRadiance(vec3 direction) {
  if (trace.skySize.x == 0u) return trace.skyRadiance.rgb;
  const vec2 place = placeOf(direction) * vec2(trace.skySize) - 0.5;
  const vec2 corner = floor(place);
  const vec2 fraction = place - corner;
  const ivec2 at = ivec2(corner);
  return mix(mix(skyTexel(at), skyTexel(at + ivec2(1, 0)), fraction.x),
             mix(skyTexel(at + ivec2(0, 1)), skyTexel(at + ivec2(1, 1)), fraction.x), fraction.y);
}

float shareOf(uint cumulative, uint index) {
  return sky[cumulative + index] - (index > 0u ? sky[cumulative + index - 1u] : 0.0);
}

// Inverts a cumulative distribution: the entry that a number in [0, 1) falls into, plus its relative position there.
float pick(uint cumulative, uint count, float random, out uint index) {
  uint low = 0u;
  uint high = count - 1u;
  while (low < high) {
    const uint middle = (low + high) / 2u;
    if (random < sky[cumulative + middle]) {
      high = middle;
    } else {
      low = middle + 1u;
    }
  }
  index = low;
  const float share = shareOf(cumulative, low);
  const float before = low > 0u ? sky[cumulative + low - 1u] : 0.0;
  return share > 0.0 ? (random - before) / share : 0.5;
}

bool skyIsSampled() { return (trace.flags & kSkySampled) != 0u; }

float skyDensity(vec3 direction) {
  const vec2 place = placeOf(direction);
  const uvec2 texel = min(uvec2(max(place, 0.0) * vec2(trace.skySize)), trace.skySize - 1u);
  const float share = shareOf(skyRows(), texel.y) * shareOf(skyColumns(texel.y), texel.x);
  // The Jacobian from the map's unit square to solid angle is 2 pi^2 sin(polar angle).
  const float sine = cosineAndSine(0.5 * place.y).y;
  const float texelCount = float(trace.skySize.x) * float(trace.skySize.y);
  return sine > 0.0 ? share * texelCount / (2.0 * kPi * kPi * sine) : 0.0;
}

vec3 sampleSky(vec2 random) {
  uint row;
  uint column;
  const float down = pick(skyRows(), trace.skySize.y, random.y, row);
  const float right = pick(skyColumns(row), trace.skySize.x, random.x, column);
  return directionOf(vec2((float(column) + right) / float(trace.skySize.x), (float(row) + down) / float(trace.skySize.y)));
}
