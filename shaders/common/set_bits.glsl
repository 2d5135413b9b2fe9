// Sets as bits of words.
#ifndef WALR_SET_BITS_GLSL
#define WALR_SET_BITS_GLSL

// Position of the set bit that has `before` set bits below it. There must be such a bit.
int positionOfSetBit(uint word, uint before) {
  int first = 0;
  // The bit is one of 32, then of 16, 8, 4 and 2 from `first` on. Each step skips their lower half if the bit is not in
  // it.
  [[unroll]] for (int i = 4; i >= 0; --i) {
    const int size = 1 << i;
    const uint below = uint(bitCount(bitfieldExtract(word, first, size)));
    const bool skip = before >= below;
    before -= skip ? below : 0u;
    first += skip ? size : 0;
  }
  return first;
}

int positionOfSetBit(uvec2 words, uint before) {
  const uint low = uint(bitCount(words.x));
  return before < low ? positionOfSetBit(words.x, before) : 32 + positionOfSetBit(words.y, before - low);
}

#endif
