#include "samples/denoise/roughness_classes.h"

namespace walr {

PixelMask maskOfClass(const PixelMask& mask, const Image& roughness, std::size_t roughnessClass) {
  const float from = kRoughnessBounds.at(roughnessClass), to = kRoughnessBounds.at(roughnessClass + 1);
  PixelMask ofClass = mask;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const float r = roughness.pixel(i)[0];
    const bool below = r < to || roughnessClass + 1 == kRoughnessClasses;
    if (!(r >= from && below)) ofClass[i] = 0;
  }
  return ofClass;
}

FiguresByRoughness rmseByRoughness(const DisplayedPair& pair, const PixelMask& mask, const Image& roughness) {
  return figuresByRoughness(mask, roughness, [&](const PixelMask& ofClass) { return rmseOf(pair, ofClass); });
}

}  // namespace walr
