#include "samples/image/exposure.h"

#include <cmath>
#include <cstddef>

#include "samples/image/luminance.h"

namespace walr {

std::optional<float> autoExposure(const Image& picture) {
  constexpr double kKeyValue = 0.18;
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < picture.pixelCount(); ++i) {
    const double value = luminance(picture.pixel(i));
    if (!(value > 0.0) || !std::isfinite(value)) continue;
    sum += std::log2(value);
    ++count;
  }
  if (count == 0) return std::nullopt;
  return static_cast<float>(std::log2(kKeyValue) - sum / static_cast<double>(count));
}

}  // namespace walr
