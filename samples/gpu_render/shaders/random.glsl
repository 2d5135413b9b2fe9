// The random numbers of samples/render/sampler.cpp, bit for bit. See there for what they are.
struct Random {
  uint seed;
  uint place;     // Position on the Z-order curve.
  uint sequence;
  uint index;
  uint dimension;
};

uint mixBits(uint x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  x ^= x >> 16;
  return x;
}

uint combine(uint a, uint b) { return mixBits(a ^ (b * 0x9e3779b9u + 0x7f4a7c15u)); }

uint laineKarras(uint x, uint seed) {
  x += seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return x;
}

uint owenScramble(uint x, uint seed) { return bitfieldReverse(laineKarras(bitfieldReverse(x), seed)); }

uint reversedSobolSecond(uint index) {
  index ^= (index >> 16) & 0x0000ffffu;
  index ^= (index >> 8) & 0x00ff00ffu;
  index ^= (index >> 4) & 0x0f0f0f0fu;
  index ^= (index >> 2) & 0x33333333u;
  index ^= (index >> 1) & 0x55555555u;
  return index;
}

uint spreadBits(uint x) {
  x &= 0x0000ffffu;
  x = (x | (x << 8)) & 0x00ff00ffu;
  x = (x | (x << 4)) & 0x0f0f0f0fu;
  x = (x | (x << 2)) & 0x33333333u;
  return (x | (x << 1)) & 0x55555555u;
}

// The 24 permutations of four quadrants, each as four numbers of two bits, the first in the lowest bits.
const uint kOrders[24] = uint[24](
    228u, 180u, 216u, 120u, 156u, 108u, 225u, 177u, 201u, 57u, 141u, 45u,
    210u, 114u, 198u, 54u, 78u, 30u, 147u, 99u, 135u, 39u, 75u, 27u);

uint shuffledZOrder(uint place, uint seed) {
  const uint kLevels = 14;
  uint shuffled = 0u;
  [[dont_unroll]] for (uint level = 0u; level < kLevels; ++level) {
    const uint shift = 2u * level;
    const uint quadrant = (place | (1u << (2u * kLevels))) >> (shift + 2u);
    const uint order = kOrders[combine(seed, quadrant) % 24u];
    shuffled |= ((order >> (2u * ((place >> shift) & 3u))) & 3u) << shift;
  }
  return shuffled;
}

float toUnit(uint x) { return float(x >> 8) * 5.9604644775390625e-8; }

vec2 sobolPoint(uint index, uint seed) {
  return vec2(toUnit(bitfieldReverse(laineKarras(index, combine(seed, 1u)))),
              toUnit(bitfieldReverse(laineKarras(reversedSobolSecond(index), combine(seed, 2u)))));
}

Random makeRandom(uint seed, uint pixel, uint index) {
  const uint mixed = mixBits(seed);
  return Random(mixed, spreadBits(pixel) | (spreadBits(pixel >> 16) << 1), combine(mixed, pixel), index, 0u);
}

vec2 next2D(inout Random random) {
  const uint dimension = random.dimension++;
  if (trace.sequence == kBlueNoise) {
    const uint seed = combine(combine(random.seed, random.index), dimension);
    return sobolPoint(shuffledZOrder(random.place, combine(seed, 3u)), seed);
  }
  const uint seed = combine(random.sequence, dimension);
  if (trace.sequence == kIndependent) {
    const uint x = combine(seed, random.index);
    return vec2(toUnit(x), toUnit(combine(x, 1u)));
  }
  return sobolPoint(owenScramble(random.index, seed), seed);
}

float next1D(inout Random random) { return next2D(random).x; }
