#pragma once

#include <cstdint>

#include "samples/image/image.h"

namespace walr::test {

/// The same hash to [0, 1) as in make_metric_fixture.py.
inline double uniform(std::uint32_t n) {
  n ^= n >> 16U;
  n *= 0x7FEB352DU;
  n ^= n >> 15U;
  n *= 0x846CA68BU;
  n ^= n >> 16U;
  return n / 4294967296.0;
}

struct Pictures {
  Image test;
  Image reference;
};

/// The same test images as in make_metric_fixture.py.
inline Pictures makePictures(int width, int height, double amplitude) {
  Pictures pictures{Image(width, height, 3), Image(width, height, 3)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double reference = 0.1 + 0.15 * ((3 * x + 5 * y + 7 * c) % 17) + 0.02 * x;
        const auto index = static_cast<std::uint32_t>((y * width + x) * 3 + c);
        pictures.reference.at(x, y, c) = static_cast<float>(reference);
        pictures.test.at(x, y, c) = static_cast<float>(reference * (1.0 + amplitude * (uniform(index) - 0.5)));
      }
    }
  }
  return pictures;
}

}  // namespace walr::test
