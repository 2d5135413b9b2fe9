#include "samples/metrics/display.h"

#include <cmath>

#include "samples/image/tone_map.h"

namespace walr {
namespace {

float displayed(float test, float reference) {
  if (!std::isfinite(test)) {
    return reference > 0.5F ? 0.0F : 1.0F;
  }
  return toneMap(test);
}

}  // namespace

DisplayedPair display(const Image& test, const Image& reference, const PixelMask& mask) {
  const Image empty(reference.width(), reference.height(), 3);
  DisplayedPair pair{empty, empty};
  for (std::size_t i = 0; i < mask.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = reference.pixel(i)[c];
      pair.reference.pixel(i)[c] = std::isfinite(value) ? toneMap(value) : 0.0F;
      pair.test.pixel(i)[c] =
          mask[i] != 0 ? displayed(test.pixel(i)[c], pair.reference.pixel(i)[c]) : pair.reference.pixel(i)[c];
    }
  }
  return pair;
}

}  // namespace walr
