#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "samples/image/image.h"
#include "samples/metrics/metrics.h"

namespace walr {

/// Bounds of the classes of linear roughness by which errors of specular light are told apart. A class includes its
/// lower bound, and the last one also its upper bound.
inline constexpr std::array kRoughnessBounds{0.0F, 0.1F, 0.2F, 0.3F, 0.4F, 0.6F, 1.0F};
inline constexpr std::size_t kRoughnessClasses = kRoughnessBounds.size() - 1;
/// A figure of each class; absent without a pixel.
using FiguresByRoughness = std::array<std::optional<double>, kRoughnessClasses>;

inline bool hasFigures(const FiguresByRoughness& figures) {
  return std::ranges::any_of(figures, [](const auto& figure) { return figure.has_value(); });
}

/// The pixels of a mask that belong to a class.
/// @param roughness 1 component: linear
PixelMask maskOfClass(const PixelMask& mask, const Image& roughness, std::size_t roughnessClass);

/// A figure of each class.
/// @param figureOf computes it from the mask of a class
template <typename Figure>
FiguresByRoughness figuresByRoughness(const PixelMask& mask, const Image& roughness, const Figure& figureOf) {
  FiguresByRoughness figures;
  for (std::size_t i = 0; i < figures.size(); ++i) figures.at(i) = figureOf(maskOfClass(mask, roughness, i));
  return figures;
}

/// RMSE of each class.
FiguresByRoughness rmseByRoughness(const DisplayedPair& pair, const PixelMask& mask, const Image& roughness);

}  // namespace walr
